//! One scenario from its settings to its report.

use crate::check::judge;
use crate::demonstration::DemonstrationError;
use crate::learning::LearningError;
use crate::report::{Outcome, RunReport};
use crate::scenario::Scenario;
use crate::simulation::{self, Progress, RunOutcome, SimulationError};
use crate::world::WorldError;

/// A run, as far as it came, with its report.
pub(super) struct JudgedRun {
    /// What it left behind; nothing if it could not be finished.
    pub left: Option<RunOutcome>,
    pub report: RunReport,
}

impl JudgedRun {
    /// Input that cannot be used leaves nothing on the disk.
    pub fn wants_folder(&self) -> bool {
        self.report.outcome != Outcome::InvalidInput
    }
}

/// Simulates a scenario and judges it.
pub(super) fn judged_run(scenario: &Scenario, progress: &dyn Progress) -> JudgedRun {
    let experiment = &scenario.experiment;
    match simulation::run(experiment, progress) {
        Ok(left) => {
            let criteria = judge(&left, experiment, &scenario.criteria);
            let mut report = RunReport::finished(experiment, &left, &criteria);
            report.warnings.extend(scenario.warnings.iter().map(ToString::to_string));
            JudgedRun { left: Some(left), report }
        }
        Err(error) => JudgedRun { left: None, report: RunReport::failed(experiment, outcome_of(&error), &error.to_string()) },
    }
}

/// How a command ends that meets this error.
pub(super) fn outcome_of(error: &SimulationError) -> Outcome {
    match error {
        SimulationError::World(WorldError::Diverged { .. }) => Outcome::Diverged,
        SimulationError::Learning(LearningError::Settings(_) | LearningError::Demonstration(_)) => Outcome::InvalidInput,
        SimulationError::Learning(_) => Outcome::LearningFailed,
        SimulationError::Demonstrations(DemonstrationError::Io { .. } | DemonstrationError::Invalid(_))
        | SimulationError::Urdf(_)
        | SimulationError::Arm(_)
        | SimulationError::Unreachable { .. }
        | SimulationError::JointCounts(_)
        | SimulationError::World(_)
        | SimulationError::Scene(_)
        | SimulationError::Mismatch(_) => Outcome::InvalidInput,
    }
}
