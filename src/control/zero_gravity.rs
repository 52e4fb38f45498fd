//! Zero gravity: the arm carries its own weight and a person moves it.

use super::{ArmModel, Command, Controller, Observation, Telemetry};

/// Gravity compensation with light damping, as when a person holds the cuff.
pub struct ZeroGravity {
    model: ArmModel,
    damping_nms_per_rad: f64,
    telemetry: Telemetry,
    /// Opening that the person has asked for with the cuff's buttons (0 closed … 1 open).
    pub gripper: f64,
}

impl ZeroGravity {
    /// Zero gravity with this damping at every joint (N m s/rad).
    pub fn new(model: ArmModel, damping_nms_per_rad: f64) -> Self {
        Self { model, damping_nms_per_rad, telemetry: Telemetry::default(), gripper: 1.0 }
    }
}

impl Controller for ZeroGravity {
    fn decide(&mut self, observation: &Observation, command: &mut Command) {
        self.model.gravity_torques(&observation.position, &mut command.joints.torque_nm);
        command.joints.damping_nms_per_rad.fill(self.damping_nms_per_rad);
        command.gripper = self.gripper;
        self.telemetry.reference = self.model.tool_pose(&observation.position);
    }

    fn telemetry(&self) -> &Telemetry {
        &self.telemetry
    }
}
