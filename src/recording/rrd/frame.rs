//! What a picture holds: from how near all of some points are in it.

use nalgebra::{Point3, Vector3};

/// Half the height of a picture at a distance of 1: the viewer's eye sees 55 degrees from top to bottom.
pub(super) const HALF_HEIGHT: f64 = 0.5206;

/// What should be seen is at most so far from the middle, to either side, upwards, and downwards, where there are words, as shares of half the
/// picture's height. Usual pictures are a third wider than they are high.
const ASIDE: f64 = 1.15 * HALF_HEIGHT;
const ABOVE: f64 = 0.88 * HALF_HEIGHT;
const BELOW: f64 = 0.7 * HALF_HEIGHT;

/// How much of the room above and below is above.
const ROOM_ABOVE: f64 = 0.7;

/// How a picture lies in space when it is seen along a direction: what is at its right, at its top, and before it (unit vectors, world).
pub(super) struct Frame {
    right: Vector3<f64>,
    up: Vector3<f64>,
    before: Vector3<f64>,
}

impl Frame {
    /// Of an eye that is in the direction of `view` from what it sees; not straight above it.
    pub fn seen_from(view: &Vector3<f64>) -> Self {
        let before = view.normalize();
        let right = Vector3::z().cross(&before).normalize();
        Self { right, up: before.cross(&right), before }
    }

    /// How far a point (world) is to the right and up in the picture of an eye, as shares of its distance along the sight; none behind it.
    pub fn seen(&self, eye: &Vector3<f64>, point: &Point3<f64>) -> Option<[f64; 2]> {
        let to = point.coords - eye;
        let distance = -self.before.dot(&to);
        (distance > 0.0).then(|| [&self.right, &self.up].map(|axis| axis.dot(&to) / distance))
    }

    /// The nearest eye for which all points are in the picture, at least `nearest_m` from their middle, and what it looks at (m, world): along
    /// its sight as far as that middle.
    pub fn around(&self, points: &[Point3<f64>], nearest_m: f64) -> (Vector3<f64>, Vector3<f64>) {
        // A point at height y before the picture's plane by z is seen below the edge if y - eye_y <= edge (eye_z - z).
        let farthest = |axis: &Vector3<f64>, edge: f64| {
            let reach = |point: &Point3<f64>| axis.dot(&point.coords) + edge * self.before.dot(&point.coords);
            points.iter().map(reach).reduce(f64::max).unwrap_or(0.0)
        };
        let sides = [farthest(&self.right, ASIDE), farthest(&-self.right, ASIDE)];
        let [above, below] = [farthest(&self.up, ABOVE), farthest(&-self.up, BELOW)];
        let middle = points.iter().map(|point| self.before.dot(&point.coords)).sum::<f64>() / points.len().max(1) as f64;
        let room = [(sides[0] + sides[1]) / (2.0 * ASIDE), (above + below) / (ABOVE + BELOW), middle + nearest_m];
        let away = room.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let aside = (sides[0] - sides[1]) / 2.0;
        // Room that is left is above, where the arm is.
        let [lowest, highest] = [above - ABOVE * away, BELOW * away - below];
        let up = lowest + ROOM_ABOVE * (highest - lowest);
        let eye = self.right * aside + self.up * up + self.before * away;
        (eye, eye - self.before * (away - middle))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Contract: all points are in the picture, and from nearer they would not be.
    #[test]
    fn a_picture_holds_its_points_and_is_taken_from_near() {
        let points: Vec<Point3<f64>> =
            (0..60).map(|i| f64::from(i) * 0.7).map(|a| Point3::new(0.5 + a.sin(), (1.3 * a).cos(), 0.2 * (2.1 * a).sin())).collect();
        for view in [Vector3::new(1.0, 0.6, 0.3), Vector3::new(0.2, -0.3, 1.0), Vector3::new(-0.5, 1.0, 0.7)] {
            let frame = Frame::seen_from(&view);
            let (eye, target) = frame.around(&points, 0.4);
            let holds = |eye: &Vector3<f64>, slack: f64| {
                points
                    .iter()
                    .filter_map(|point| frame.seen(eye, point))
                    .all(|[aside, up]| aside.abs() < ASIDE + slack && up < ABOVE + slack && up > -BELOW - slack)
            };
            assert!(holds(&eye, 1e-9) && !holds(&(eye + 0.05 * (target - eye)), 1e-9), "{eye} {target}");
            assert!((target - eye).normalize().dot(&view.normalize()) < -1.0 + 1e-9);
            assert!((frame.around(&points, 50.0).0 - frame.around(&points, 50.0).1).norm() > 49.0);
        }
    }
}
