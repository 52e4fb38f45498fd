//! Where a scene is looked at from.

use nalgebra::{Point3, Vector3};

use crate::world::{Object, Parameters, hidden_count};

/// From the middle of the way of the tool to what the camera looks at (m): between the work and the robot, so that both are seen.
const TARGET_FROM_MIDDLE_M: Vector3<f64> = Vector3::new(-0.2, -0.01, 0.14);

/// From there to the camera (m): in front of the robot, at its left, above the table. Then, for work that something stands before: the same
/// from its right, from both sides, and over both shoulders.
const EYES_FROM_TARGET_M: [Vector3<f64>; 6] = [
    Vector3::new(1.10, 0.69, 0.32),
    Vector3::new(1.10, -0.69, 0.32),
    Vector3::new(0.15, 1.30, 0.45),
    Vector3::new(0.15, -1.30, 0.45),
    Vector3::new(-0.70, 1.00, 0.70),
    Vector3::new(-0.70, -1.00, 0.70),
];

/// How far the places around the middle of the way lie that should be seen too (m).
const AROUND_M: f64 = 0.1;

/// A camera: where it is, and what it looks at (m, world).
#[derive(Clone, Copy, Debug)]
pub(super) struct Camera {
    pub eye: Vector3<f64>,
    pub target: Vector3<f64>,
}

impl Camera {
    /// The first of a few places from which no object hides more than half of the work around `middle`; if there is none, that which hides
    /// least.
    pub fn on(middle: Vector3<f64>, objects: &[Object], parameters: &Parameters) -> Self {
        let target = middle + TARGET_FROM_MIDDLE_M;
        let beside = (0..3).flat_map(|axis| [AROUND_M, -AROUND_M].map(|m| middle + Vector3::ith(axis, m)));
        let points: Vec<Point3<f64>> = std::iter::once(middle).chain(beside).map(Point3::from).collect();
        let hidden = |eye: &Vector3<f64>| hidden_count(objects, parameters, &Point3::from(*eye), &points);
        let eyes = EYES_FROM_TARGET_M.map(|offset| target + offset);
        let seen = eyes.iter().find(|eye| 2 * hidden(eye) <= points.len());
        let eye = seen.or_else(|| eyes.iter().min_by_key(|eye| hidden(eye))).copied().unwrap_or(eyes[0]);
        Self { eye, target }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;
    use crate::world::{ObjectKind, Quantity};

    #[test]
    fn a_wall_before_the_work_is_looked_around() {
        let middle = Vector3::new(0.6, 0.3, 0.2);
        let free = Camera::on(middle, &[], &Parameters::default());
        assert_eq!(free.eye, free.target + EYES_FROM_TARGET_M[0]);
        let kind = ObjectKind::Table { size_m: Vector2::new(0.02, 0.8), top_height_m: 0.2, friction: Quantity::Value(0.5) };
        let below = Object::new("table", Vector2::new(0.8, 0.3), kind);
        assert_eq!(Camera::on(middle, &[below], &Parameters::default()).eye, free.eye, "what is lower hides nothing");
        let basket = |wall_height_m| ObjectKind::Basket {
            inner_size_m: Vector2::new(0.02, 1.5),
            wall_height_m,
            wall_thickness_m: 0.01,
            friction: Quantity::Value(0.5),
        };
        let wall = Object::new("wall", Vector2::new(0.9, 0.3), basket(1.0));
        let around = Camera::on(middle, &[wall], &Parameters::default());
        assert!(around.eye.x < 0.9, "the eye is on the side of the work: {around:?}");
    }
}
