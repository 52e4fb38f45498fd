//! What a control loop tells a skill at each step.

use nalgebra::{Matrix6xX, UnitQuaternion, Vector3};

/// One step of a skill. `StepInput { wrench: &measured, ..StepInput::of(0.001) }` names only what there is.
#[derive(Debug, Clone, Copy)]
pub struct StepInput<'a> {
    /// How long the step is (s). Negative or not finite counts as 0.
    pub dt_s: f64,
    /// The wrench measured now (w; the skill's wrench columns). Empty when nothing is measured: then no force acts.
    pub wrench: &'a [f64],
    /// `rho` (-): 1 as taught, 0 waits. Negative or not finite counts as 0.
    pub phase_rate: f64,
    /// Where the robot really is; without it the skill goes on from where it sent it.
    pub measured: Option<Measured<'a>>,
    /// The Jacobian of the arm now (6 x n; rows fx fy fz tx ty tz, at the point and along the axes of the wrench). Only a coupling in
    /// joint space looks at it, and nothing acts without it.
    pub jacobian: Option<&'a Matrix6xX<f64>>,
}

/// The state of the robot as measured at the beginning of a step. What has the wrong length or is not finite counts as not measured.
#[derive(Debug, Clone, Copy)]
pub struct Measured<'a> {
    /// Position (d; unit of the motion columns).
    pub position: &'a [f64],
    /// Velocity (d; unit / s).
    pub velocity: &'a [f64],
    /// Orientation, and angular velocity (rad/s, base axes), where the skill has an orientation.
    pub orientation: Option<(UnitQuaternion<f64>, Vector3<f64>)>,
}

impl StepInput<'_> {
    /// A step of `dt_s` (s) as taught, with nothing measured.
    #[must_use]
    pub fn of(dt_s: f64) -> Self {
        Self { dt_s, wrench: &[], phase_rate: 1.0, measured: None, jacobian: None }
    }
}
