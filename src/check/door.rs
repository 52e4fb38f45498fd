//! Answers about a cabinet's door: how far it is open, and whether the hook went with its handle.

use nalgebra::{Isometry3, Point3, Vector2};

use super::Followed;
use super::judge::Answer;
use crate::simulation::{Experiment, RunOutcome, StepRecord};
use crate::world::{Cabinet, ObjectKind, opening_rad};

/// A cabinet of the scene: its number, its hinge (m), and its shape.
struct Found<'a> {
    index: usize,
    hinge: Vector2<f64>,
    cabinet: &'a Cabinet,
}

fn find<'a>(experiment: &'a Experiment, name: &str) -> Option<Found<'a>> {
    experiment.objects.iter().enumerate().find(|(_, object)| object.name == name).and_then(|(index, object)| {
        let ObjectKind::Cabinet(cabinet) = &object.kind else { return None };
        Some(Found { index, hinge: object.center(&experiment.parameters), cabinet })
    })
}

pub(super) fn open(outcome: &RunOutcome, experiment: &Experiment, object: &str, min_rad: f64) -> Answer {
    let door = find(experiment, object).and_then(|found| outcome.steps.last()?.objects.get(found.index));
    Answer::at_least(door.map_or(f64::NAN, opening_rad), min_rad, "rad")
}

pub(super) fn arc_followed(steps: &[StepRecord], experiment: &Experiment, object: &str, of: Followed, max_m: f64) -> Answer {
    let Some(found) = find(experiment, object) else { return Answer::at_most(f64::NAN, max_m, "m") };
    let radius = found.cabinet.arc_radius_m(found.hinge.y, &experiment.parameters);
    let place = |step: &StepRecord| match of {
        Followed::Tool => step.tool.translation.vector.xy(),
        Followed::Reference => step.reference.translation.vector.xy(),
    };
    let squares: f64 = steps.iter().map(|step| ((place(step) - found.hinge).norm() - radius).powi(2)).sum();
    Answer::at_most((squares / steps.len() as f64).sqrt(), max_m, "m")
}

pub(super) fn hook_kept(steps: &[StepRecord], experiment: &Experiment, object: &str, max_m: f64) -> Answer {
    let Some(found) = find(experiment, object) else { return Answer::at_most(f64::NAN, max_m, "m") };
    let handle = found.cabinet.handle(found.hinge.y, &experiment.parameters);
    let away = |step: &StepRecord| step.objects.get(found.index).map_or(f64::NAN, |door| distance(door, &handle, &step.tool));
    let failed = steps.iter().find(|step| away(step) > max_m).map(|step| step.time_s);
    let farthest = steps.iter().map(away).fold(f64::NAN, f64::max);
    Answer::at_most(farthest, max_m, "m").first_failed(failed)
}

/// Horizontal distance of the tool from a point of the door, given in the door's frame (m).
fn distance(door: &Isometry3<f64>, handle: &Point3<f64>, tool: &Isometry3<f64>) -> f64 {
    ((door * handle).coords - tool.translation.vector).xy().norm()
}
