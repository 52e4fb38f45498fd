//! What a controller says in one step, to the arm and about itself.

use nalgebra::{Isometry3, Vector3, Vector6};

use super::Observation;
use crate::robot::JointCommand;

/// What the arm is told.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// Torques and damping of the joints.
    pub joints: JointCommand,
    /// Opening that the gripper seeks (0 closed … 1 open).
    pub gripper: f64,
}

/// What a controller knew and wanted in its last step, for records.
#[derive(Clone, Debug, PartialEq)]
pub struct Telemetry {
    /// Wanted tool pose in the base frame.
    pub reference: Isometry3<f64>,
    /// Estimated wrench by the environment on the tool: force (N), torque (N m), base axes.
    pub wrench: Vector6<f64>,
    /// Force that the skill's force model expects (N).
    pub expected_force: Vector3<f64>,
    /// Displacement zeta/K that the coupling asks for (m).
    pub coupling_displacement: Vector3<f64>,
    /// How far the forces so far have moved the reference from the plan (m).
    pub deviation: Vector3<f64>,
    /// Phase s.
    pub phase: f64,
    /// Elapsed fraction of the duration u.
    pub time_fraction: f64,
    /// Active HMM state.
    pub state: usize,
    /// Its beta.
    pub beta: f64,
    /// How far the coupling is switched on (0 … 1).
    pub activation: f64,
}

impl Default for Telemetry {
    fn default() -> Self {
        Self {
            reference: Isometry3::identity(),
            wrench: Vector6::zeros(),
            expected_force: Vector3::zeros(),
            coupling_displacement: Vector3::zeros(),
            deviation: Vector3::zeros(),
            phase: 1.0,
            time_fraction: 0.0,
            state: 0,
            beta: 0.0,
            activation: 0.0,
        }
    }
}

/// A controller of the working arm: called once per step, allocates nothing there.
pub trait Controller {
    /// Decides what to do in the next step.
    fn decide(&mut self, observation: &Observation, command: &mut Command);

    /// What it knew and wanted in the last step.
    fn telemetry(&self) -> &Telemetry;
}

impl Command {
    /// A command for `joints` joints: no torque, an open gripper.
    pub fn idle(joints: usize) -> Self {
        Self { joints: JointCommand::zero(joints), gripper: 1.0 }
    }
}
