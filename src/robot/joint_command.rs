//! What the joints of an arm are told in one step.

/// A torque for each joint, and the damping that its drive realises on top of it.
#[derive(Clone, Debug, PartialEq)]
pub struct JointCommand {
    /// Torque without the damping term (N m).
    pub torque_nm: Vec<f64>,
    /// Damping of each joint (N m s/rad); the drive delivers `torque - damping * velocity`.
    pub damping_nms_per_rad: Vec<f64>,
}

impl JointCommand {
    /// A command for `joints` joints: no torque, no damping.
    pub fn zero(joints: usize) -> Self {
        Self { torque_nm: vec![0.0; joints], damping_nms_per_rad: vec![0.0; joints] }
    }
}
