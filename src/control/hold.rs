//! Holds a posture: the arm that does not work.

use super::{ArmModel, ImpedanceSettings};
use crate::robot::JointCommand;

/// Joint impedance about a fixed posture, with gravity compensation.
pub struct HoldPosture {
    model: ArmModel,
    settings: ImpedanceSettings,
    posture: Vec<f64>,
    rest: Vec<f64>,
    gravity_torque: Vec<f64>,
}

impl HoldPosture {
    /// Holds `posture_rad` of the arm `model`.
    pub fn new(model: ArmModel, settings: ImpedanceSettings, posture_rad: Vec<f64>) -> Self {
        let n = posture_rad.len();
        Self { model, settings, posture: posture_rad, rest: vec![0.0; n], gravity_torque: vec![0.0; n] }
    }

    /// Writes the command for joint angles `q` (rad).
    pub fn decide(&mut self, q: &[f64], command: &mut JointCommand) {
        self.model.gravity_torques(q, &mut self.gravity_torque);
        self.settings.command(&self.gravity_torque, q, &self.posture, &self.rest, command);
    }
}
