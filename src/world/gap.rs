//! How far two shapes are apart, or how deep one is in the other, by exact geometry.

use parry3d_f64::query;
use parry3d_f64::shape::Shape;
use rapier3d_f64::prelude::{Pose, Vector};

/// The relation of two shapes at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Gap {
    /// Distance between the shapes; negative when one is inside the other: the length of the shortest way out (m).
    pub distance_m: f64,
    /// Nearest, or deepest, point of the first shape (m, world).
    pub point_a: Vector,
    /// The same of the second shape.
    pub point_b: Vector,
}

impl Gap {
    /// Of shape `a` at `world_from_a` and `b` at `world_from_b`. `None` for shapes of which the geometry library knows no distance.
    pub(super) fn between(world_from_a: &Pose, a: &dyn Shape, world_from_b: &Pose, b: &dyn Shape) -> Option<Self> {
        let contact = query::contact(world_from_a, a, world_from_b, b, f64::MAX).ok()??;
        Some(Self { distance_m: contact.dist, point_a: contact.point1, point_b: contact.point2 })
    }

    /// How deep they are in each other (m); 0 when they are apart.
    pub(super) fn depth_m(&self) -> f64 {
        (-self.distance_m).max(0.0)
    }

    /// The middle between the two points: where they touch (m, world).
    pub(super) fn middle(&self) -> Vector {
        (self.point_a + self.point_b) * 0.5
    }
}
