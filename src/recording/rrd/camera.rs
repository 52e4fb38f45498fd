//! Where a scene is looked at from.

use nalgebra::{Point3, Vector3};

use super::workplace::{Moment, Workplace};
use crate::world::{Object, Parameters, hidden_count};

/// From the middle of the way of the tool to what the camera looks at (m): between the work and the robot, so that both are seen.
const TARGET_FROM_MIDDLE_M: Vector3<f64> = Vector3::new(-0.2, -0.01, 0.14);

/// From there to the camera (m): in front of the robot, at its left, above the table. Then, for work that something stands before: the same
/// from its right, from above, and from both sides.
const EYES_FROM_TARGET_M: [Vector3<f64>; 6] = [
    Vector3::new(1.10, 0.69, 0.32),
    Vector3::new(1.10, -0.69, 0.32),
    Vector3::new(0.45, 0.75, 1.05),
    Vector3::new(0.45, -0.75, 1.05),
    Vector3::new(0.15, 1.30, 0.45),
    Vector3::new(0.15, -1.30, 0.45),
];

/// These distances are for work of this size (m); smaller work is seen from nearer, down to a share of them.
const SIZE_M: f64 = 0.75;
const NEAREST_SHARE: f64 = 0.3;

/// From what the camera looks at to words beside the work: to the right and upwards, as shares of the distance from the eye. Seen from above, the
/// arm is there, and words are below the work. Then from one line of words to the next above it.
const WORDS: [f64; 2] = [0.4, 0.1];
const WORDS_FROM_ABOVE: [f64; 2] = [0.4, -0.43];
const LINE: f64 = 0.055;

/// A camera that looks down by more than this share of its sight's length sees the work from above.
const STEEP: f64 = 0.5;

/// How far the places around the tool lie that should be seen too (m).
const AROUND_M: f64 = 0.1;

/// A camera: where it is, and what it looks at (m, world).
#[derive(Clone, Copy, Debug)]
pub(super) struct Camera {
    pub eye: Vector3<f64>,
    pub target: Vector3<f64>,
    /// How far it is from the work, as a share of its distance from large work: what is not part of the scene is drawn so much smaller.
    pub share: f64,
}

impl Camera {
    /// The first of a few places from which no object hides more than a quarter of the work; if there is none, that which hides least.
    pub fn on(work: &Workplace, objects: &[Object], parameters: &Parameters) -> Self {
        let share = (work.size.norm() / SIZE_M).clamp(NEAREST_SHARE, 1.0);
        let target = work.middle + TARGET_FROM_MIDDLE_M * share;
        // The tool with its surroundings, and the way that it went and will go.
        let way = || work.moments.iter().map(|moment| Point3::from(moment.tool));
        let points: Vec<Vec<Point3<f64>>> =
            work.moments.iter().map(|moment| around(&moment.tool).into_iter().chain(way()).collect()).collect();
        let hidden = |eye: &Vector3<f64>| -> usize {
            let then =
                |(moment, points): (&Moment, &Vec<_>)| hidden_count(objects, parameters, &moment.objects, &Point3::from(*eye), points);
            work.moments.iter().zip(&points).map(then).sum()
        };
        let eyes = EYES_FROM_TARGET_M.map(|offset| target + offset * share);
        let all: usize = points.iter().map(Vec::len).sum();
        let seen = eyes.iter().find(|eye| 4 * hidden(eye) <= all);
        let eye = seen.or_else(|| eyes.iter().min_by_key(|eye| hidden(eye))).copied().unwrap_or(eyes[0]);
        Self { eye, target, share }
    }

    /// What is at the right of the picture (world).
    pub fn right(&self) -> Vector3<f64> {
        (self.target - self.eye).cross(&Vector3::z()).normalize()
    }

    /// A place for words (m, world) at the right, where neither the arm nor its work is; line 0 is the lowest.
    pub fn words(&self, line: usize) -> Vector3<f64> {
        let (sight, right) = (self.target - self.eye, self.right());
        let [aside, up] = if -sight.z > STEEP * sight.norm() { WORDS_FROM_ABOVE } else { WORDS };
        self.target + sight.norm() * (right * aside + right.cross(&sight.normalize()) * (up + LINE * line as f64))
    }
}

/// A place and its surroundings.
fn around(place: &Vector3<f64>) -> Vec<Point3<f64>> {
    let beside = (0..3).flat_map(|axis| [AROUND_M, -AROUND_M].map(|m| place + Vector3::ith(axis, m)));
    std::iter::once(*place).chain(beside).map(Point3::from).collect()
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry3, Vector2};

    use super::*;
    use crate::world::{ObjectKind, Quantity};

    fn work(objects: Vec<Isometry3<f64>>) -> Workplace {
        let places = [Vector3::new(0.6, -0.1, 0.2), Vector3::new(0.6, 0.7, 0.2)];
        Workplace::around(places.map(|tool| Moment { tool, objects: objects.clone() }).to_vec())
    }

    fn wall() -> Object {
        let kind = ObjectKind::Basket {
            inner_size_m: Vector2::new(0.02, 1.5),
            wall_height_m: 1.0,
            wall_thickness_m: 0.01,
            friction: Quantity::Value(0.5),
        };
        Object::new("wall", Vector2::new(0.9, 0.3), kind)
    }

    #[test]
    fn a_wall_before_the_work_is_looked_around() {
        let free = Camera::on(&work(Vec::new()), &[], &Parameters::default());
        assert!((free.eye - free.target - EYES_FROM_TARGET_M[0]).norm() < 1e-12, "{free:?}");
        let kind = ObjectKind::Table { size_m: Vector2::new(0.02, 0.8), top_height_m: 0.2, friction: Quantity::Value(0.5) };
        let below = Object::new("table", Vector2::new(0.8, 0.3), kind);
        let before = Camera::on(&work(Vec::new()), &[below], &Parameters::default());
        assert_eq!(before.eye, free.eye, "what is lower hides nothing");
        let around = Camera::on(&work(Vec::new()), &[wall()], &Parameters::default());
        assert!(around.eye.x < 0.9 || around.eye.z > 1.0, "the eye looks past the wall or over it: {around:?}");
    }

    /// What counts is where an object is during the work, not where it starts.
    #[test]
    fn a_wall_that_is_moved_away_hides_nothing() {
        let away = vec![Isometry3::translation(-5.0, 0.0, 0.0)];
        let camera = Camera::on(&work(away), &[wall()], &Parameters::default());
        assert!((camera.eye - camera.target - EYES_FROM_TARGET_M[0]).norm() < 1e-12, "the eye stays in front: {camera:?}");
    }

    /// Words are as far to the right and as high in every picture that is taken from the side, and in every one from above; lines are above each
    /// other.
    #[test]
    fn words_are_at_the_same_place_of_every_picture() {
        let side = [([1.1, 0.7, 0.3], [0.0; 3]), ([-0.4, 1.3, 0.5], [0.2, 0.1, 0.0])].map(|eye| (eye, WORDS));
        let above = [([0.3, -0.2, 2.0], [0.4, 0.1, 0.1]), ([0.45, 0.75, 1.05], [0.0; 3])].map(|eye| (eye, WORDS_FROM_ABOVE));
        for ((eye, target), place) in side.into_iter().chain(above) {
            let camera = Camera { eye: eye.into(), target: target.into(), share: 1.0 };
            let view = nalgebra::Isometry3::look_at_rh(&camera.eye.into(), &camera.target.into(), &Vector3::z());
            let distance = (camera.target - camera.eye).norm();
            for line in 0..4 {
                let seen = view * Point3::from(camera.words(line));
                let expected = Vector3::new(place[0], place[1] + LINE * line as f64, -1.0) * distance;
                assert!((seen.coords - expected).norm() < 1e-12, "{seen}");
            }
        }
    }

    #[test]
    fn small_work_is_seen_from_nearer() {
        let far = Camera::on(&work(Vec::new()), &[], &Parameters::default());
        let small = Workplace::around(vec![Moment { tool: Vector3::zeros(), objects: Vec::new() }]);
        let near = Camera::on(&small, &[], &Parameters::default());
        let distance = |camera: &Camera| (camera.eye - camera.target).norm();
        assert!((distance(&near) / distance(&far) - NEAREST_SHARE).abs() < 1e-9);
    }
}
