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
        let (rest, idle_rest) = ("robot.rest_posture_rad", "robot.idle_posture_rad");
        let working = self.beyond_limits(rest, &settings.rest_posture_rad, 0.0).into_iter().map(|told| (rest, told));
        let idle = self.idle().into_iter().flat_map(ArmModel::chain_joints).zip(settings.idle_posture_rad.iter().copied());
        let idle = beyond(idle_rest, idle, 0.0).into_iter().map(|told| (idle_rest, told));
        SimulationError::all(working.chain(idle).map(|(key, told)| SimulationError::JointLimits(vec![told]).at(key)).collect())
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
