//! What watches a run besides the terminal: recordings that grow with it, one beside its other files and one in a viewer. None of them can
//! delay the run or make it fail.

use std::fs;
use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::progress::Shown;
use crate::recording::{LiveRecording, close_recording};
use crate::robot::RobotModel;
use crate::scenario::{Scenario, Work};
use crate::simulation::{LessonRecord, Progress, RunOutcome, StepRecord};

/// The recording that grows: it is there when a run is killed, and the recording of one that ends early.
const GROWING: &str = "recording.partial.rrd";

/// Recordings get so long to catch up when the run is over.
const PATIENCE: Duration = Duration::from_secs(2);

/// A run that is recorded while it goes on.
pub(super) struct Watched<'a> {
    shown: Shown<'a>,
    recordings: Vec<LiveRecording>,
    file: PathBuf,
}

impl<'a> Watched<'a> {
    /// Records into `folder` if the scenario wants a recording, and into a viewer that listens or will.
    pub fn new(shown: Shown<'a>, scenario: &Scenario, folder: &Path, viewer: Option<SocketAddr>) -> Self {
        let (file, mut recordings) = (folder.join(GROWING), Vec::new());
        if let Work::Arm(experiment) = &scenario.work {
            recordings.extend(scenario.recording.rrd.then(|| LiveRecording::to_file(&file, experiment)));
            recordings.extend(viewer.map(|address| LiveRecording::to_viewer(address, experiment)));
        }
        Self { shown, recordings, file }
    }

    /// The run is over, with a result in words.
    pub fn end(self, result: &str) -> (Shown<'a>, Grown) {
        self.recordings.iter().for_each(|recording| recording.ended(result));
        self.recordings.into_iter().for_each(|recording| _ = recording.finish(PATIENCE));
        (self.shown, Grown(self.file))
    }
}

/// The recording that has grown with a run.
pub(super) struct Grown(PathBuf);

impl Grown {
    /// Gives its room to what a run leaves.
    pub fn spare(&self) {
        _ = fs::remove_file(&self.0);
    }

    /// Makes it the recording of a run that has left no other; otherwise it has done its work. Until then there is one at every moment.
    pub fn settle(self) {
        let whole = self.0.with_file_name("recording.rrd");
        let left = whole.exists() || !self.0.exists();
        // Nothing is lost with a file that cannot be removed or renamed, and one without its end can be looked at all the same.
        _ = if left || close_recording(&self.0, &whole).is_ok() { fs::remove_file(&self.0) } else { fs::rename(&self.0, whole) };
    }
}

impl Progress for Watched<'_> {
    fn phase(&self, name: &str, steps: u64) {
        self.shown.phase(name, steps);
    }

    fn advance(&self, steps: u64) {
        self.shown.advance(steps);
    }

    fn note(&self, text: &str) {
        self.shown.note(text);
    }

    fn elapsed_s(&self) -> f64 {
        self.shown.elapsed_s()
    }

    fn may_go_on(&self) -> bool {
        self.shown.may_go_on()
    }

    fn lesson(&self, robot: &RobotModel, number: usize, lesson: &LessonRecord) {
        self.recordings.iter().for_each(|recording| recording.lesson(robot, number, lesson));
    }

    fn taught(&self, robot: &RobotModel, lessons: &[LessonRecord]) {
        self.recordings.iter().for_each(|recording| recording.taught(robot, lessons));
    }

    fn planned(&self, outcome: &RunOutcome) {
        self.recordings.iter().for_each(|recording| recording.planned(outcome));
    }

    fn stepped(&self, record: &StepRecord) {
        self.recordings.iter().for_each(|recording| recording.stepped(record));
    }
}
