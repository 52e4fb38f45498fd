//! The virtual human: a hand that holds the arm's wrist and can do nothing but push and twist it.
//!
//! The hand is a spring and a damper between where the person wants the wrist and where it is, with a cap on force and moment. Because a
//! person looks at the gripper, a slow visual correction shifts the wanted place until the gripper is where it should be.

use nalgebra::{Isometry3, Point3, Unit, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

/// The person's hand.
#[derive(Clone, Debug, PartialEq)]
pub struct HumanSettings {
    /// Stiffness of the hand (N/m), 1 … 5000. Default 600.
    pub stiffness_n_per_m: f64,
    /// Damping of the hand (N s/m), 0 … 500. Default 60.
    pub damping_ns_per_m: f64,
    /// Rotational stiffness of the grip (N m/rad), 0 … 500. Default 30.
    pub rotational_stiffness_nm_per_rad: f64,
    /// Rotational damping of the grip (N m s/rad), 0 … 50. Default 1.5.
    pub rotational_damping_nms_per_rad: f64,
    /// Largest force while teaching (N), 0 … 200. Default 40.
    pub teaching_force_max_n: f64,
    /// Largest moment of the grip (N m), 0 … 50. Default 8.
    pub moment_max_nm: f64,
    /// Rate of the visual correction while leading (1/s), 0 … 20. Default 2.
    pub visual_gain_per_s: f64,
    /// Largest visual correction (m), 0 … 0.5. Default 0.12.
    pub visual_correction_max_m: f64,
    /// How hard a helping hand pushes per metre that the gripper is off (N/m), 0 … 2000. Default 60: gently, the arm is said to comply.
    pub helping_stiffness_n_per_m: f64,
    /// How fast it pushes harder while the gripper stays off (N/(m s)), 0 … 5000. Default 150.
    pub helping_rate_n_per_ms: f64,
    /// How much it holds back while the gripper moves (N s/m), 0 … 500. Default 10.
    pub helping_damping_ns_per_m: f64,
    /// How far a helping person misjudges where an object is, one standard deviation along x and y (m), 0 … 0.1. Default 0.003.
    pub aim_spread_m: f64,
    /// How much one helping person differs from another in strength and reach, one standard deviation as a fraction, 0 … 0.5. Default 0.15.
    pub strength_spread: f64,
}

impl Default for HumanSettings {
    fn default() -> Self {
        Self {
            stiffness_n_per_m: 600.0,
            damping_ns_per_m: 60.0,
            rotational_stiffness_nm_per_rad: 30.0,
            rotational_damping_nms_per_rad: 1.5,
            teaching_force_max_n: 40.0,
            moment_max_nm: 8.0,
            visual_gain_per_s: 2.0,
            visual_correction_max_m: 0.12,
            helping_stiffness_n_per_m: 60.0,
            helping_rate_n_per_ms: 150.0,
            helping_damping_ns_per_m: 10.0,
            aim_spread_m: 0.003,
            strength_spread: 0.15,
        }
    }
}

/// What a hand does to the body it holds: a force at a point and a moment, world axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HandWrench {
    /// Where the hand holds (m, world).
    pub point: Point3<f64>,
    /// Force (N).
    pub force: Vector3<f64>,
    /// Moment (N m).
    pub moment: Vector3<f64>,
}

/// Pose and velocity of the body that is held, at the point where it is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GraspState {
    /// `world_from_grasp`.
    pub pose: Isometry3<f64>,
    /// Velocity of the grasped point (m/s, world).
    pub linear_velocity: Vector3<f64>,
    /// Angular velocity of the body (rad/s, world).
    pub angular_velocity: Vector3<f64>,
}

/// What of a hand changes from step to step: the visual correction (m) and the push that has built up (N).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct HandSnapshot {
    correction: Vector3<f64>,
    push: Vector3<f64>,
}

/// A hand on the wrist.
#[derive(Clone, Debug)]
pub struct Hand {
    settings: HumanSettings,
    /// Where the wanted place is shifted to by what the eyes see, while leading (m).
    correction: Vector3<f64>,
    /// The push that has built up, while helping (N).
    push: Vector3<f64>,
}

impl Hand {
    /// A hand that has just taken hold.
    pub fn new(settings: HumanSettings) -> Self {
        Self { settings, correction: Vector3::zeros(), push: Vector3::zeros() }
    }

    /// What there is to go on from.
    pub fn snapshot(&self) -> HandSnapshot {
        HandSnapshot { correction: self.correction, push: self.push }
    }

    /// Goes on from there.
    pub fn restore(&mut self, from: HandSnapshot) {
        (self.correction, self.push) = (from.correction, from.push);
    }

    /// Leads the grasped wrist to `wanted` (pose and velocity of the same point) while watching `gaze_error`, the vector from where the
    /// gripper is to where it should be (m). Forces are capped by `force_max_n` and the moment by the settings.
    pub fn lead(&mut self, dt_s: f64, grasp: &GraspState, wanted: &GraspState, gaze_error: Vector3<f64>, force_max_n: f64) -> HandWrench {
        self.watch(dt_s, gaze_error);
        let h = &self.settings;
        let offset = wanted.pose.translation.vector + self.correction - grasp.pose.translation.vector;
        let force = h.stiffness_n_per_m * offset + h.damping_ns_per_m * (wanted.linear_velocity - grasp.linear_velocity);
        let turn = (wanted.pose.rotation * grasp.pose.rotation.inverse()).scaled_axis();
        let moment = h.rotational_stiffness_nm_per_rad * turn
            + h.rotational_damping_nms_per_rad * (wanted.angular_velocity - grasp.angular_velocity);
        HandWrench { point: point_of(grasp), force: capped(force, force_max_n), moment: capped(moment, h.moment_max_nm) }
    }

    /// Helps the gripper along `gaze_error` (m, world), as a person corrects an arm that moves by itself: pushes the harder the further and the
    /// longer the gripper is off, and holds back while it moves. Directions in which `gaze_error` is zero are left alone. `strength` (0 … 1) is
    /// how far the hand has taken hold. Never twists.
    pub fn help(&mut self, dt_s: f64, grasp: &GraspState, gaze_error: Vector3<f64>, strength: f64, force_max_n: f64) -> HandWrench {
        let h = &self.settings;
        self.push = capped(self.push + h.helping_rate_n_per_ms * dt_s * strength * gaze_error, force_max_n);
        let care = gaze_error.map(|e| if e == 0.0 { 0.0 } else { 1.0 });
        let held_back = h.helping_damping_ns_per_m * grasp.linear_velocity.component_mul(&care);
        let force = strength * (h.helping_stiffness_n_per_m * gaze_error + self.push - held_back);
        HandWrench { point: point_of(grasp), force: capped(force, force_max_n), moment: Vector3::zeros() }
    }

    fn watch(&mut self, dt_s: f64, gaze_error: Vector3<f64>) {
        let correction = self.correction + self.settings.visual_gain_per_s * dt_s * gaze_error;
        self.correction = capped(correction, self.settings.visual_correction_max_m);
    }
}

/// Orientation of a tool that points straight down with its y axis turned by `yaw_rad` about the vertical (z of the tool is -z of the world).
pub fn pointing_down(yaw_rad: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw_rad) * UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
}

/// Orientation of a tool that points down, is then lifted by `pitch_rad` towards the front (pi/2: it points forward), turned by `yaw_rad`
/// about the vertical, and by `roll_rad` about its own z axis.
pub fn tool_orientation(yaw_rad: f64, pitch_rad: f64, roll_rad: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw_rad)
        * UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -pitch_rad)
        * pointing_down(0.0)
        * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), roll_rad)
}

fn point_of(grasp: &GraspState) -> Point3<f64> {
    Point3::from(grasp.pose.translation.vector)
}

/// `vector`, shortened to `limit` if it is longer.
fn capped(vector: Vector3<f64>, limit: f64) -> Vector3<f64> {
    match Unit::try_new_and_get(vector, 0.0) {
        Some((direction, norm)) if norm > limit => direction.into_inner() * limit,
        _ => vector,
    }
}
