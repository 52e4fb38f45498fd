//! Objects that are drawn so that what is behind them or in them can be seen.

use nalgebra::Point3;

use super::camera::Camera;
use super::then::Scene;
use super::workplace::{Moment, Workplace};
use crate::world::{ObjectKind, Shapes};

/// An object that hides a larger share of the ways at some moment is translucent.
const HIDES: f64 = 0.2;

/// The objects, by their index, that would hide much of the ways from a camera: where they start, or at some moment of the work. What everything
/// stands on is none of them.
pub(super) fn before(camera: &Camera, work: &Workplace, scene: &Scene<'_>) -> Vec<usize> {
    let (eye, ways) = (Point3::from(camera.eye), work.looked_for());
    let start = Moment::default();
    let hides = |index: &usize| {
        let object = &scene.objects[*index];
        let much = |moment: &Moment| {
            let shapes = Shapes::of_objects([(object, moment.objects.get(*index).copied())], scene.objects, scene.parameters);
            shapes.hidden(&eye, &ways) as f64 > HIDES * ways.len() as f64
        };
        !matches!(object.kind, ObjectKind::Table { .. }) && std::iter::once(&start).chain(&work.moments).any(much)
    };
    (0..scene.objects.len()).filter(hides).collect()
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry3, Vector2, Vector3};

    use super::*;
    use crate::world::{Object, Parameters, Quantity};

    /// Contract: what hides much of the ways where it starts or where it comes is seen through; what does not is not, and neither is what everything
    /// stands on.
    #[test]
    fn what_hides_the_ways_is_seen_through() {
        let friction = || Quantity::Value(0.5);
        let wall = |name: &str, y: f64| {
            let kind = ObjectKind::Basket {
                inner_size_m: Vector2::new(0.02, 0.5),
                wall_height_m: 0.6,
                wall_thickness_m: 0.01,
                friction: friction(),
            };
            Object::new(name, Vector2::new(0.8, y), kind)
        };
        let table = ObjectKind::Table { size_m: Vector2::new(0.9, 9.0), top_height_m: 0.0, friction: friction() };
        let objects = [wall("before", 0.2), wall("beside", 4.0), Object::new("table", Vector2::new(0.8, 0.0), table)];
        let tool = |y: f64| Vector3::new(0.5, y, 0.2);
        let seen = |eye_z: f64, poses: [Vec<Isometry3<f64>>; 2]| {
            let moments = poses.into_iter().zip([0.0, 0.4]).map(|(objects, y)| Moment { tool: tool(y), objects, bodies: Vec::new() });
            let camera = Camera { eye: Vector3::new(2.0, 0.2, eye_z), target: tool(0.2), words: 1.0, share: 1.0 };
            let scene = Scene { objects: &objects, parameters: &Parameters::default(), bodies: &[] };
            before(&camera, &Workplace::around(moments.collect()), &scene)
        };
        let there = |y: f64| Isometry3::translation(0.8, y, 0.0);
        assert_eq!(seen(0.3, [Vec::new(), Vec::new()]), [0]);
        assert_eq!(seen(0.3, [vec![there(0.2), there(4.0)], vec![there(0.2), there(0.3)]]), [0, 1], "it comes before them");
        assert!(seen(2.5, [Vec::new(), Vec::new()]).is_empty(), "over the wall");
        assert!(seen(-2.0, [Vec::new(), Vec::new()]).is_empty(), "from below the table");
    }
}
