//! Where the tool was led, was to go, and went: in space and over time.

use rerun::{Color, LineStrips3D, Scalars, SeriesLines};

use super::camera::Camera;
use super::convert;
use super::dashes::{Dashes, Slot};
use super::entity_path::{EXECUTED_MOTION, EXECUTED_PATH, PLANNED_MOTION, PLANNED_PATH, TAUGHT_MOTION, TAUGHT_PATH, TOOL};
use super::palette;
use super::path::Path;
use super::recorder::{Fault, Recorder, Since};
use super::task_states::Plan;
use crate::simulation::{RunOutcome, StepRecord};

/// The axes of the world, as they name entities.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// The columns that hold coordinates of the tool.
pub(super) const COLUMNS: [&str; 3] = ["x_m", "y_m", "z_m"];

/// Widths of lines in the plots of motion (points): where they lie on each other, what is drawn below is seen at both sides of what is above.
const PLANNED_WIDTH: f32 = 6.6;
pub(super) const BESIDE_WIDTHS: [f32; 2] = [4.6, 3.6];
const EXECUTED_WIDTH: f32 = 2.2;

/// Logs what was taught and what is planned, in dashes. `duration_s` is how long the execution of the skill takes.
pub(super) fn log_known(recorder: &Recorder, outcome: &RunOutcome, (duration_s, dashes): (f64, &Dashes)) -> Result<(), Fault> {
    let plan = Plan::new(&outcome.plan, duration_s);
    for demonstration in &outcome.dataset.demonstrations {
        let path = Path::new(&demonstration.trajectory, duration_s);
        let name = demonstration.name.as_str();
        if let Some(places) = path.places() {
            let line = dashes.whole(&places, Slot::Taught).with_colors([palette::TAUGHT_PATH]);
            recorder.from(Since::Start, TAUGHT_PATH.of(&[name]), &line)?;
        }
        for (axis, axis_name) in AXES.iter().enumerate() {
            let entity = TAUGHT_MOTION.of(&[axis_name, name]);
            path.log_taught(recorder, &entity, axis, plan.as_ref())?;
        }
    }
    let planned = Path::new(&outcome.plan, duration_s);
    if let Some(places) = planned.places() {
        recorder.from(Since::Start, PLANNED_PATH.path(), &dashes.whole(&places, Slot::Planned).with_colors([palette::PLANNED]))?;
    }
    for (axis, name) in AXES.iter().enumerate() {
        planned.log(recorder, &PLANNED_MOTION.of(&[name]), axis, &style("planned", palette::PLANNED, PLANNED_WIDTH))?;
    }
    Ok(())
}

/// Radius of the executed path (m), seen from far: dashes are a little thicker, and are seen on it.
pub(super) const EXECUTED_M: f32 = 0.0075;

/// Logs where the tool went, as a camera sees it.
pub(super) fn log_executed(recorder: &Recorder, records: &[StepRecord], camera: &Camera) -> Result<(), Fault> {
    let tools: Vec<_> = records.iter().map(|record| record.tool).collect();
    recorder.poses(TOOL.path(), &tools)?;
    let grown = LineStrips3D::update_fields().with_strips(pieces(records));
    recorder.every_step(EXECUTED_PATH.path(), grown.columns_of_unit_batches()?)?;
    let look = LineStrips3D::update_fields().with_colors([palette::EXECUTED]).with_radii([EXECUTED_M * camera.share as f32]);
    recorder.always(EXECUTED_PATH.path(), &look)?;
    for (axis, name) in AXES.iter().enumerate() {
        let entity = EXECUTED_MOTION.of(&[name]);
        recorder.always(entity.clone(), &style("executed", palette::EXECUTED, EXECUTED_WIDTH))?;
        let values: Vec<f64> = tools.iter().map(|tool| tool.translation.vector[axis]).collect();
        recorder.every_step(entity, Scalars::new(values).columns_of_unit_batches()?)?;
    }
    Ok(())
}

/// A path that grows: of each record the piece since the record before.
pub(super) fn pieces(records: &[StepRecord]) -> impl Iterator<Item = [[f32; 3]; 2]> {
    let place = |i: usize| convert::vector(&records[i].tool.translation.vector);
    (0..records.len()).map(move |i| [place(i.saturating_sub(1)), place(i)])
}

/// How a line of a plot looks; equal names share an entry of the legend.
pub(super) fn style(name: &str, color: Color, width: f32) -> SeriesLines {
    SeriesLines::new().with_names([name]).with_colors([color]).with_widths([width])
}
