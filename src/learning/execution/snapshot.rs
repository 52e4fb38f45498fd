//! Where an execution is, as something that can be kept, and taken up again.

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::movement::MovementSnapshot;
use super::turning::TurningSnapshot;
use super::{SkillExecution, SkillState};

/// Everything of a [`SkillExecution`] that changes from step to step.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct ExecutionSnapshot {
    time_fraction: f64,
    goal: DVector<f64>,
    movement: MovementSnapshot,
    turning: Option<TurningSnapshot>,
    displacement: Vec<f64>,
    state: SkillState,
}

impl SkillExecution {
    /// Where the execution is.
    #[must_use]
    pub fn snapshot(&self) -> ExecutionSnapshot {
        ExecutionSnapshot {
            time_fraction: self.canonical.time_fraction(),
            goal: self.goal.clone(),
            movement: self.movement.snapshot(),
            turning: self.turning.as_ref().map(super::turning::Turning::snapshot),
            displacement: self.displacement.clone(),
            state: self.state.clone(),
        }
    }

    /// Goes on from where an execution of the same skill was, in the same bits. Returns whether the snapshot was taken: one of a skill with
    /// other columns changes nothing.
    pub fn restore(&mut self, from: ExecutionSnapshot) -> bool {
        let alike = (self.goal.len(), self.displacement.len(), self.state.expected_wrench.len(), self.turning.is_some())
            == (from.goal.len(), from.displacement.len(), from.state.expected_wrench.len(), from.turning.is_some());
        if !alike || !self.movement.restore(from.movement) {
            return false;
        }
        self.canonical.set_time_fraction(from.time_fraction);
        if let (Some(turning), Some(there)) = (&mut self.turning, &from.turning) {
            turning.restore(there);
        }
        (self.goal, self.displacement, self.state) = (from.goal, from.displacement, from.state);
        true
    }
}
