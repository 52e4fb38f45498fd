//! The viewer of recordings, a program of its own: found on the PATH, started, and left alone.

use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use clap::Args;

/// Which viewer shows recordings.
#[derive(Clone, Debug, Args)]
pub(super) struct Viewer {
    /// The program that shows recordings
    #[arg(long, env = "CPDMP_VIEWER_PROGRAM", value_name = "PROGRAM", default_value = "rerun")]
    pub viewer_program: PathBuf,
}

/// What to do when there is no viewer.
const INSTALL: &str = "install it with `pip install rerun-sdk==0.36.3` or `cargo install rerun-cli --version 0.36.3 --locked`, or open \
     https://app.rerun.io/version/0.36.3 in a browser and drop the file there";

impl Viewer {
    /// Shows a recording: in a viewer that is open already, or in one of its own. Whoever started it need not wait for it; what it says goes
    /// nowhere.
    ///
    /// # Errors
    /// In words, when it cannot be started.
    pub fn show(&self, recording: &Path) -> Result<Child, String> {
        let mut command = Command::new(&self.viewer_program);
        let started = command.arg(recording).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
        started.map_err(|error| self.why_not(&error, recording))
    }

    fn why_not(&self, error: &io::Error, recording: &Path) -> String {
        let (program, recording) = (self.viewer_program.display(), recording.display());
        match error.kind() {
            io::ErrorKind::NotFound => format!("the viewer `{program}` is not there to show {recording}: {INSTALL}"),
            _ => format!("the viewer `{program}` cannot be started to show {recording}: {error}"),
        }
    }
}
