//! How a shape moves between two poses when nothing more is known: its centre goes straight and evenly, and it turns evenly.

use parry3d_f64::shape::Shape;
use rapier3d_f64::prelude::{Pose, Vector};

/// A ball around a shape, in the shape's frame: what its points' paths are bounded by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    /// Centre (m).
    pub center: Vector,
    /// Radius (m).
    pub radius_m: f64,
}

impl Ball {
    pub(super) fn around(shape: &dyn Shape) -> Self {
        let ball = shape.compute_local_bounding_sphere();
        Self { center: ball.center, radius_m: ball.radius }
    }

    /// The longest path of a point of the shape (m): that of the centre, and the turn on the largest radius.
    pub(super) fn travel_m(&self, before: &Pose, after: &Pose) -> f64 {
        let path = after.transform_point(self.center) - before.transform_point(self.center);
        path.length() + before.rotation.angle_between(after.rotation) * self.radius_m
    }

    /// The pose at a fraction of the motion.
    pub(super) fn pose(&self, before: &Pose, after: &Pose, fraction: f64) -> Pose {
        let rotation = before.rotation.slerp(after.rotation, fraction);
        let center = before.transform_point(self.center).lerp(after.transform_point(self.center), fraction);
        Pose::from_parts(center - rotation * self.center, rotation)
    }
}
