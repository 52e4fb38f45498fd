//! `cpdmp view`: shows the recording of a run in the installed viewer.

use std::path::PathBuf;
use std::thread;
use std::time::{Duration, Instant};

use clap::Args;

use super::failure::Failure;
use super::terminal::Terminal;
use super::viewer::Viewer;
use crate::report::Outcome;

/// Which run is shown.
#[derive(Debug, Args)]
pub(super) struct View {
    /// The folder that a run has left, or a recording
    #[arg(value_name = "RUN_DIR")]
    pub place: PathBuf,
    #[command(flatten)]
    pub viewer: Viewer,
}

/// A viewer that cannot work has ended by then: one without a display ends within a tenth of it.
const SETTLED: Duration = Duration::from_secs(2);

/// Opens the viewer and returns when it stands, or has handed the recording to one that stood already.
pub(super) fn view(arguments: &View, terminal: &Terminal) -> Outcome {
    let recording = if arguments.place.is_dir() { arguments.place.join("recording.rrd") } else { arguments.place.clone() };
    if !recording.is_file() {
        let message = format!("{} is not there: a run leaves one unless its scenario says recording.rrd = false", recording.display());
        return Failure::new(Outcome::InvalidInput, [message]).tell(terminal);
    }
    let mut viewer = match arguments.viewer.show(&recording) {
        Ok(viewer) => viewer,
        Err(message) => return Failure::new(Outcome::OutputFailed, [message]).tell(terminal),
    };
    let started = Instant::now();
    while started.elapsed() < SETTLED {
        if let Ok(Some(status)) = viewer.try_wait() {
            if status.success() {
                break;
            }
            let program = arguments.viewer.viewer_program.display();
            let message = format!(
                "the viewer `{program}` ended at once ({status}): is there a display? `{program} --web-viewer {}` shows it in a browser",
                recording.display()
            );
            return Failure::new(Outcome::OutputFailed, [message]).tell(terminal);
        }
        thread::sleep(Duration::from_millis(20));
    }
    terminal.note(&format!("showing {}\n", recording.display()));
    Outcome::Passed
}
