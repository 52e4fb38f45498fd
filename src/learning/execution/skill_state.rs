//! What a control loop learns from each step of a skill.

use nalgebra::{DVector, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

/// Where a skill is. Motion, phase, orientation and gripper at the end of the step; what decided about forces as it was during it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SkillState {
    /// Time since the start (s).
    pub time_s: f64,
    /// Phase `s` (-), from 1 towards 0.
    pub phase: f64,
    /// Time fraction `u = -ln(s) / alpha` (-), 1 when the movement should be over.
    pub u: f64,
    /// Position (d; unit of the motion columns).
    pub position: DVector<f64>,
    /// Velocity (d; unit / s).
    pub velocity: DVector<f64>,
    /// Acceleration (d; unit / s^2).
    pub acceleration: DVector<f64>,
    /// How far forces have moved the position from the undisturbed movement (d; unit of the columns).
    pub deviation: DVector<f64>,
    /// Orientation, when the skill has one.
    pub orientation: Option<UnitQuaternion<f64>>,
    /// Angular velocity (rad/s, base axes), when the skill has an orientation.
    pub angular_velocity: Option<Vector3<f64>>,
    /// Opening of the gripper (0 closed, 1 open), when the skill has one.
    pub gripper: Option<f64>,
    /// The most responsible state of the motion model; 0 for the baseline.
    pub state: usize,
    /// `beta` of that state: -1 complies, 0 is stiff, 1 minimises the force error.
    pub beta: f64,
    /// `b` (-, 0 to 1): how far the coupling is switched on.
    pub activation: f64,
    /// `zeta` (d; unit of the columns times `K`): `zeta / K` is the displacement that the forces ask for, after saturation.
    pub zeta: DVector<f64>,
    /// `F_des(theta_f, s)` (w; unit of the wrench columns); zero without a force model.
    pub expected_wrench: DVector<f64>,
    /// The net forcing `b (f - (g - x0) s)` (d; unit of the columns): where the spring is pulled to, seen from the goal.
    pub forcing: DVector<f64>,
    /// Whether the last wrench had the right length and was finite. What is not finite does not act.
    pub wrench_valid: bool,
    /// Whether the last step went on from a measured state.
    pub measured_used: bool,
}

impl SkillState {
    /// At rest at a position (d), with so many wrench columns.
    pub(super) fn at(position: DVector<f64>, wrench: usize) -> Self {
        let zero = DVector::zeros(position.len());
        Self {
            time_s: 0.0,
            phase: 1.0,
            u: 0.0,
            position,
            velocity: zero.clone(),
            acceleration: zero.clone(),
            deviation: zero.clone(),
            orientation: None,
            angular_velocity: None,
            gripper: None,
            state: 0,
            beta: 0.0,
            activation: 0.0,
            zeta: zero.clone(),
            expected_wrench: DVector::zeros(wrench),
            forcing: zero,
            wrench_valid: true,
            measured_used: false,
        }
    }
}
