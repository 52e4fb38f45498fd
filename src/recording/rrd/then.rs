//! What there is to see at a moment of the work.

use nalgebra::{Point3, Vector3};

use super::workplace::{Moment, Workplace};
use crate::robot::Body;
use crate::world::{Object, ObjectKind, Parameters, Shapes};

/// Of the arm, what is at most so far from the tool should be in the picture: as a share of the work's size, and at most (m).
const ARM_SHARE: f64 = 1.0;
const ARM_M: f64 = 0.6;

/// How far the places around the tool lie that should not be hidden (m), and those that should be in the picture.
const AROUND_M: f64 = 0.1;
const HELD_M: f64 = 0.04;

/// Objects that the tool comes so near to, each way (m), belong to the work.
const NEAR_M: f64 = 0.15;

/// What is looked at: the objects of a scene, and the bodies of a robot.
pub(super) struct Scene<'a> {
    /// The objects.
    pub objects: &'a [Object],
    /// What their sizes and places refer to.
    pub parameters: &'a Parameters,
    /// The robot's bodies.
    pub bodies: &'a [Body],
}

/// What there is at a moment of the work.
pub(super) struct Then {
    /// All that may stand before something.
    shapes: Shapes,
    /// The tool and its surroundings (m, world).
    tool: Vec<Point3<f64>>,
    /// What should be in the picture: objects, the tool, and the arm near it (m, world).
    pub held: Vec<Point3<f64>>,
    /// The corners of the arm (m, world).
    pub bulky: Vec<Point3<f64>>,
}

impl Then {
    /// At a moment of the work in a scene.
    pub fn at(moment: &Moment, work: &Workplace, scene: &Scene<'_>) -> Self {
        let Scene { objects, parameters, bodies } = *scene;
        let posed = |index: usize| (&objects[index], moment.objects.get(index).copied());
        let all = Shapes::of_objects((0..objects.len()).map(posed), objects, parameters);
        let robot = Shapes::of_robot(bodies, &moment.bodies);
        let tool = around(&moment.tool, AROUND_M);
        // What everything stands on goes on beyond the picture.
        let things = (0..objects.len()).filter(|index| !matches!(objects[*index].kind, ObjectKind::Table { .. }));
        let near = things.map(|index| Shapes::of_objects([posed(index)], objects, parameters).corners());
        let mut held: Vec<Point3<f64>> = near.filter(|corners| is_near(corners, &work.places)).flatten().collect();
        let arm_m = (ARM_SHARE * work.size.norm()).min(ARM_M);
        let arm = moment.bodies.iter().map(|pose| Point3::from(pose.translation.vector));
        held.extend(arm.filter(|place| (place.coords - moment.tool).norm() <= arm_m));
        held.extend(around(&moment.tool, HELD_M));
        let bulky = robot.corners();
        Self { shapes: all.with(robot), tool, held, bulky }
    }

    /// Which share of the tool's surroundings or of the ways is hidden from an eye (m, world): of what is hidden more.
    pub fn hidden(&self, eye: &Vector3<f64>, ways: &[Point3<f64>]) -> f64 {
        let share = |points: &[Point3<f64>]| self.shapes.hidden(&Point3::from(*eye), points) as f64 / points.len().max(1) as f64;
        share(&self.tool).max(share(ways))
    }
}

/// Whether the box around some corners is near a place.
fn is_near(corners: &[Point3<f64>], places: &[Vector3<f64>]) -> bool {
    let Some(first) = corners.first().map(|corner| corner.coords) else { return false };
    let ends = |(low, high): (Vector3<f64>, Vector3<f64>), corner: &Point3<f64>| (low.inf(&corner.coords), high.sup(&corner.coords));
    let (low, high) = corners.iter().fold((first, first), ends);
    places.iter().any(|place| (place.sup(&low).inf(&high) - place).amax() < NEAR_M)
}

/// A place and others around it, each so far away (m).
fn around(place: &Vector3<f64>, away_m: f64) -> Vec<Point3<f64>> {
    let beside = (0..3).flat_map(|axis| [away_m, -away_m].map(|m| place + Vector3::ith(axis, m)));
    std::iter::once(*place).chain(beside).map(Point3::from).collect()
}
