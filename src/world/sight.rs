//! What can be seen from where: for pictures only, no controller looks.

use nalgebra::{Isometry3, Point3};
use parry3d_f64::query::Ray;

use super::scene::collider;
use super::{Object, ObjectPart, Parameters, convert, fixed_parts, object_parts, support_height_m};

/// How many of `points` an object of a scene hides from an eye at `from` (m, world). The objects are where `poses` says (`world_from_object`,
/// in their order, of a cabinet its door), those that it does not name at their start. The robot hides nothing.
#[must_use]
pub fn hidden_count(
    objects: &[Object],
    parameters: &Parameters,
    poses: &[Isometry3<f64>],
    from: &Point3<f64>,
    points: &[Point3<f64>],
) -> usize {
    let shapes: Vec<_> = objects
        .iter()
        .enumerate()
        .flat_map(|(index, object)| {
            let start = object.pose(parameters, support_height_m(objects, object, parameters));
            let pose = poses.get(index).copied().unwrap_or(start);
            let at = |pose: Isometry3<f64>| move |part: ObjectPart| (convert::pose(&pose), collider(&part).build());
            object_parts(object, parameters).into_iter().map(at(pose)).chain(fixed_parts(object).into_iter().map(at(start)))
        })
        .collect();
    let hides = |point: &Point3<f64>| {
        let ray = Ray::new(convert::vector(&from.coords), convert::vector(&(point - from)));
        shapes.iter().any(|(pose, part)| part.shape().intersects_ray(&(*pose * *part.position()), &ray, 1.0))
    };
    points.iter().filter(|point| hides(point)).count()
}

#[cfg(test)]
mod tests {
    use nalgebra::{Vector2, Vector3};

    use super::*;
    use crate::world::{ObjectKind, Quantity};

    #[test]
    fn what_is_behind_a_table_top_is_hidden_and_what_is_above_is_not() {
        let kind = ObjectKind::Table { top_height_m: 0.5, size_m: Vector2::new(1.0, 1.0), friction: Quantity::Value(0.5) };
        let table = Object::new("table", Vector2::zeros(), kind);
        let eye = Point3::new(0.0, 0.0, 2.0);
        let points = [0.7, 0.3].map(|z| Point3::from(Vector3::new(0.1, 0.1, z)));
        let hidden = |poses: &[Isometry3<f64>]| hidden_count(std::slice::from_ref(&table), &Parameters::default(), poses, &eye, &points);
        assert_eq!(hidden(&[]), 1);
        assert_eq!(hidden(&[Isometry3::translation(0.0, 0.0, 1.0)]), 2, "raised above both");
        assert_eq!(hidden(&[Isometry3::translation(5.0, 0.0, 0.5)]), 0, "moved aside");
    }
}
