//! What can be seen from where: for pictures only, no controller looks.

use nalgebra::{Isometry3, Point3, Translation3, Vector3};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::query::{Ray, RayCast};
use rapier3d_f64::prelude::{Pose, SharedShape};

use super::scene::collider;
use super::{Object, ObjectPart, Parameters, PartShape, convert, fixed_parts, object_parts, support_height_m};
use crate::robot::{Body, Geometry, Shape};

/// A shape at a pose (world), with the box around it, which most rays miss.
#[derive(Clone)]
struct Placed {
    pose: Pose,
    shape: SharedShape,
    bounds: Aabb,
}

/// Shapes at their places (world) at one moment.
#[derive(Clone, Default)]
pub struct Shapes {
    shapes: Vec<Placed>,
}

impl Shapes {
    /// Of objects of a scene, all of which are `among`. They are where `poses` says (`world_from_object`, in their order, of a cabinet its
    /// door), those that it does not name at their start.
    #[must_use]
    pub fn of_objects<'a>(
        objects: impl IntoIterator<Item = (&'a Object, Option<Isometry3<f64>>)>,
        among: &[Object],
        parameters: &Parameters,
    ) -> Self {
        let parts = objects.into_iter().flat_map(|(object, pose)| {
            let start = object.pose(parameters, support_height_m(among, object, parameters));
            let at = |pose: Isometry3<f64>| move |part: ObjectPart| placed(&pose, &part);
            let moving = object_parts(object, parameters).into_iter().map(at(pose.unwrap_or(start)));
            moving.chain(fixed_parts(object).into_iter().map(at(start)))
        });
        Self { shapes: parts.collect() }
    }

    /// Of a robot whose bodies are at `poses` (`world_from_body`, in their order); those that it does not name are nowhere.
    #[must_use]
    pub fn of_robot(bodies: &[Body], poses: &[Isometry3<f64>]) -> Self {
        let of_body = |(body, pose): (&Body, &Isometry3<f64>)| {
            let pose = *pose;
            body.collisions.iter().map(move |geometry| placed(&pose, &bulk(geometry))).collect::<Vec<_>>()
        };
        Self { shapes: bodies.iter().zip(poses).flat_map(of_body).collect() }
    }

    /// These and others.
    #[must_use]
    pub fn with(mut self, others: Self) -> Self {
        self.shapes.extend(others.shapes);
        self
    }

    /// How many of `points` they hide from an eye at `from` (m, world).
    #[must_use]
    pub fn hidden(&self, from: &Point3<f64>, points: &[Point3<f64>]) -> usize {
        let hides = |point: &Point3<f64>| {
            let ray = Ray::new(convert::vector(&from.coords), convert::vector(&(point - from)));
            self.shapes
                .iter()
                .any(|placed| placed.bounds.intersects_local_ray(&ray, 1.0) && placed.shape.intersects_ray(&placed.pose, &ray, 1.0))
        };
        points.iter().filter(|point| hides(point)).count()
    }

    /// The corners of the boxes around them (m, world).
    #[must_use]
    pub fn corners(&self) -> Vec<Point3<f64>> {
        let of_shape =
            |placed: &Placed| placed.shape.compute_local_aabb().vertices().map(|corner| convert::point_back(placed.pose * corner));
        self.shapes.iter().flat_map(of_shape).collect()
    }
}

/// A part of something at a pose.
fn placed(pose: &Isometry3<f64>, part: &ObjectPart) -> Placed {
    let collider = collider(part).build();
    let (pose, shape) = (convert::pose(pose) * *collider.position(), collider.shared_shape().clone());
    Placed { bounds: shape.compute_aabb(&pose), pose, shape }
}

/// The shape of a link, or the box around its mesh.
fn bulk(geometry: &Geometry) -> ObjectPart {
    let (middle, shape) = match &geometry.shape {
        Shape::Box { half_extents } => (Vector3::zeros(), PartShape::Box(*half_extents)),
        Shape::Sphere { radius } => (Vector3::zeros(), PartShape::Ball(*radius)),
        Shape::Cylinder { radius, half_length } => (Vector3::zeros(), PartShape::Cylinder(*radius, 2.0 * half_length)),
        Shape::Mesh { vertices, .. } => {
            let first = vertices.first().copied().unwrap_or_default();
            let ends = |(low, high): (Vector3<f64>, Vector3<f64>), vertex: &[f64; 3]| {
                (low.inf(&Vector3::from(*vertex)), high.sup(&Vector3::from(*vertex)))
            };
            let (low, high) = vertices.iter().fold((first.into(), first.into()), ends);
            ((low + high) / 2.0, PartShape::Box((high - low) / 2.0))
        }
    };
    ObjectPart { name: "", object_from_part: geometry.body_from_geometry * Translation3::from(middle), shape }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;
    use crate::robot::baxter;
    use crate::world::{ObjectKind, Quantity};

    #[test]
    fn what_is_behind_a_table_top_is_hidden_and_what_is_above_is_not() {
        let kind = ObjectKind::Table { top_height_m: 0.5, size_m: Vector2::new(1.0, 1.0), friction: Quantity::Value(0.5) };
        let table = [Object::new("table", Vector2::zeros(), kind)];
        let eye = Point3::new(0.0, 0.0, 2.0);
        let points = [0.7, 0.3].map(|z| Point3::new(0.1, 0.1, z));
        let at = |pose: Option<Isometry3<f64>>| Shapes::of_objects([(&table[0], pose)], &table, &Parameters::default());
        assert_eq!(at(None).hidden(&eye, &points), 1);
        assert_eq!(at(Some(Isometry3::translation(0.0, 0.0, 1.0))).hidden(&eye, &points), 2, "raised above both");
        assert_eq!(at(Some(Isometry3::translation(5.0, 0.0, 0.5))).hidden(&eye, &points), 0, "moved aside");
    }

    /// What is in the robot is hidden by it, what stands away from it is not; all of it is between its corners.
    #[test]
    fn a_robot_hides_what_is_in_it() {
        let bodies = baxter().model.bodies;
        let poses: Vec<Isometry3<f64>> = (0..bodies.len()).map(|i| Isometry3::translation(0.0, 10.0 * i as f64, 0.0)).collect();
        let robot = Shapes::of_robot(&bodies, &poses);
        let corners = robot.corners();
        assert!(corners.len() > 8 * 8);
        let middle = corners[..8].iter().fold(Vector3::zeros(), |sum, corner| sum + corner.coords / 8.0);
        let eye = Point3::new(0.0, -30.0, 0.0);
        assert_eq!(robot.hidden(&eye, &[Point3::from(middle), Point3::new(0.0, -10.0, 0.0)]), 1);
    }
}
