//! Where the floor is that a scene is drawn on.

use crate::robot::{RobotModel, Shape};
use crate::simulation::Experiment;
use crate::world::support_height_m;

/// Usual height of a table (m).
const TABLE_HEIGHT_M: f64 = 0.75;

/// Height of the floor (m): that of the lowest point of the robot's fixed body. A robot that shows no body down to there stands on the
/// floor on which a table of usual height does.
pub(super) fn floor_m(experiment: &Experiment, robot: &RobotModel) -> f64 {
    let Experiment { objects, parameters, .. } = experiment;
    let supports_m = objects.iter().map(|object| support_height_m(objects, object, parameters));
    let support_m = supports_m.reduce(f64::min).unwrap_or(0.0);
    let lowest_m = lowest_m(robot);
    if lowest_m <= support_m { lowest_m } else { support_m - TABLE_HEIGHT_M }
}

/// Height of the lowest point of the robot's fixed body (m), at most the height of its base.
fn lowest_m(robot: &RobotModel) -> f64 {
    let reach = |shape: &Shape| match shape {
        Shape::Box { half_extents } => half_extents.z,
        Shape::Sphere { radius } => *radius,
        Shape::Cylinder { half_length, .. } => *half_length,
        Shape::Mesh { vertices, .. } => vertices.iter().map(|vertex| -vertex[2]).fold(0.0, f64::max),
    };
    let fixed = robot.bodies.first().map_or(&[][..], |body| &body.visuals);
    fixed.iter().map(|visual| visual.body_from_geometry.translation.z - reach(&visual.shape)).fold(0.0, f64::min)
}
