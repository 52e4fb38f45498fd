//! What touched, and how near the rest came.

use schemars::JsonSchema;
use serde::Serialize;

use crate::check::Place;

/// All contacts of one pair.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CollisionReport {
    /// A part of the robot, or an object.
    pub a: String,
    /// The other one.
    pub b: String,
    /// Whether the scene allows it.
    pub allowed: bool,
    /// First time (s).
    pub first_time_s: f64,
    /// Last time (s).
    pub last_time_s: f64,
    /// Deepest penetration (m).
    pub max_depth_m: f64,
    /// When it was deepest (s).
    pub deepest_time_s: f64,
    /// Where: the middle of the two deepest points (m, world).
    pub deepest_point_m: [f64; 3],
    /// Largest normal force (N); `null` when it was not measured: nothing was simulated, or the touch began and ended within a step.
    pub max_force_n: Option<f64>,
    /// Why the contact is allowed; `null` when it is not.
    pub reason: Option<&'static str>,
    /// The key of the scenario that allows it (`object.toy`, `allowed_contact.leaning`).
    pub reason_key: Option<String>,
    /// Where that was typed.
    pub reason_place: Option<Place>,
}

/// The smallest distance to one object.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ClearanceReport {
    /// The nearest part of the robot, or what it holds.
    pub a: String,
    /// The object.
    pub b: String,
    /// The distance (m).
    pub min_distance_m: Option<f64>,
    /// When (s).
    pub time_s: f64,
    /// Nearest point on `a` (m, world).
    pub point_a_m: [f64; 3],
    /// Nearest point on `b` (m, world).
    pub point_b_m: [f64; 3],
}
