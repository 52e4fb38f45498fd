//! How a skill hears of where the arm really is.

use super::ArmModel;
use crate::learning::{Measured, SkillState};

/// Whether the skill goes on from where it sent the arm, or from where the arm is.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum Feedback {
    /// From where it sent the arm: what holds the arm back never bends the plan.
    #[default]
    None,
    /// It is drawn to the measured position and velocity, all but a fraction `1/e` within `time_constant_s` (s, > 0). A skill that went on from the
    /// measured state alone would ask the arm for nothing but its own velocity, and friction would stop it.
    Measured {
        /// Time constant (s).
        time_constant_s: f64,
    },
}

/// The measured state of the arm in the columns of a skill's motion, blended into the skill's own.
pub(super) struct StateFeedback {
    model: ArmModel,
    /// Share of the difference that a step takes over (-).
    gain: f64,
    position: Vec<f64>,
    velocity: Vec<f64>,
}

impl StateFeedback {
    /// Feedback in control steps of `step_s` (s) for a motion of `columns` columns; `None` when there is to be none.
    pub(super) fn new(feedback: Feedback, model: ArmModel, columns: usize, step_s: f64) -> Option<Self> {
        let Feedback::Measured { time_constant_s } = feedback else { return None };
        let gain = 1.0 - (-step_s / time_constant_s).exp();
        Some(Self { model, gain, position: vec![0.0; columns], velocity: vec![0.0; columns] })
    }

    /// From a skill whose columns are the joints, at `q` (rad) and `v` (rad/s).
    pub(super) fn of_joints(&mut self, state: &SkillState, q: &[f64], v: &[f64]) -> Measured<'_> {
        self.start_from(state);
        self.blend(q, v)
    }

    /// From a skill whose first columns are the place of the tool, at `q` (rad) and `v` (rad/s). Other columns are not measured.
    pub(super) fn of_tool(&mut self, state: &SkillState, q: &[f64], v: &[f64]) -> Measured<'_> {
        self.start_from(state);
        let place = self.model.tool_pose(q).translation.vector;
        let twist = self.model.tool_twist(v);
        self.blend(place.as_slice(), &twist.as_slice()[..3])
    }

    fn start_from(&mut self, state: &SkillState) {
        self.position.copy_from_slice(state.position.as_slice());
        self.velocity.copy_from_slice(state.velocity.as_slice());
    }

    fn blend(&mut self, position: &[f64], velocity: &[f64]) -> Measured<'_> {
        for (own, measured) in self.position.iter_mut().zip(position).chain(self.velocity.iter_mut().zip(velocity)) {
            *own += self.gain * (measured - *own);
        }
        Measured { position: &self.position, velocity: &self.velocity, orientation: None }
    }
}
