//! How a run says where it is. Nothing it says depends on who listens.

use super::{LessonRecord, RunOutcome, StepRecord};
use crate::robot::RobotModel;

/// Somebody who wants to know how far a run is. Called from several threads.
pub trait Progress: Sync {
    /// A phase begins that will take this many steps.
    fn phase(&self, name: &str, steps: u64);
    /// Steps have been taken.
    fn advance(&self, steps: u64);
    /// Something worth a line.
    fn note(&self, text: &str);
    /// Seconds on the listener's clock, for saying how long things took: this room has none.
    fn elapsed_s(&self) -> f64;
    /// Whether the run may go on; asked before every engine step, every iteration of a model and every pose of a plan that is looked
    /// at. A run that may not ends with [`super::SimulationError::Stopped`] or another error that says how far it was; once not, never again.
    fn may_go_on(&self) -> bool {
        true
    }
    /// A lesson has been taught: number `number` of those of the run, counted from 0. Lessons end in any order.
    fn lesson(&self, _robot: &RobotModel, _number: usize, _lesson: &LessonRecord) {}
    /// The demonstrations have been taught.
    fn taught(&self, _robot: &RobotModel, _lessons: &[LessonRecord]) {}
    /// The skill is learned and its movement planned; `outcome` holds everything that comes before the execution.
    fn planned(&self, _outcome: &RunOutcome) {}
    /// A step of the execution has been logged. Called within the step: a listener that takes its time delays the run.
    fn stepped(&self, _record: &StepRecord) {}
}

/// Nobody listens.
pub struct Silent;

impl Progress for Silent {
    fn phase(&self, _name: &str, _steps: u64) {}
    fn advance(&self, _steps: u64) {}
    fn note(&self, _text: &str) {}
    fn elapsed_s(&self) -> f64 {
        0.0
    }
}
