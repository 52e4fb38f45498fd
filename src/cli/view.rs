//! `cpdmp view`: shows the recording of a run in the installed viewer, in a window or in a browser.

use std::path::PathBuf;
use std::process::{Child, ExitStatus};
use std::thread;
use std::time::{Duration, Instant};

use clap::Args;

use super::failure::Failure;
use super::terminal::Terminal;
use super::viewer::Viewer;
use crate::report::Outcome;

/// Which run is shown, and where.
#[derive(Debug, Args)]
pub(super) struct View {
    /// The folder that a run has left, or a recording
    #[arg(value_name = "RUN_DIR")]
    pub place: PathBuf,
    /// Show it in a browser: it is served to this machine alone, until Ctrl-C
    #[arg(long, env = "CPDMP_WEB")]
    pub web: bool,
    /// The port of the page that --web serves
    #[arg(long, env = "CPDMP_WEB_PORT", value_name = "PORT", default_value_t = 9090)]
    pub web_port: u16,
    #[command(flatten)]
    pub viewer: Viewer,
}

/// A viewer that cannot work has ended by then: one without a display ends within a tenth of it.
const SETTLED: Duration = Duration::from_secs(2);

/// Opens the viewer and returns when it stands, or has handed the recording to one that stood already. A page is served until it is ended.
pub(super) fn view(arguments: &View, terminal: &Terminal) -> Outcome {
    let recording = if arguments.place.is_dir() { arguments.place.join("recording.rrd") } else { arguments.place.clone() };
    let failed = |outcome: Outcome, message: String| Failure::new(outcome, [message]).tell(terminal);
    if !recording.is_file() {
        let message = format!("{} is not there: a run leaves one unless its scenario says recording.rrd = false", recording.display());
        return failed(Outcome::InvalidInput, message);
    }
    #[cfg(feature = "web-viewer")]
    if arguments.web && arguments.viewer.viewer_program.is_none() {
        return match super::web_page::WebPage::open(&recording, arguments.web_port) {
            Ok(page) => {
                terminal.note(&format!("showing {} at {} until Ctrl-C\n", recording.display(), page.address()));
                page.serve();
                Outcome::Passed
            }
            Err(message) => failed(Outcome::OutputFailed, message),
        };
    }
    let page = arguments.web.then_some(arguments.web_port);
    let started = page.map_or_else(|| arguments.viewer.show(&recording), |port| arguments.viewer.serve(&recording, port));
    let mut viewer = match started {
        Ok(viewer) => viewer,
        Err(message) => return failed(Outcome::OutputFailed, message),
    };
    if let Some(status) = ended(&mut viewer).filter(|status| !status.success()) {
        return failed(Outcome::OutputFailed, arguments.why_it_ended(status));
    }
    match page {
        None => terminal.note(&format!("showing {}\n", recording.display())),
        Some(port) => {
            let address = arguments.viewer.page(port);
            terminal.note(&format!("showing {} at {address} until Ctrl-C\n", recording.display()));
            // However it ends, it has been shown.
            _ = viewer.wait();
        }
    }
    Outcome::Passed
}

/// How the viewer has ended, if it does before it has settled.
fn ended(viewer: &mut Child) -> Option<ExitStatus> {
    let started = Instant::now();
    while started.elapsed() < SETTLED {
        if let Ok(Some(status)) = viewer.try_wait() {
            return Some(status);
        }
        thread::sleep(Duration::from_millis(20));
    }
    None
}

impl View {
    fn why_it_ended(&self, status: ExitStatus) -> String {
        let program = self.viewer.program().display();
        if self.web {
            let ports = (self.web_port, self.viewer.viewer_port);
            format!(
                "the viewer `{program}` ended at once ({status}): are the ports {} and {} free (--web-port, --viewer-port)?",
                ports.0, ports.1
            )
        } else {
            format!("the viewer `{program}` ended at once ({status}): is there a display? --web shows it in a browser")
        }
    }
}
