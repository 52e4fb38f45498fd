//! The way on which a door leads its handle.

use nalgebra::{Isometry3, Point3};

use crate::world::{Object, ObjectKind, Parameters, door_turn, support_height_m};

/// Points of an arc.
const POINTS: usize = 61;

/// The way of a cabinet's handle in use about the hinge.
pub(super) struct Arc {
    /// The hinge, whose axis is z (world).
    hinge: Isometry3<f64>,
    radius_m: f64,
    /// From the closed door to the open one (m, world).
    pub points: Vec<Point3<f64>>,
}

impl Arc {
    /// That of an object of a scene, if it is a cabinet.
    pub fn of(object: &Object, objects: &[Object], parameters: &Parameters) -> Option<Self> {
        let ObjectKind::Cabinet(cabinet) = &object.kind else { return None };
        let hinge = object.pose(parameters, support_height_m(objects, object, parameters));
        let hinge_y_m = hinge.translation.y;
        let handle = cabinet.handle(hinge_y_m, parameters);
        let opening = |k: usize| cabinet.opening_max_rad * k as f64 / (POINTS - 1) as f64;
        let points = (0..POINTS).map(|k| hinge * (door_turn(opening(k)) * handle)).collect();
        Some(Self { hinge, radius_m: cabinet.arc_radius_m(hinge_y_m, parameters), points })
    }

    /// How far a place (m, world) is outside of it (m), seen along the hinge; inside is negative.
    pub fn outside_m(&self, place: &Point3<f64>) -> f64 {
        self.hinge.inverse_transform_point(place).coords.xy().norm() - self.radius_m
    }
}
