//! The objects of the scene.

use nalgebra::Isometry3;
use rerun::{Boxes3D, Capsules3D, Color, Cylinders3D, Ellipsoids3D, FillMode};

use super::convert;
use super::entity_path::{Entity, OBJECT, OBJECT_SHAPE};
use super::recorder::{Fault, Recorder, Since};
use crate::simulation::{Experiment, StepRecord};
use crate::world::{Object, ObjectKind, ObjectPart, Parameters, PartShape, fixed_parts, object_parts, support_height_m};

/// Logs every object: its shapes, and its pose over time. Those that `see_through` names by their index are translucent.
pub(super) fn log_objects(
    recorder: &Recorder,
    experiment: &Experiment,
    records: &[StepRecord],
    see_through: &[usize],
) -> Result<(), Fault> {
    for (index, object) in experiment.objects.iter().enumerate() {
        let poses: Vec<Isometry3<f64>> = records.iter().filter_map(|record| record.objects.get(index).copied()).collect();
        let entity = OBJECT.of(&[&object.name]);
        let support = support_height_m(&experiment.objects, object, &experiment.parameters);
        if poses.len() == records.len() && !poses.is_empty() {
            recorder.poses(entity, &poses)?;
        } else {
            recorder.from(Since::Start, entity, &convert::transform(&object.pose(&experiment.parameters, support)))?;
        }
        let fill = if see_through.contains(&index) { FillMode::TransparentFillMajorWireframe } else { FillMode::Solid };
        log_shapes(recorder, Since::Start, (&OBJECT_SHAPE, fill), object, &experiment.parameters)?;
        let pose = object.pose(&experiment.parameters, support);
        log_fixed(recorder, Since::Start, (&OBJECT, &OBJECT_SHAPE, fill), object, &pose)?;
    }
    Ok(())
}

/// Logs what an object looks like in a setting.
pub(super) fn log_shapes(
    recorder: &Recorder,
    when: Since,
    (entity, fill): (&Entity, FillMode),
    object: &Object,
    parameters: &Parameters,
) -> Result<(), Fault> {
    log_parts(recorder, when, (entity, &object.name), (color(object), fill), &object_parts(object, parameters))
}

/// Logs the parts of a moving object that stand still, as an object of their own at `pose`.
pub(super) fn log_fixed(
    recorder: &Recorder,
    when: Since,
    (place, shape, fill): (&Entity, &Entity, FillMode),
    object: &Object,
    pose: &Isometry3<f64>,
) -> Result<(), Fault> {
    let parts = fixed_parts(object);
    if parts.is_empty() {
        return Ok(());
    }
    let name = format!("{}_fixed", object.name);
    let at = convert::transform(pose);
    recorder.from(when, place.of(&[&name]), &at)?;
    log_parts(recorder, when, (shape, &name), (color(object), fill), &parts)
}

fn log_parts(
    recorder: &Recorder,
    when: Since,
    (entity, name): (&Entity, &str),
    (color, fill): (Color, FillMode),
    parts: &[ObjectPart],
) -> Result<(), Fault> {
    let (mut boxes, mut balls, mut cylinders, mut bars) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for part in parts {
        let pose = part.object_from_part;
        let place = convert::vector(&pose.translation.vector);
        match part.shape {
            PartShape::Box(half) => boxes.push((place, convert::quaternion(&pose.rotation), convert::vector(&half))),
            PartShape::Ball(radius) => balls.push((place, radius as f32)),
            PartShape::Cylinder(radius, height) => {
                cylinders.push((place, convert::quaternion(&pose.rotation), radius as f32, height as f32));
            }
            PartShape::Capsule(radius, height) => {
                // A capsule of the viewer begins at its origin.
                let foot = pose * nalgebra::Point3::new(0.0, 0.0, -height / 2.0);
                bars.push((convert::vector(&foot.coords), convert::quaternion(&pose.rotation), radius as f32, height as f32));
            }
        }
    }
    if !boxes.is_empty() {
        let solid = Boxes3D::from_centers_and_half_sizes(boxes.iter().map(|b| b.0), boxes.iter().map(|b| b.2))
            .with_quaternions(boxes.iter().map(|b| b.1))
            .with_colors([color])
            .with_fill_mode(fill);
        recorder.from(when, entity.of(&[name, "boxes"]), &solid)?;
    }
    if !balls.is_empty() {
        let solid = Ellipsoids3D::from_centers_and_radii(balls.iter().map(|b| b.0), balls.iter().map(|b| b.1))
            .with_colors([color])
            .with_fill_mode(fill);
        recorder.from(when, entity.of(&[name, "balls"]), &solid)?;
    }
    if !cylinders.is_empty() {
        let solid = Cylinders3D::from_lengths_and_radii(cylinders.iter().map(|c| c.3), cylinders.iter().map(|c| c.2))
            .with_centers(cylinders.iter().map(|c| c.0))
            .with_quaternions(cylinders.iter().map(|c| c.1))
            .with_colors([color])
            .with_fill_mode(fill);
        recorder.from(when, entity.of(&[name, "cylinders"]), &solid)?;
    }
    if !bars.is_empty() {
        let solid = Capsules3D::from_lengths_and_radii(bars.iter().map(|b| b.3), bars.iter().map(|b| b.2))
            .with_translations(bars.iter().map(|b| b.0))
            .with_quaternions(bars.iter().map(|b| b.1))
            .with_colors([color])
            .with_fill_mode(fill);
        recorder.from(when, entity.of(&[name, "bars"]), &solid)?;
    }
    Ok(())
}

/// Calm colours for what stands there, none of which means anything else in a recording; a bright one for a ball.
fn color(object: &Object) -> Color {
    match object.kind {
        ObjectKind::Table { .. } => Color::from_rgb(196, 178, 150),
        ObjectKind::UBlock { .. } => Color::from_rgb(128, 146, 170),
        ObjectKind::Ball { .. } => Color::from_rgb(250, 214, 40),
        ObjectKind::Basket { .. } => Color::from_rgb(140, 100, 66),
        ObjectKind::Cylinder { .. } => Color::from_rgb(150, 170, 188),
        ObjectKind::SpringPlate { .. } => Color::from_rgb(120, 170, 120),
        ObjectKind::Box { .. } => Color::from_rgb(112, 150, 150),
        ObjectKind::Cabinet(_) => Color::from_rgb(172, 152, 122),
    }
}
