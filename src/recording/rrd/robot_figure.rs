//! The robot: one entity per body, its shapes below it, its pose over time.

use nalgebra::{Isometry3, Vector3};
use rerun::{Boxes3D, Color, Cylinders3D, Ellipsoids3D, FillMode, Mesh3D};

use super::convert;
use super::entity_path::{Entity, ROBOT_BODY, ROBOT_SHAPE};
use super::recorder::{Fault, Recorder, Since};
use crate::robot::{Body, Geometry, RobotModel, Shape};
use crate::simulation::StepRecord;

/// Logs every body that has something to look at.
pub(super) fn log_robot(recorder: &Recorder, robot: &RobotModel, records: &[StepRecord]) -> Result<(), Fault> {
    for (index, body) in robot.bodies.iter().enumerate().filter(|(_, body)| !body.visuals.is_empty()) {
        let poses: Vec<Isometry3<f64>> = records.iter().filter_map(|record| record.bodies.get(index).copied()).collect();
        if poses.len() == records.len() {
            recorder.poses(ROBOT_BODY.of(&[&body.name]), &poses)?;
            log_shapes(recorder, Since::Start, &ROBOT_SHAPE, body)?;
        }
    }
    Ok(())
}

/// Logs what a body looks like, from some time on.
pub(super) fn log_shapes(recorder: &Recorder, when: Since, kind: &Entity, body: &Body) -> Result<(), Fault> {
    let entity = |shape: &str| kind.of(&[&body.name, shape]);
    let (mut boxes, mut cylinders, mut spheres) = (Vec::new(), Vec::new(), Vec::new());
    for (index, visual) in body.visuals.iter().enumerate() {
        match &visual.shape {
            Shape::Box { half_extents } => boxes.push((visual, convert::vector(half_extents))),
            Shape::Cylinder { radius, half_length } => cylinders.push((visual, (2.0 * half_length) as f32, *radius as f32)),
            Shape::Sphere { radius } => spheres.push((visual, *radius as f32)),
            Shape::Mesh { vertices, triangles } => {
                recorder.from(when, entity(&format!("mesh_{index}")), &mesh(visual, vertices, triangles))?;
            }
        }
    }
    if !boxes.is_empty() {
        let half_sizes = boxes.iter().map(|(_, half)| *half);
        let solid = Boxes3D::from_centers_and_half_sizes(boxes.iter().map(|(v, _)| place(v)), half_sizes)
            .with_quaternions(boxes.iter().map(|(v, _)| turn(v)))
            .with_colors(boxes.iter().map(|(v, _)| color(v)));
        recorder.from(when, entity("boxes"), &solid.with_fill_mode(FillMode::Solid))?;
    }
    if !cylinders.is_empty() {
        let (lengths, radii) = (cylinders.iter().map(|(_, length, _)| *length), cylinders.iter().map(|(_, _, radius)| *radius));
        let solid = Cylinders3D::from_lengths_and_radii(lengths, radii)
            .with_centers(cylinders.iter().map(|(v, ..)| place(v)))
            .with_quaternions(cylinders.iter().map(|(v, ..)| turn(v)))
            .with_colors(cylinders.iter().map(|(v, ..)| color(v)));
        recorder.from(when, entity("cylinders"), &solid.with_fill_mode(FillMode::Solid))?;
    }
    if !spheres.is_empty() {
        let solid = Ellipsoids3D::from_centers_and_radii(spheres.iter().map(|(v, _)| place(v)), spheres.iter().map(|(_, radius)| *radius))
            .with_colors(spheres.iter().map(|(v, _)| color(v)));
        recorder.from(when, entity("spheres"), &solid.with_fill_mode(FillMode::Solid))?;
    }
    Ok(())
}

fn place(visual: &Geometry) -> [f32; 3] {
    convert::vector(&visual.body_from_geometry.translation.vector)
}

fn turn(visual: &Geometry) -> rerun::Quaternion {
    convert::quaternion(&visual.body_from_geometry.rotation)
}

fn color(visual: &Geometry) -> Color {
    convert::color(visual.color_rgba)
}

/// A mesh in the body frame. Every triangle has corners of its own, so that it is lit by its own normal.
fn mesh(visual: &Geometry, vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Mesh3D {
    let corner = |index: &u32| vertices.get(*index as usize).map_or_else(Vector3::zeros, |v| Vector3::from(*v));
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    for triangle in triangles {
        let [a, b, c] = [corner(&triangle[0]), corner(&triangle[1]), corner(&triangle[2])];
        let normal = (b - a).cross(&(c - a)).try_normalize(0.0).unwrap_or_else(Vector3::z);
        for point in [a, b, c] {
            positions.push(convert::vector(&(visual.body_from_geometry * nalgebra::Point3::from(point)).coords));
            normals.push(convert::vector(&(visual.body_from_geometry.rotation * normal)));
        }
    }
    let faces = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
    Mesh3D::new(positions).with_triangle_indices(faces).with_vertex_normals(normals).with_albedo_factor(convert::color(visual.color_rgba).0)
}
