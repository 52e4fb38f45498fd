//! Joint impedance with gravity compensation: the arm's inner loop.
//!
//! `tau = g(q) + K (q_ref - q) + D v_ref - D v`. The last term is a damper: it is handed on as a coefficient rather than a torque, because a
//! wrist of 3e-4 kg m² with a useful `D` is unstable when a 1 kHz loop applies `-D v` explicitly, and a real drive damps faster than that.

use crate::robot::JointCommand;

/// Stiffness and damping of one arm's joints, from the shoulder.
#[derive(Clone, Debug, PartialEq)]
pub struct ImpedanceSettings {
    /// Stiffness K of each joint (N m/rad), > 0.
    pub stiffness_nm_per_rad: Vec<f64>,
    /// Damping D of each joint (N m s/rad), >= 0.
    pub damping_nms_per_rad: Vec<f64>,
}

impl ImpedanceSettings {
    /// Writes `tau = g + K (q_ref - q) + D v_ref` and D into `command`. All slices have one entry per joint (rad, rad/s, N m).
    pub fn command(&self, gravity: &[f64], q: &[f64], q_ref: &[f64], v_ref: &[f64], command: &mut JointCommand) {
        for i in 0..q.len() {
            let (k, d) = (self.stiffness_nm_per_rad[i], self.damping_nms_per_rad[i]);
            command.torque_nm[i] = gravity[i] + k * (q_ref[i] - q[i]) + d * v_ref[i];
            command.damping_nms_per_rad[i] = d;
        }
    }
}
