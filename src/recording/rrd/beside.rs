//! What was executed beside the run: where its tool went, what it felt, and how far that was from what its skill expected.

use nalgebra::Vector3;
use rerun::{Color, LineStrips3D, Scalars, TextDocument};

use super::dashes::{Dashes, Slot};
use super::entity_path::{BESIDE_COLORS, BESIDE_ERROR, BESIDE_FORCE, BESIDE_MOTION, BESIDE_PATH, ERROR_COLORS, Entity};
use super::palette;
use super::paths::{AXES, BESIDE_WIDTHS, style};
use super::recorder::{Fault, Recorder};
use crate::learning::Skill;
use crate::palette::meaning;
use crate::simulation::{Beside, StepRecord};

/// What the run itself is called where others stand beside it.
pub(super) const RUN: &str = "executed";

/// What was executed beside a run, each with its colour and the colour's name.
fn named(beside: &[Beside]) -> impl Iterator<Item = (&Beside, meaning::Named)> {
    beside.iter().zip(meaning::beside(beside.iter().map(|one| one.difference)))
}

/// Logs everything that was executed beside the run: where its tool went, in dashes, and the forces.
pub(super) fn log_all(beside: &[Beside], dashes: &Dashes, recorder: impl Fn(&[StepRecord]) -> Recorder) -> Result<(), Fault> {
    for (number, (one, (color, _))) in named(beside).enumerate() {
        // Plots draw them in the order of their entities, each narrower than the one below.
        let entity = |one: &Beside| BESIDE_MOTION.of(&[AXES[0], &one.name]);
        let below = beside.iter().filter(|other| entity(other) < entity(one)).count();
        let look = (palette::rgb(color), BESIDE_WIDTHS[below.min(BESIDE_WIDTHS.len() - 1)]);
        log_beside(&recorder(&one.outcome.steps), one, look, (Slot::Other(number), dashes))?;
    }
    Ok(())
}

fn log_beside(recorder: &Recorder, beside: &Beside, (color, width): (Color, f32), (slot, dashes): (Slot, &Dashes)) -> Result<(), Fault> {
    let (name, records) = (beside.name.as_str(), &beside.outcome.steps);
    let path = BESIDE_PATH.of(&[name]);
    recorder.always(path.clone(), &LineStrips3D::update_fields().with_colors([color]))?;
    recorder.every_step(path, dashes.growing(records, slot)?)?;
    for (axis, axis_name) in AXES.iter().enumerate() {
        let entity = BESIDE_MOTION.of(&[axis_name, name]);
        recorder.always(entity.clone(), &style(name, color, width))?;
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
        let others = named(beside).filter(|(one, _)| shown(one));
        let others = others.map(|(one, (_, color))| format!("{color}: {}", in_short_lines(&one.name)));
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
    let line = |(one, (_, color)): (&Beside, meaning::Named)| {
        let changes: Vec<String> = one.changes.iter().map(|change| format!("`{change}`")).collect();
        format!("- {color}: `{}`, executed beside the run, with {}\n", one.name, changes.join(", "))
    };
    named(beside).map(line).collect()
}

/// The same in a line of the key; none without any.
pub(super) fn in_short(beside: &[Beside]) -> Option<String> {
    let each: Vec<String> = beside.iter().map(|one| format!("{} ({})", one.name, one.changes.join(", "))).collect();
    (!each.is_empty()).then(|| format!("Other runs: {}", each.join(", ")))
}

/// The same for a title.
pub(super) fn for_title(beside: &[Beside]) -> String {
    named(beside).map(|(one, (_, color))| format!(", {} {color}", one.name)).collect()
}
