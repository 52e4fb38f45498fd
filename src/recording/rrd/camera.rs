//! Where a scene is looked at from.

use nalgebra::{Point3, Vector3};

use super::frame::{Frame, HALF_HEIGHT};
use super::then::{Scene, Then};
use super::workplace::Workplace;

/// From the work to the camera, whatever the distance: in front of the robot, at its left, above the table. Then, for work that something stands
/// before: the same from its right, from above, from both sides, over its shoulders, and steeply from above.
const VIEWS: [Vector3<f64>; 14] = [
    Vector3::new(1.10, 0.69, 0.32),
    Vector3::new(1.10, -0.69, 0.32),
    Vector3::new(0.45, 0.75, 1.05),
    Vector3::new(0.45, -0.75, 1.05),
    Vector3::new(0.15, 1.30, 0.45),
    Vector3::new(0.15, -1.30, 0.45),
    Vector3::new(-0.45, 1.0, 0.75),
    Vector3::new(-0.45, -1.0, 0.75),
    Vector3::new(0.3, 0.3, 1.27),
    Vector3::new(0.3, -0.3, 1.27),
    Vector3::new(-0.3, 0.6, 1.15),
    Vector3::new(-0.3, -0.6, 1.15),
    Vector3::new(-0.2, 0.25, 1.3),
    Vector3::new(-0.2, -0.25, 1.3),
];

/// A later view must show so much more, as a share of all that should be seen.
const CLEARLY: f64 = 0.05;

/// Lines and arrows are as thick as they are meant to be at this distance (m).
const DISTANCE_M: f64 = 1.34;

/// No camera is nearer (m).
const NEAREST_M: f64 = 0.28;

/// From the middle of the picture to words, as shares of the distance from the eye: to the side and downwards, so that a long line ends at the
/// picture's edge. Then from one line of words to the next above it, and how far long ones reach to either side.
const WORDS: [f64; 2] = [0.385, 0.46];
const LINE: f64 = 0.048;
const HALF_WORDS: f64 = 0.3;

/// A camera: where it is, and what it looks at (m, world).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Camera {
    /// Where it is.
    pub eye: Vector3<f64>,
    /// What it looks at.
    pub target: Vector3<f64>,
    /// How far it is from the work, as a share of its distance from large work, at most 1: what is not part of the scene is drawn so much
    /// smaller.
    pub share: f64,
    /// Where words are: 1 at the right of the picture, -1 at the left.
    pub words: f64,
}

impl Camera {
    /// The first of a few views in which the arm and the objects hide about as little of the work as in any; the picture holds the work, and is
    /// taken from as near as that.
    pub fn on(work: &Workplace, scene: &Scene<'_>) -> Self {
        let then: Vec<Then> = work.moments.iter().map(|moment| Then::at(moment, work, scene)).collect();
        let ways: Vec<Point3<f64>> = work.places.iter().copied().map(Point3::from).collect();
        let held: Vec<Point3<f64>> = then.iter().flat_map(|then| &then.held).chain(&ways).copied().collect();
        let views = VIEWS.map(|view| Self::holding(&held, view));
        let some = work.looked_for();
        let hidden = views.map(|view| then.iter().map(|then| then.hidden(&view.eye, &some)).sum::<f64>() / then.len().max(1) as f64);
        let least = hidden.iter().copied().fold(f64::INFINITY, f64::min);
        let first = hidden.iter().position(|hidden| *hidden <= least + CLEARLY).unwrap_or(0);
        views[first].beside_words(then.iter().flat_map(|then| &then.bulky).chain(&held))
    }

    /// The nearest camera in the direction of `view` that has all of `points` (world) in its picture.
    fn holding(points: &[Point3<f64>], view: Vector3<f64>) -> Self {
        let frame = Frame::seen_from(&view);
        let (eye, target) = frame.around(points, NEAREST_M);
        Self { eye, target, share: ((eye - target).norm() / DISTANCE_M).min(1.0), words: 1.0 }
    }

    /// The same with words where fewer of `points` (world) are, at the right if in doubt.
    fn beside_words<'a>(self, points: impl Iterator<Item = &'a Point3<f64>>) -> Self {
        let frame = Frame::seen_from(&(self.eye - self.target));
        let [mut left, mut right] = [0_usize; 2];
        for point in points {
            let Some([aside, up]) = frame.seen(&self.eye, point) else { continue };
            let low = (-HALF_HEIGHT..LINE - WORDS[1]).contains(&up);
            let beside = |side: f64| usize::from(low && (side * aside - WORDS[0]).abs() < HALF_WORDS);
            (left, right) = (left + beside(-1.0), right + beside(1.0));
        }
        Self { words: if left < right { -1.0 } else { 1.0 }, ..self }
    }

    /// What is at the right of the picture (world).
    pub fn right(&self) -> Vector3<f64> {
        (self.target - self.eye).cross(&Vector3::z()).normalize()
    }

    /// A place for words (m, world) in a lower corner of the picture; line 0 is the lowest.
    pub fn words(&self, line: usize) -> Vector3<f64> {
        let (sight, right) = (self.target - self.eye, self.right());
        let up = LINE * line as f64 - WORDS[1];
        self.target + sight.norm() * (right * (WORDS[0] * self.words) + right.cross(&sight.normalize()) * up)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry3, Vector2};

    use super::super::workplace::Moment;
    use super::*;
    use crate::world::{Object, ObjectKind, Parameters, Quantity};

    fn work(objects: Vec<Isometry3<f64>>) -> Workplace {
        let places = [Vector3::new(0.6, -0.1, 0.2), Vector3::new(0.6, 0.7, 0.2)];
        Workplace::around(places.map(|tool| Moment { tool, objects: objects.clone(), bodies: Vec::new() }).to_vec())
    }

    fn seen(work: &Workplace, objects: &[Object]) -> Camera {
        Camera::on(work, &Scene { objects, parameters: &Parameters::default(), bodies: &[] })
    }

    /// Which of the views it is.
    fn view(camera: &Camera) -> usize {
        let along = |view: &Vector3<f64>| view.normalize().dot(&(camera.eye - camera.target).normalize());
        VIEWS.iter().position(|view| along(view) > 1.0 - 1e-9).expect("one of the views")
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
        let free = seen(&work(Vec::new()), &[]);
        assert_eq!(view(&free), 0, "{free:?}");
        let kind = ObjectKind::Table { size_m: Vector2::new(0.02, 0.8), top_height_m: 0.05, friction: Quantity::Value(0.5) };
        let before = seen(&work(Vec::new()), &[Object::new("table", Vector2::new(0.8, 0.3), kind)]);
        assert_eq!(before.eye, free.eye, "what is lower hides nothing");
        let around = seen(&work(Vec::new()), &[wall()]);
        assert!(around.eye.x < 0.9 || around.eye.z > 1.0, "the eye looks past the wall or over it: {around:?}");
    }

    /// What counts is where an object is during the work, not where it starts.
    #[test]
    fn a_wall_that_is_moved_away_hides_nothing() {
        let camera = seen(&work(vec![Isometry3::translation(-5.0, 0.0, 0.0)]), &[wall()]);
        assert_eq!(view(&camera), 0, "the eye stays in front: {camera:?}");
    }

    /// How far words reach to the side.
    fn aside_of_end() -> f64 {
        WORDS[0] + HALF_WORDS
    }

    /// Words are in the same corner of every picture, whole, with lines above each other, and at the other side when something is there.
    #[test]
    fn words_are_in_a_corner_of_every_picture() {
        for view in VIEWS {
            let camera = Camera { eye: view, target: Vector3::zeros(), share: 1.0, words: 1.0 };
            let frame = Frame::seen_from(&view);
            for line in 0..4 {
                let [aside, up] = frame.seen(&view, &Point3::from(camera.words(line))).expect("before the eye");
                assert!((aside - WORDS[0]).abs() < 1e-9 && (up + WORDS[1] - LINE * line as f64).abs() < 1e-9, "{aside} {up}");
            }
            assert!(aside_of_end() < HALF_HEIGHT * 808.0 / 598.0, "long words end within a picture of usual shape");
            let there = Point3::from(camera.words(0));
            assert_eq!(camera.beside_words([there].iter()).words, -1.0);
            let other = Camera { words: -1.0, ..camera };
            assert_eq!(other.beside_words([Point3::from(other.words(0))].iter()).words, 1.0);
        }
    }

    /// Contract: the picture holds the way, and is taken from as near as that, but not from within the hand.
    #[test]
    fn small_work_is_seen_from_nearer() {
        let far = seen(&work(Vec::new()), &[]);
        let small = Workplace::around(vec![Moment { tool: Vector3::zeros(), objects: Vec::new(), bodies: Vec::new() }]);
        let near = seen(&small, &[]);
        assert!(near.share < 0.6 * far.share, "{} {}", near.share, far.share);
        assert!((near.eye - near.target).norm() > NEAREST_M - 1e-9);
    }
}
