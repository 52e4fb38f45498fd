//! Executes a learned skill: the CPDMP runs in the control loop, fed by the arm's own wrench estimate.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use super::{Command, Controller, Observation, PoseTracker, Telemetry, WrenchObserver};
use crate::learning::{Skill, SkillExecution, StepInput};

/// Runs a [`SkillExecution`] whose motion columns begin with x, y, z of the tool in the base frame.
pub struct SkillController {
    skill: SkillExecution,
    tracker: PoseTracker,
    observer: WrenchObserver,
    /// Orientation of the tool when the skill has none.
    orientation: UnitQuaternion<f64>,
    step_s: f64,
    stiffness: f64,
    /// Which of force x, y, z and torque x, y, z the skill takes, in its order, and room for their values.
    wrench_places: Vec<usize>,
    wrench: Vec<f64>,
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
        let stiffness = skill.motion.stiffness;
        let wrench_places: Vec<usize> = skill.force.iter().flat_map(|force| &force.columns).filter_map(|name| wrench_place(name)).collect();
        let wrench_places = if wrench_places.is_empty() { vec![0, 1, 2] } else { wrench_places };
        let wrench = vec![0.0; wrench_places.len()];
        let telemetry = Telemetry::default();
        Self { skill: execution, tracker, observer, orientation, step_s, stiffness, wrench_places, wrench, telemetry, started: false }
    }
}

impl Controller for SkillController {
    fn decide(&mut self, observation: &Observation, command: &mut Command) {
        let wrench = self.observer.observe(observation);
        for (value, &place) in self.wrench.iter_mut().zip(&self.wrench_places) {
            *value = wrench[place];
        }
        let state = if self.started {
            self.skill.step(&StepInput { wrench: &self.wrench, ..StepInput::of(self.step_s) })
        } else {
            self.skill.state()
        };
        self.started = true;
        let place = Translation3::new(state.position[0], state.position[1], state.position[2]);
        let reference = Isometry3::from_parts(place, state.orientation.unwrap_or(self.orientation));
        command.gripper = state.gripper.unwrap_or(1.0);
        self.telemetry = Telemetry {
            reference,
            wrench,
            expected_force: expected_force(state.expected_wrench.as_slice(), &self.wrench_places),
            coupling_displacement: first_three(state.zeta.as_slice()) / self.stiffness,
            deviation: first_three(state.deviation.as_slice()),
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

/// Columns of a wrench in the order of the estimate: force, torque.
pub const WRENCH_COLUMNS: [&str; 6] = ["fx_n", "fy_n", "fz_n", "tx_nm", "ty_nm", "tz_nm"];

/// The place of a wrench column in the estimate.
fn wrench_place(column: &str) -> Option<usize> {
    WRENCH_COLUMNS.iter().position(|name| *name == column)
}

/// The force among the expected values, each of which belongs to a place of the wrench.
fn expected_force(expected: &[f64], places: &[usize]) -> Vector3<f64> {
    let mut force = Vector3::zeros();
    for (value, place) in expected.iter().zip(places).filter(|(_, place)| **place < 3) {
        force[*place] = *value;
    }
    force
}

fn first_three(values: &[f64]) -> Vector3<f64> {
    Vector3::from_fn(|i, _| values.get(i).copied().unwrap_or(0.0))
}
