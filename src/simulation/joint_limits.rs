//! Whether postures lie within the limits of the joints.

use super::SimulationError;
use super::setup::Setup;
use crate::control::ArmModel;
use crate::robot::Joint;

impl Setup {
    /// Whether the postures that the scenario names are postures of the robot's arms.
    ///
    /// # Errors
    /// When they are not: every joint that is beyond a limit.
    pub(super) fn postures_within_limits(&self) -> Result<(), SimulationError> {
        let settings = &self.experiment.robot;
        let mut faults = self.beyond_limits("robot.rest_posture_rad", &settings.rest_posture_rad, 0.0);
        let idle = self.idle().into_iter().flat_map(ArmModel::chain_joints).zip(settings.idle_posture_rad.iter().copied());
        faults.extend(beyond("robot.idle_posture_rad", idle, 0.0));
        if faults.is_empty() { Ok(()) } else { Err(SimulationError::JointLimits(faults)) }
    }

    /// Every joint of the working arm that `posture_rad`, called `what`, puts more than `slack_rad` beyond a limit.
    pub(super) fn beyond_limits(&self, what: &str, posture_rad: &[f64], slack_rad: f64) -> Vec<String> {
        beyond(what, self.working().chain_joints().zip(posture_rad.iter().copied()), slack_rad)
    }
}

fn beyond<'a>(what: &str, joints: impl Iterator<Item = (&'a Joint, f64)>, slack_rad: f64) -> Vec<String> {
    let outside = joints.filter(|(joint, angle)| !(joint.lower - slack_rad..=joint.upper + slack_rad).contains(angle));
    let told = outside.map(|(joint, angle)| {
        let (side, limit) = if angle > joint.upper { ("above its upper", joint.upper) } else { ("below its lower", joint.lower) };
        let (name, range) = (&joint.name, format!("{:.4} to {:.4} rad", joint.lower, joint.upper));
        format!("{what} puts joint `{name}` at {angle:.4} rad, {side} limit of {limit:.4} rad: it turns from {range}")
    });
    told.collect()
}
