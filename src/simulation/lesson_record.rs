//! What a lesson looked like, for those who want to see it again.

use nalgebra::{Isometry3, Vector3};

use super::AppliedForce;
use crate::world::Parameters;

/// Looks per second at a lesson (Hz): what a film of it needs.
pub const LOOKS_HZ: f64 = 10.0;

/// One lesson as it was led.
#[derive(Clone, Debug, PartialEq)]
pub struct LessonRecord {
    /// The name of its demonstration.
    pub name: String,
    /// The setting in which it was led.
    pub parameters: Parameters,
    /// Which way-point it missed, in words, if it did.
    pub astray: Option<String>,
    /// What was to be seen, [`LOOKS_HZ`] times a second.
    pub looks: Vec<LessonLook>,
}

/// A moment of a lesson. World frame, SI.
#[derive(Clone, Debug, PartialEq)]
pub struct LessonLook {
    /// Time since the start of the lesson (s).
    pub time_s: f64,
    /// Where the tool frame (grasp centre) is (m).
    pub tool: Vector3<f64>,
    /// Commanded opening of the gripper (0 closed … 1 open).
    pub gripper_command: f64,
    /// What the person does.
    pub human: AppliedForce,
    /// Poses of the robot's bodies in the order of [`crate::robot::RobotModel::bodies`].
    pub bodies: Vec<Isometry3<f64>>,
    /// Poses of the scene's objects in the order of the experiment.
    pub objects: Vec<Isometry3<f64>>,
}
