//! What was executed beside the run: where its tool went, what it felt, and how far that was from what its skill expected.

use nalgebra::Vector3;
use rerun::{Color, LineStrips3D, Scalars, TextDocument};

use super::camera::Camera;
use super::entity_path::{BESIDE_COLORS, BESIDE_ERROR, BESIDE_FORCE, BESIDE_MOTION, BESIDE_PATH, ERROR_COLORS, Entity};
use super::palette;
use super::paths::{AXES, pieces, style};
use super::recorder::{Fault, Recorder};
use crate::learning::Skill;
use crate::palette::meaning;
use crate::simulation::{Beside, StepRecord};

/// What the run itself is called where others stand beside it.
pub(super) const RUN: &str = "executed";

/// The colour of number `index`, and the colour's name.
pub(super) fn look(index: usize) -> (Color, &'static str) {
    let (color, name) = meaning::BESIDE[index % meaning::BESIDE.len()];
    (palette::rgb(color), name)
}

/// Logs where the tool went, as a camera sees it, and the forces.
pub(super) fn log_beside(recorder: &Recorder, beside: &Beside, index: usize, camera: &Camera) -> Result<(), Fault> {
    let (color, _) = look(index);
    let (name, records) = (beside.name.as_str(), &beside.outcome.steps);
    let path = BESIDE_PATH.of(&[name]);
    recorder.always(path.clone(), &LineStrips3D::update_fields().with_colors([color]).with_radii([0.0032 * camera.share as f32]))?;
    recorder.every_step(path, pieces(records)?)?;
    for (axis, axis_name) in AXES.iter().enumerate() {
        let entity = BESIDE_MOTION.of(&[axis_name, name]);
        recorder.always(entity.clone(), &style(name, color, 1.5))?;
        let values: Vec<f64> = records.iter().map(|record| record.tool.translation.vector[axis]).collect();
        recorder.every_step(entity, Scalars::new(values).columns_of_unit_batches()?)?;
    }
    log_forces(recorder, records, &beside.outcome.skill, (name, color))
}

/// Logs the forces of one of those that are compared, in its colour.
pub(super) fn log_forces(recorder: &Recorder, records: &[StepRecord], skill: &Skill, (name, color): (&str, Color)) -> Result<(), Fault> {
    let measured = |record: &StepRecord| Vector3::from(record.wrench.fixed_rows::<3>(0));
    for (axis, axis_name) in AXES.iter().enumerate() {
        let entity = BESIDE_FORCE.of(&[axis_name, name]);
        recorder.always(entity.clone(), &style(name, color, 1.5))?;
        let values: Vec<f64> = records.iter().map(|record| measured(record)[axis]).collect();
        recorder.every_step(entity, Scalars::new(values).columns_of_unit_batches()?)?;
        if skill.force.is_none() {
            continue;
        }
        let entity = BESIDE_ERROR.of(&[axis_name, name]);
        recorder.always(entity.clone(), &style(name, color, 1.5))?;
        let values: Vec<f64> = records.iter().map(|record| measured(record)[axis] - record.expected_force[axis]).collect();
        recorder.every_step(entity, Scalars::new(values).columns_of_unit_batches()?)?;
    }
    Ok(())
}

/// Logs which colour is which: of all, and of those that expect a force; `expects` tells whether the run does.
pub(super) fn log_colors(recorder: &Recorder, beside: &[Beside], expects: bool) -> Result<(), Fault> {
    let log = |entity: &Entity, run: bool, shown: &dyn Fn(&Beside) -> bool| {
        let run = run.then(|| format!("orange: {RUN}"));
        let others = beside.iter().enumerate().filter(|(_, one)| shown(one));
        let others = others.map(|(index, one)| format!("{}: {}", look(index).1, in_short_lines(&one.name)));
        let lines: Vec<String> = run.into_iter().chain(others).collect();
        recorder.always(entity.path(), &TextDocument::from_markdown(lines.join("\n\n")))
    };
    log(&BESIDE_COLORS, true, &|_| true)?;
    log(&ERROR_COLORS, expects, &|one| one.outcome.skill.force.is_some())
}

/// A name that may be broken where its words end: a key is narrow.
fn in_short_lines(name: &str) -> String {
    name.replace('_', " ")
}

/// The same in the words of the guide, with what each changes.
pub(super) fn in_words(beside: &[Beside]) -> String {
    let line = |(index, one): (usize, &Beside)| {
        let changes: Vec<String> = one.changes.iter().map(|change| format!("`{change}`")).collect();
        format!("- {}: `{}`, executed beside the run, with {}\n", look(index).1, one.name, changes.join(", "))
    };
    beside.iter().enumerate().map(line).collect()
}

/// The same for a title.
pub(super) fn for_title(beside: &[Beside]) -> String {
    beside.iter().enumerate().map(|(index, one)| format!(", {} {}", one.name, look(index).1)).collect()
}
