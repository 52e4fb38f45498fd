//! Where the tool was led, was to go, and went: in space and over time.

use nalgebra::{DVector, Vector3};
use rerun::{Color, LineStrips3D, Scalars, SeriesLines};

use super::camera::Camera;
use super::convert;
use super::dashes::{Dashes, Slot};
use super::entity_path::{EXECUTED_MOTION, EXECUTED_PATH, PLANNED_MOTION, PLANNED_PATH, TAUGHT_MOTION, TAUGHT_PATH, TOOL};
use super::palette;
use super::recorder::{Fault, Recorder, Since};
use crate::demonstration::Trajectory;
use crate::simulation::{RunOutcome, StepRecord};

/// The axes of the world, as they name entities.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// The columns that hold coordinates of the tool.
pub(super) const COLUMNS: [&str; 3] = ["x_m", "y_m", "z_m"];

/// Samples of a taught or planned path that are drawn: a piece of 0.1 s of a movement of 28 s.
const DRAWN_SAMPLES: usize = 280;

/// Widths of lines in the plots of motion (points): where they lie on each other, what is drawn below is seen at both sides of what is above. Taught
/// ones are many: they are thin where they do not lie on the plan.
const TAUGHT_WIDTHS: [f32; 2] = [0.8, 9.0];
const ON_PLAN_M: f64 = 0.003;
const PLANNED_WIDTH: f32 = 7.0;
pub(super) const BESIDE_WIDTHS: [f32; 2] = [5.0, 4.0];
const EXECUTED_WIDTH: f32 = 2.2;

/// Logs what was taught and what is planned, in dashes. `duration_s` is how long the execution of the skill takes.
pub(super) fn log_known(recorder: &Recorder, outcome: &RunOutcome, (duration_s, dashes): (f64, &Dashes)) -> Result<(), Fault> {
    let planned = Path::new(&outcome.plan, outcome.plan.duration_s());
    let demonstrations = &outcome.dataset.demonstrations;
    let taught: Vec<Path> = demonstrations.iter().map(|demonstration| Path::new(&demonstration.trajectory, duration_s)).collect();
    for (path, demonstration) in taught.iter().zip(demonstrations) {
        let name = demonstration.name.as_str();
        if let Some(places) = path.places() {
            let line = dashes.whole(&places, Slot::Taught).with_colors([palette::TAUGHT_PATH]);
            recorder.from(Since::Start, TAUGHT_PATH.of(&[name]), &line)?;
        }
        for (axis, axis_name) in AXES.iter().enumerate() {
            let entity = TAUGHT_MOTION.of(&[axis_name, name]);
            path.log_taught(recorder, &entity, axis, &planned)?;
        }
    }
    if let Some(places) = planned.places() {
        recorder.from(Since::Start, PLANNED_PATH.path(), &dashes.whole(&places, Slot::Planned).with_colors([palette::PLANNED]))?;
    }
    for (axis, name) in AXES.iter().enumerate() {
        planned.log(recorder, &PLANNED_MOTION.of(&[name]), axis, &style("planned", palette::PLANNED, PLANNED_WIDTH))?;
    }
    Ok(())
}

/// Radius of the executed path (m), seen from far: dashes are thicker, and are seen on it.
pub(super) const EXECUTED_M: f32 = 0.0055;

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

/// A thinned trajectory, its time stretched to a duration.
pub(super) struct Path {
    times_s: Vec<f64>,
    /// The coordinates that it has.
    columns: [Option<DVector<f64>>; 3],
}

impl Path {
    pub(super) fn new(trajectory: &Trajectory, duration_s: f64) -> Self {
        let every = (trajectory.samples() / DRAWN_SAMPLES).max(1);
        let last = trajectory.samples() - 1;
        let kept: Vec<usize> = (0..last).step_by(every).chain([last]).collect();
        let times = trajectory.times_s();
        let stretch = duration_s / trajectory.duration_s();
        let column = |name| trajectory.column(name).map(|values| DVector::from_iterator(kept.len(), kept.iter().map(|i| values[*i])));
        Self { times_s: kept.iter().map(|i| (times[*i] - times[0]) * stretch).collect(), columns: COLUMNS.map(column) }
    }

    /// The places (m, world), when all three coordinates are there, each with the share of the time that has passed.
    pub(super) fn places(&self) -> Option<Vec<(f64, Vector3<f64>)>> {
        let [Some(x), Some(y), Some(z)] = &self.columns else { return None };
        let duration_s = self.times_s.last().copied().filter(|last| *last > 0.0).unwrap_or(1.0);
        Some((0..x.len()).map(|i| (self.times_s[i] / duration_s, Vector3::new(x[i], y[i], z[i]))).collect())
    }

    /// A coordinate (m) at a time (s) after which there is a sample; the last one later.
    fn at(&self, axis: usize, time_s: f64) -> Option<f64> {
        let values = self.columns[axis].as_ref()?;
        let next = self.times_s.partition_point(|time| *time < time_s).min(values.len() - 1);
        let before = next.saturating_sub(1);
        let span_s = self.times_s[next] - self.times_s[before];
        let share = if span_s > 0.0 { ((time_s - self.times_s[before]) / span_s).clamp(0.0, 1.0) } else { 1.0 };
        Some(values[before] + share * (values[next] - values[before]))
    }

    /// Logs a taught coordinate, wide where it lies on the planned one.
    fn log_taught(&self, recorder: &Recorder, entity: &rerun::EntityPath, axis: usize, planned: &Self) -> Result<(), Fault> {
        let Some(values) = &self.columns[axis] else { return Ok(()) };
        recorder.always(entity.clone(), &SeriesLines::new().with_names(["taught"]).with_colors([palette::TAUGHT]))?;
        let on_plan = |(time_s, value): (&f64, &f64)| planned.at(axis, *time_s).is_some_and(|there| (there - value).abs() < ON_PLAN_M);
        let widths = self.times_s.iter().zip(values).map(|sample| TAUGHT_WIDTHS[usize::from(on_plan(sample))]);
        let looks = SeriesLines::update_fields().with_widths(widths).columns_of_unit_batches()?;
        let scalars = Scalars::new(values.iter().copied()).columns_of_unit_batches()?;
        recorder.at_times(entity.clone(), &self.times_s, scalars.chain(looks))
    }

    fn log(&self, recorder: &Recorder, entity: &rerun::EntityPath, axis: usize, style: &SeriesLines) -> Result<(), Fault> {
        let Some(values) = &self.columns[axis] else { return Ok(()) };
        recorder.always(entity.clone(), style)?;
        recorder.at_times(entity.clone(), &self.times_s, Scalars::new(values.iter().copied()).columns_of_unit_batches()?)
    }
}
