//! What is told about one step of a run: the only thing that checks, recordings and logs ever see of it.

use nalgebra::{Isometry3, Vector3, Vector6};

use super::AppliedForce;
use crate::world::TouchPoint;

/// A coupling that is switched on by less than this is off (-).
const OFF: f64 = 1e-3;

/// One logged step. World frame, SI.
#[derive(Clone, Debug)]
pub struct StepRecord {
    /// Number of the engine step since the start of the phase.
    pub step: u64,
    /// Simulated time since the start of the phase (s).
    pub time_s: f64,
    /// Joint angles of the working arm (rad).
    pub joint_position: Vec<f64>,
    /// Joint velocities (rad/s).
    pub joint_velocity: Vec<f64>,
    /// Measured efforts of the drives in the last step (N m), with whatever is wrong with the sensors.
    pub joint_effort: Vec<f64>,
    /// Where the tool frame (grasp centre) is.
    pub tool: Isometry3<f64>,
    /// Where the controller wants it.
    pub reference: Isometry3<f64>,
    /// The controller's wrench estimate at the tool: force (N) then torque (N m), by the environment on the tool.
    pub wrench: Vector6<f64>,
    /// What the force model expects (N); zero without one.
    pub expected_force: Vector3<f64>,
    /// The coupling term's displacement zeta/K (m).
    pub coupling_displacement: Vector3<f64>,
    /// How far the forces so far have moved the reference from the plan (m).
    pub deviation: Vector3<f64>,
    /// Phase s of the canonical system, and elapsed fraction u of the duration.
    pub phase: f64,
    /// Elapsed fraction of the duration, u = t / tau.
    pub time_fraction: f64,
    /// Active HMM state.
    pub state: usize,
    /// Its beta: 0 stiff, -1 complies, +1 minimises the force error.
    pub beta: f64,
    /// How far the coupling is switched on (0 … 1).
    pub activation: f64,
    /// Commanded opening of the gripper (0 closed … 1 open).
    pub gripper_command: f64,
    /// Measured opening of the gripper (0 … 1).
    pub gripper_opening: f64,
    /// What the person does.
    pub human: AppliedForce,
    /// Force of the objects on fingers and tool, as the engine solved it: through a clamp and by contacts, pressing and rubbing (N).
    pub tool_force: Vector3<f64>,
    /// Integral of that force over every engine step since the start (N s).
    pub tool_impulse: Vector3<f64>,
    /// Poses of the robot's bodies in the order of [`crate::robot::RobotModel::bodies`].
    pub bodies: Vec<Isometry3<f64>>,
    /// Poses of the scene's objects in the order of the experiment; of a cabinet, that of its door.
    pub objects: Vec<Isometry3<f64>>,
    /// What touched since the record before: of each pair of parts where it was deepest, and the largest force. Not part of the archive of steps.
    pub touches: Vec<TouchPoint>,
    /// Kinetic energy of the robot and the objects (J).
    pub kinetic_energy_j: f64,
}

impl StepRecord {
    /// Whether the skill is over and its coupling switched off.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.time_fraction >= 1.0 && self.activation < OFF
    }

    /// The beta with which the arm answers forces: when the skill is over, it holds its place whatever the last state did.
    #[must_use]
    pub fn acting_beta(&self) -> f64 {
        if self.is_over() { 0.0 } else { self.beta }
    }
}

/// How long the skill took (s), by the last record before its end; `None` when no record lies inside.
#[must_use]
pub fn skill_duration_s(steps: &[StepRecord]) -> Option<f64> {
    let inside = steps.iter().rev().find(|record| record.time_fraction > 0.0 && record.time_fraction < 1.0);
    inside.map(|record| record.time_s / record.time_fraction)
}
