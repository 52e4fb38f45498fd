//! Objects that are drawn so that what is behind them or in them can be seen.

use nalgebra::Point3;

use super::camera::Camera;
use super::then::Scene;
use super::workplace::{Moment, Workplace};
use crate::world::{ObjectKind, Shapes};

/// An object that hides a larger share of the ways at some moment is translucent.
const HIDES: f64 = 0.2;

/// So many places of all ways are looked for.
const LOOKED_FOR: usize = 160;

/// The objects, by their index, that would hide much of the ways from a camera: where they start, or at some moment of the work. What everything
/// stands on is none of them.
pub(super) fn before(camera: &Camera, work: &Workplace, scene: &Scene<'_>) -> Vec<usize> {
    let eye = Point3::from(camera.eye);
    let every = work.places.len().div_ceil(LOOKED_FOR).max(1);
    let ways: Vec<Point3<f64>> = work.places.iter().step_by(every).copied().map(Point3::from).collect();
    let start = Moment::default();
    let hides = |index: &usize| {
        let object = &scene.objects[*index];
        let at = |moment: &Moment| {
            let shapes = Shapes::of_objects([(object, moment.objects.get(*index).copied())], scene.objects, scene.parameters);
            shapes.hidden(&eye, &ways) as f64
        };
        let most = std::iter::once(&start).chain(&work.moments).map(at).fold(0.0, f64::max);
        !matches!(object.kind, ObjectKind::Table { .. }) && most > HIDES * ways.len() as f64
    };
    (0..scene.objects.len()).filter(hides).collect()
}
