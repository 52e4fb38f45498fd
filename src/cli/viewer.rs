//! The viewer of recordings, a program of its own: found on the PATH, started, and left alone.

use std::io;
use std::net::{Ipv4Addr, SocketAddr, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use clap::Args;

/// Which viewer shows recordings.
#[derive(Clone, Debug, Args)]
pub(super) struct Viewer {
    /// The program that shows recordings instead of `rerun`
    #[arg(long, env = "CPDMP_VIEWER_PROGRAM", value_name = "PROGRAM")]
    pub viewer_program: Option<PathBuf>,
    /// The port at which it listens on this machine
    #[arg(long, env = "CPDMP_VIEWER_PORT", value_name = "PORT", default_value_t = 9876)]
    pub viewer_port: u16,
}

/// What to do when there is no viewer.
const INSTALL: &str = "install it with `pip install rerun-sdk==0.36.3` or `cargo install rerun-cli --version 0.36.3 --locked`, or open \
     https://app.rerun.io/version/0.36.3 in a browser and drop the file there";

/// A viewer on this machine answers within that time.
const ANSWERS: Duration = Duration::from_millis(200);

impl Viewer {
    /// The program that shows recordings.
    pub fn program(&self) -> &Path {
        self.viewer_program.as_deref().unwrap_or(Path::new("rerun"))
    }

    /// Shows a recording: in a viewer that is open already, or in one of its own. Whoever started it need not wait for it; what it says goes
    /// nowhere.
    ///
    /// # Errors
    /// In words, when it cannot be started.
    pub fn show(&self, recording: &Path) -> Result<Child, String> {
        self.start(self.window().arg(recording))
    }

    /// Serves a recording as a page, at a port of this machine that no other machine reaches. It ends with whoever started it.
    ///
    /// # Errors
    /// In words, when it cannot be started.
    pub fn serve(&self, recording: &Path, port: u16) -> Result<Child, String> {
        let mut command = Command::new(self.program());
        let bind = Ipv4Addr::LOCALHOST.to_string();
        command.arg(recording).args(["--web-viewer", "--bind", &bind, "--web-viewer-port", &port.to_string()]);
        self.start(&mut command)
    }

    /// The address of the page that is served at `port`.
    pub fn page(&self, port: u16) -> String {
        let host = Ipv4Addr::LOCALHOST;
        format!("http://{host}:{port}?url=rerun%2Bhttp%3A%2F%2F{host}%3A{}%2Fproxy", self.viewer_port)
    }

    /// A viewer for a run that begins: the one that is open, or one of its own.
    ///
    /// # Errors
    /// In words, when it cannot be started.
    pub fn open(&self) -> Result<Open<'_>, String> {
        let started = if self.listens() { None } else { Some(self.start(&mut self.window())?) };
        Ok(Open { viewer: self, started })
    }

    fn window(&self) -> Command {
        apart(Command::new(self.program()))
    }

    fn start(&self, command: &mut Command) -> Result<Child, String> {
        command.arg("--port").arg(self.viewer_port.to_string());
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        command.spawn().map_err(|error| self.why_not(&error))
    }

    fn listens(&self) -> bool {
        TcpStream::connect_timeout(&self.address(), ANSWERS).is_ok()
    }

    fn address(&self) -> SocketAddr {
        (Ipv4Addr::LOCALHOST, self.viewer_port).into()
    }

    fn why_not(&self, error: &io::Error) -> String {
        let program = self.program().display();
        match error.kind() {
            io::ErrorKind::NotFound => format!("the viewer `{program}` is not there: {INSTALL}"),
            _ => format!("the viewer `{program}` cannot be started: {error}"),
        }
    }
}

/// A program that outlives this one: Ctrl-C ends a run, not what shows it.
#[cfg(unix)]
fn apart(mut command: Command) -> Command {
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    command
}

#[cfg(not(unix))]
fn apart(command: Command) -> Command {
    command
}

/// The viewer of a run that goes on.
pub(super) struct Open<'a> {
    viewer: &'a Viewer,
    /// Unless it stood there before.
    started: Option<Child>,
}

impl Open<'_> {
    #[cfg(feature = "rerun")]
    /// Where it listens, or will when it has started.
    pub fn address(&self) -> SocketAddr {
        self.viewer.address()
    }

    /// Shows the recording of the run that is over.
    ///
    /// # Errors
    /// In words, when there is none, or the viewer is gone.
    pub fn show(mut self, recording: &Path) -> Result<(), String> {
        if !recording.is_file() {
            return Err("there is no recording to show".to_owned());
        }
        let starts = self.started.as_mut().is_some_and(|child| matches!(child.try_wait(), Ok(None)));
        if starts || self.viewer.listens() {
            return self.viewer.show(recording).map(drop);
        }
        Err(format!("the viewer was closed, or has no display: `cpdmp view {}` shows the recording", recording.display()))
    }
}
