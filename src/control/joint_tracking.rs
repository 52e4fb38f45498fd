//! Follows a moving posture with joint impedance: what a skill in joint space needs.

use nalgebra::{Isometry3, Matrix6xX, Vector3};

use super::{ArmModel, ImpedanceSettings};
use crate::robot::JointCommand;

/// A tracker of postures.
pub struct PostureTracker {
    model: ArmModel,
    settings: ImpedanceSettings,
    gravity_torque: Vec<f64>,
    /// Room for a posture (rad).
    posture: Vec<f64>,
}

impl PostureTracker {
    /// A tracker of the arm `model`.
    pub fn new(model: ArmModel, settings: ImpedanceSettings) -> Self {
        let n = model.joints();
        Self { model, settings, gravity_torque: vec![0.0; n], posture: vec![0.0; n] }
    }

    /// Writes the command that brings the joints to `reference_q` (rad), which moves at `reference_v` (rad/s), the arm being at `q` (rad).
    pub fn track(&mut self, reference_q: &[f64], reference_v: &[f64], q: &[f64], command: &mut JointCommand) {
        self.model.gravity_torques(q, &mut self.gravity_torque);
        self.settings.command(&self.gravity_torque, q, reference_q, reference_v, command);
    }

    /// `base_from_tool` at `q` (rad).
    pub fn tool_pose(&mut self, q: &[f64]) -> Isometry3<f64> {
        self.model.tool_pose(q)
    }

    /// The Jacobian at `q` (rad): 6 x n, base axes, at the tool point.
    pub fn jacobian(&mut self, q: &[f64]) -> &Matrix6xX<f64> {
        self.model.tool_pose(q);
        self.model.jacobian()
    }

    /// How far the tool at `q` (rad) lies from where it would be without the part `turned` (rad) of `q` (m, base frame).
    pub fn tool_shift(&mut self, q: &[f64], turned: &[f64]) -> Vector3<f64> {
        let with = self.model.tool_pose(q).translation.vector;
        for (posture, (q, part)) in self.posture.iter_mut().zip(q.iter().zip(turned)) {
            *posture = q - part;
        }
        with - self.model.tool_pose(&self.posture).translation.vector
    }
}
