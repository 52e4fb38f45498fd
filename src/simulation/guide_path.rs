//! Where a person wants the gripper to be: a smooth way through way-points, a little different each time.
//!
//! A way-point may be at an opening of a door. The way is then thought out with the door closed, the opening being one more coordinate of it,
//! and carried along with the door: between two openings of one door it is an arc about its hinge. From one open door to another there is no
//! such way: a way-point at no opening lies between them.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3, Vector4};
use rand_chacha::ChaCha8Rng;

use super::{TeachingPlan, Waypoint};
use crate::math;
use crate::world::{Object, ObjectKind, Parameters, door_turn, support_height_m, tool_orientation};

/// A way through knots: quintic Hermite segments with zero acceleration at the knots (minimum jerk between two rests) and velocities that
/// never overshoot a knot.
#[derive(Clone, Debug)]
pub(super) struct GuidePath {
    times_s: Vec<f64>,
    /// Place with the door closed (m), and the door's opening (rad).
    points: Vec<Vector4<f64>>,
    velocities: Vec<Vector4<f64>>,
    /// Openings commanded from each knot on.
    gripper: Vec<f64>,
    /// Of each knot at which a door is open: a point on that door's hinge (m).
    hinges: Vec<Option<Vector3<f64>>>,
    /// Orientation with the door closed, and how far it turns with the door (0 … 1).
    orientation: UnitQuaternion<f64>,
    turns_with_door: f64,
}

/// Where the gripper should be at a moment.
#[derive(Clone, Copy, Debug)]
pub(super) struct GuidePoint {
    /// `world_from_tool`.
    pub pose: Isometry3<f64>,
    /// Velocity of the tool (m/s, world).
    pub linear_velocity: Vector3<f64>,
    /// Its angular velocity (rad/s, world).
    pub angular_velocity: Vector3<f64>,
    /// The opening that is commanded to the gripper.
    pub gripper: f64,
}

impl GuidePath {
    /// The way of one demonstration in the setting `parameters`; `variation` draws how this one differs from the others.
    pub(super) fn new(plan: &TeachingPlan, objects: &[Object], parameters: &Parameters, variation: &mut ChaCha8Rng) -> Self {
        let mut path = Self {
            times_s: Vec::new(),
            points: Vec::new(),
            velocities: Vec::new(),
            gripper: Vec::new(),
            hinges: Vec::new(),
            orientation: tool_orientation(plan.tool_yaw_rad, plan.tool_pitch_rad, plan.tool_roll_rad),
            turns_with_door: plan.turns_with_door,
        };
        let mut gripper = 1.0;
        let mut dwell: Option<(&Waypoint, Vector4<f64>)> = None;
        for waypoint in &plan.waypoints {
            let place = anchor(waypoint, objects, parameters) + Vector3::from(waypoint.offset_m);
            let draw = Vector3::from_fn(|_, _| plan.position_spread_m * bounded_normal(variation));
            // A dwell (the same place twice) keeps its place.
            let point = match dwell {
                Some((last, at)) if same_place(last, waypoint) => at,
                _ => (place + draw).push(waypoint.opening_rad.unwrap_or(0.0)),
            };
            dwell = Some((waypoint, point));
            let shift = plan.timing_spread * plan.duration_s * bounded_normal(variation);
            path.times_s.push(waypoint.time_s + if waypoint.time_s > 0.0 { shift } else { 0.0 });
            path.points.push(point);
            path.hinges.push(hinge(waypoint, objects, parameters));
            gripper = waypoint.gripper.unwrap_or(gripper);
            path.gripper.push(gripper);
        }
        path.keep_order(plan);
        path.velocities = knot_velocities(&path.times_s, &path.points);
        path
    }

    /// Times keep rising, by at least a third of what the plan says, and end where the plan ends.
    fn keep_order(&mut self, plan: &TeachingPlan) {
        for i in 1..self.times_s.len() {
            let least = (plan.waypoints[i].time_s - plan.waypoints[i - 1].time_s) / 3.0;
            self.times_s[i] = self.times_s[i].max(self.times_s[i - 1] + least);
        }
        let last = self.times_s.last().copied().unwrap_or(0.0);
        if last > plan.duration_s {
            self.times_s.iter_mut().for_each(|t| *t *= plan.duration_s / last);
        }
    }

    /// When this way comes to each of the plan's way-points (s).
    pub(super) fn times_s(&self) -> &[f64] {
        &self.times_s
    }

    /// Where the gripper should be at `time_s`; before the first and after the last knot at the ends.
    pub(super) fn at(&self, time_s: f64) -> GuidePoint {
        let after = self.times_s.partition_point(|t| *t <= time_s);
        if after == 0 || after == self.times_s.len() {
            let end = after.saturating_sub(1);
            return self.carried(self.points[end], Vector4::zeros(), self.hinges[end], self.gripper[end]);
        }
        let (a, b) = (after - 1, after);
        let span = self.times_s[b] - self.times_s[a];
        let r = (time_s - self.times_s[a]) / span;
        let (p, v) = quintic(r, span, (self.points[a], self.velocities[a]), (self.points[b], self.velocities[b]));
        self.carried(p, v, self.hinges[a].or(self.hinges[b]), self.gripper[a])
    }

    /// A place of the closed door (m, and the opening in rad) with its velocity, carried along with the door about `hinge` (m). Where no door
    /// is open, there is none and no need of one.
    fn carried(&self, point: Vector4<f64>, velocity: Vector4<f64>, hinge: Option<Vector3<f64>>, gripper: f64) -> GuidePoint {
        let hinge = hinge.unwrap_or_default();
        let turn = door_turn(point.w);
        let angular_velocity = -Vector3::z() * velocity.w;
        let arm = turn * (point.xyz() - hinge);
        let pose = Isometry3::from_parts(Translation3::from(hinge + arm), door_turn(self.turns_with_door * point.w) * self.orientation);
        let linear_velocity = turn * velocity.xyz() + angular_velocity.cross(&arm);
        GuidePoint { pose, linear_velocity, angular_velocity: self.turns_with_door * angular_velocity, gripper }
    }
}

fn same_place(a: &Waypoint, b: &Waypoint) -> bool {
    a.at == b.at && a.offset_m == b.offset_m && a.opening_rad == b.opening_rad
}

/// A point on the hinge of the door at which the way-point lies (m); none when that door is closed, or it lies at no door.
fn hinge(waypoint: &Waypoint, objects: &[Object], parameters: &Parameters) -> Option<Vector3<f64>> {
    waypoint.opening_rad.filter(|opening| *opening != 0.0)?;
    let door = objects.iter().find(|object| Some(&object.name) == waypoint.at.as_ref())?;
    matches!(door.kind, ObjectKind::Cabinet(_)).then(|| door.center(parameters).push(0.0))
}

/// The quintic from `a` to `b` (place, velocity; zero acceleration at both) at fraction `r` of `span` seconds.
fn quintic(r: f64, span: f64, a: (Vector4<f64>, Vector4<f64>), b: (Vector4<f64>, Vector4<f64>)) -> (Vector4<f64>, Vector4<f64>) {
    let (d, va, vb) = (b.0 - a.0, a.1 * span, b.1 * span);
    let (c3, c4, c5) = (10.0 * d - 6.0 * va - 4.0 * vb, -15.0 * d + 8.0 * va + 7.0 * vb, 6.0 * d - 3.0 * va - 3.0 * vb);
    let place = a.0 + r * (va + r * r * (c3 + r * (c4 + r * c5)));
    let velocity = (va + r * r * (3.0 * c3 + r * (4.0 * c4 + r * 5.0 * c5))) / span;
    (place, velocity)
}

/// Knot velocities: the harmonic mean of the neighbouring slopes, zero where they differ in sign and at the ends (Fritsch and Butland).
fn knot_velocities(times: &[f64], points: &[Vector4<f64>]) -> Vec<Vector4<f64>> {
    let slope = |i: usize| (points[i + 1] - points[i]) / (times[i + 1] - times[i]);
    let harmonic = |a: f64, b: f64| if a * b > 0.0 { 2.0 * a * b / (a + b) } else { 0.0 };
    (0..points.len())
        .map(|i| if i == 0 || i + 1 == points.len() { Vector4::zeros() } else { slope(i - 1).zip_map(&slope(i), harmonic) })
        .collect()
}

/// A standard normal draw within two standard deviations: a person's slips are not unbounded.
fn bounded_normal(random: &mut ChaCha8Rng) -> f64 {
    math::standard_normal(random).clamp(-2.0, 2.0)
}

fn anchor(waypoint: &Waypoint, objects: &[Object], parameters: &Parameters) -> Vector3<f64> {
    let object = waypoint.at.as_ref().and_then(|name| objects.iter().find(|object| &object.name == name));
    object.map_or_else(Vector3::zeros, |object| object.anchor(parameters, support_height_m(objects, object, parameters)).coords)
}
