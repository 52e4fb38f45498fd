//! How well a skill repeats what it was learned from.

use super::super::{ExecutionSettings, LearningError, Skill};
use super::{ErrorSize, MovementError, wrench_error};
use crate::demonstration::{Dataset, Demonstration};

/// The error of repeating one demonstration that was learned from.
#[derive(Debug, Clone, PartialEq)]
pub struct Reproduction {
    /// The demonstration's name.
    pub demonstration: String,
    /// The error with the demonstration's start, goal and parameters given.
    pub error: MovementError,
    /// The error of the expected wrench for the demonstration's `theta_f`, per column of the force model; none without one.
    pub wrench: Vec<ErrorSize>,
}

/// The error of `skill` against every demonstration of `dataset`, each asked for with its own parameters, start and goal.
///
/// # Errors
/// When the dataset lacks a motion column or parameter of the skill.
pub fn reproduction(dataset: &Dataset, skill: &Skill) -> Result<Vec<Reproduction>, LearningError> {
    let one = |demonstration: &Demonstration| {
        let error = MovementError::of(skill, &with_ends(demonstration, skill)?, &demonstration.trajectory)?;
        Ok(Reproduction { demonstration: demonstration.name.clone(), error, wrench: wrench_error(skill, demonstration)? })
    };
    dataset.demonstrations.iter().map(one).collect()
}

/// A demonstration's own parameters, start and goal.
pub(super) fn with_ends(demonstration: &Demonstration, skill: &Skill) -> Result<ExecutionSettings, LearningError> {
    let positions = demonstration.trajectory.select(&skill.motion.columns)?;
    let row = |t: usize| Some(positions.row(t).iter().copied().collect());
    Ok(ExecutionSettings { start: row(0), goal: row(positions.nrows() - 1), ..with_parameters(demonstration, skill) })
}

/// A demonstration's parameters alone; those of forces only where the skill has a force model.
pub(super) fn with_parameters(demonstration: &Demonstration, skill: &Skill) -> ExecutionSettings {
    let theta_f = skill.force.as_ref().map_or_else(Vec::new, |_| demonstration.theta_f.clone());
    ExecutionSettings { theta_m: demonstration.theta_m.clone(), theta_f, ..Default::default() }
}
