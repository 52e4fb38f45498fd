//! Replays a demonstrated tool trajectory.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use super::{Command, Controller, Observation, PoseTracker, Telemetry, WrenchObserver};

/// A sampled tool path with the gripper's opening.
#[derive(Clone, Debug)]
pub struct ToolPath {
    /// Times (s), rising.
    pub times_s: Vec<f64>,
    /// Tool poses in the base frame.
    pub poses: Vec<Isometry3<f64>>,
    /// Commanded openings (0 closed … 1 open).
    pub gripper: Vec<f64>,
}

impl ToolPath {
    /// Pose and opening at `time_s`, linear between samples (orientation along the great circle); the ends are held.
    pub fn at(&self, time_s: f64) -> (Isometry3<f64>, f64) {
        let after = self.times_s.partition_point(|t| *t <= time_s);
        if after == 0 || after == self.times_s.len() {
            let end = if after == 0 { 0 } else { after - 1 };
            return (self.poses[end], self.gripper[end]);
        }
        let (a, b) = (after - 1, after);
        let r = (time_s - self.times_s[a]) / (self.times_s[b] - self.times_s[a]);
        (interpolate(&self.poses[a], &self.poses[b], r), self.gripper[a])
    }
}

fn interpolate(a: &Isometry3<f64>, b: &Isometry3<f64>, r: f64) -> Isometry3<f64> {
    let place: Vector3<f64> = a.translation.vector.lerp(&b.translation.vector, r);
    let turn: UnitQuaternion<f64> = crate::math::slerp(&a.rotation, &b.rotation, r);
    Isometry3::from_parts(Translation3::from(place), turn)
}

/// Tracks a [`ToolPath`] and estimates the wrench on the way.
pub struct TrajectoryController {
    path: ToolPath,
    tracker: PoseTracker,
    observer: WrenchObserver,
    telemetry: Telemetry,
}

impl TrajectoryController {
    /// Replays `path`, which must not be empty.
    pub fn new(path: ToolPath, tracker: PoseTracker, observer: WrenchObserver) -> Self {
        Self { path, tracker, observer, telemetry: Telemetry::default() }
    }
}

impl Controller for TrajectoryController {
    fn decide(&mut self, observation: &Observation, command: &mut Command) {
        let (reference, gripper) = self.path.at(observation.time_s);
        self.telemetry.wrench = self.observer.observe(observation);
        self.telemetry.reference = reference;
        self.tracker.track(&reference, &observation.position, &mut command.joints);
        command.gripper = gripper;
    }

    fn telemetry(&self) -> &Telemetry {
        &self.telemetry
    }
}
