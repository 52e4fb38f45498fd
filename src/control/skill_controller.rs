//! Executes a learned skill: the CPDMP runs in the control loop, fed by the arm's own wrench estimate.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use super::{Command, Controller, Observation, PoseTracker, Telemetry, WrenchObserver};
use crate::learning::{Skill, SkillExecution};

/// Runs a [`SkillExecution`] whose motion columns begin with x, y, z of the tool in the base frame.
pub struct SkillController {
    skill: SkillExecution,
    tracker: PoseTracker,
    observer: WrenchObserver,
    /// Orientation of the tool when the skill has none.
    orientation: UnitQuaternion<f64>,
    step_s: f64,
    stiffness: f64,
    /// How many of force x, y, z and torque x, y, z the skill takes.
    forces: usize,
    telemetry: Telemetry,
    started: bool,
}

impl SkillController {
    /// Executes `execution` of `skill` in control steps of `step_s` (s). `orientation` is held when the skill has none.
    pub fn new(
        skill: &Skill,
        execution: SkillExecution,
        tracker: PoseTracker,
        observer: WrenchObserver,
        orientation: UnitQuaternion<f64>,
        step_s: f64,
    ) -> Self {
        let (stiffness, forces) = (skill.motion.stiffness, execution.state().expected_wrench.len().min(6));
        Self {
            skill: execution,
            tracker,
            observer,
            orientation,
            step_s,
            stiffness,
            forces,
            telemetry: Telemetry::default(),
            started: false,
        }
    }
}

impl Controller for SkillController {
    fn decide(&mut self, observation: &Observation, command: &mut Command) {
        let wrench = self.observer.observe(observation);
        let state = if self.started { self.skill.step(self.step_s, &wrench.as_slice()[..self.forces], 1.0) } else { self.skill.state() };
        self.started = true;
        let place = Translation3::new(state.position[0], state.position[1], state.position[2]);
        let reference = Isometry3::from_parts(place, state.orientation.unwrap_or(self.orientation));
        command.gripper = state.gripper.unwrap_or(1.0);
        self.telemetry = Telemetry {
            reference,
            wrench,
            expected_force: first_three(state.expected_wrench.as_slice()),
            coupling_displacement: first_three(state.zeta.as_slice()) / self.stiffness,
            phase: state.phase,
            time_fraction: state.u,
            state: state.state,
            beta: state.beta,
            activation: state.activation,
        };
        self.tracker.track(&reference, &observation.position, &mut command.joints);
    }

    fn telemetry(&self) -> &Telemetry {
        &self.telemetry
    }
}

fn first_three(values: &[f64]) -> Vector3<f64> {
    Vector3::from_fn(|i, _| values.get(i).copied().unwrap_or(0.0))
}
