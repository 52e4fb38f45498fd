//! Where a person wants the gripper to be: a smooth way through way-points, a little different each time.

use nalgebra::{Point3, Vector3};
use rand_chacha::ChaCha8Rng;

use super::{TeachingPlan, Waypoint};
use crate::math;
use crate::world::{Object, Parameters, support_height_m};

/// A way through knots: quintic Hermite segments with zero acceleration at the knots (minimum jerk between two rests) and velocities that
/// never overshoot a knot.
#[derive(Clone, Debug)]
pub(super) struct GuidePath {
    times_s: Vec<f64>,
    points: Vec<Vector3<f64>>,
    velocities: Vec<Vector3<f64>>,
    /// Openings commanded from each knot on.
    gripper: Vec<f64>,
}

impl GuidePath {
    /// The way of one demonstration in the setting `parameters`; `variation` draws how this one differs from the others.
    pub(super) fn new(plan: &TeachingPlan, objects: &[Object], parameters: &Parameters, variation: &mut ChaCha8Rng) -> Self {
        let support = support_height_m(objects, parameters);
        let mut path = Self { times_s: Vec::new(), points: Vec::new(), velocities: Vec::new(), gripper: Vec::new() };
        let mut gripper = 1.0;
        let mut dwell: Option<(&Waypoint, Vector3<f64>)> = None;
        for waypoint in &plan.waypoints {
            let mut point = anchor(waypoint, objects, parameters, support) + Vector3::from(waypoint.offset_m);
            let draw = Vector3::from_fn(|_, _| plan.position_spread_m * bounded_normal(variation));
            // A dwell (the same place twice) keeps its place.
            point = match dwell {
                Some((last, at)) if last.at == waypoint.at && last.offset_m == waypoint.offset_m => at,
                _ => point + draw,
            };
            dwell = Some((waypoint, point));
            let shift = plan.timing_spread * plan.duration_s * bounded_normal(variation);
            path.times_s.push(waypoint.time_s + if waypoint.time_s > 0.0 { shift } else { 0.0 });
            path.points.push(point);
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

    /// The places that this way goes through (m), in the order of the plan's way-points.
    pub(super) fn knots(&self) -> &[Vector3<f64>] {
        &self.points
    }

    /// Place (m), velocity (m/s) and commanded opening at `time_s`; before the first and after the last knot the ends.
    pub(super) fn at(&self, time_s: f64) -> (Point3<f64>, Vector3<f64>, f64) {
        let after = self.times_s.partition_point(|t| *t <= time_s);
        if after == 0 || after == self.times_s.len() {
            let end = after.saturating_sub(1);
            return (Point3::from(self.points[end]), Vector3::zeros(), self.gripper[end]);
        }
        let (a, b) = (after - 1, after);
        let span = self.times_s[b] - self.times_s[a];
        let r = (time_s - self.times_s[a]) / span;
        let (p, v) = quintic(r, span, (self.points[a], self.velocities[a]), (self.points[b], self.velocities[b]));
        (Point3::from(p), v, self.gripper[a])
    }
}

/// The quintic from `a` to `b` (place, velocity; zero acceleration at both) at fraction `r` of `span` seconds.
fn quintic(r: f64, span: f64, a: (Vector3<f64>, Vector3<f64>), b: (Vector3<f64>, Vector3<f64>)) -> (Vector3<f64>, Vector3<f64>) {
    let (d, va, vb) = (b.0 - a.0, a.1 * span, b.1 * span);
    let (c3, c4, c5) = (10.0 * d - 6.0 * va - 4.0 * vb, -15.0 * d + 8.0 * va + 7.0 * vb, 6.0 * d - 3.0 * va - 3.0 * vb);
    let place = a.0 + r * (va + r * r * (c3 + r * (c4 + r * c5)));
    let velocity = (va + r * r * (3.0 * c3 + r * (4.0 * c4 + r * 5.0 * c5))) / span;
    (place, velocity)
}

/// Knot velocities: the harmonic mean of the neighbouring slopes, zero where they differ in sign and at the ends (Fritsch and Butland).
fn knot_velocities(times: &[f64], points: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let slope = |i: usize| (points[i + 1] - points[i]) / (times[i + 1] - times[i]);
    let harmonic = |a: f64, b: f64| if a * b > 0.0 { 2.0 * a * b / (a + b) } else { 0.0 };
    (0..points.len())
        .map(|i| if i == 0 || i + 1 == points.len() { Vector3::zeros() } else { slope(i - 1).zip_map(&slope(i), harmonic) })
        .collect()
}

/// A standard normal draw within two standard deviations: a person's slips are not unbounded.
fn bounded_normal(random: &mut ChaCha8Rng) -> f64 {
    math::standard_normal(random).clamp(-2.0, 2.0)
}

fn anchor(waypoint: &Waypoint, objects: &[Object], parameters: &Parameters, support: f64) -> Vector3<f64> {
    let object = waypoint.at.as_ref().and_then(|name| objects.iter().find(|object| &object.name == name));
    object.map_or_else(Vector3::zeros, |object| object.anchor(parameters, support).coords)
}
