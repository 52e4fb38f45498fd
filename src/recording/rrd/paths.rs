//! Where the tool was led, was to go, and went: in space and over time.

use nalgebra::{DVector, Vector3};
use rerun::{Color, LineStrips3D, Scalars, SerializedComponentColumn, SeriesLines};

use super::camera::Camera;
use super::convert;
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

/// Logs what was taught and what is planned, as a camera sees it. `duration_s` is how long the execution of the skill takes.
pub(super) fn log_known(recorder: &Recorder, outcome: &RunOutcome, (duration_s, camera): (f64, &Camera)) -> Result<(), Fault> {
    for demonstration in &outcome.dataset.demonstrations {
        let path = Path::new(&demonstration.trajectory, duration_s);
        let name = demonstration.name.as_str();
        if let Some(points) = path.points() {
            recorder.from(Since::Start, TAUGHT_PATH.of(&[name]), &strip(points, palette::TAUGHT, TAUGHT_M, camera))?;
        }
        for (axis, axis_name) in AXES.iter().enumerate() {
            let entity = TAUGHT_MOTION.of(&[axis_name, name]);
            path.log(recorder, &entity, axis, &style("taught", palette::TAUGHT, 0.8))?;
        }
    }
    let planned = Path::new(&outcome.plan, outcome.plan.duration_s());
    if let Some(points) = planned.points() {
        recorder.from(Since::Start, PLANNED_PATH.path(), &strip(points, palette::PLANNED, PLANNED_M, camera))?;
    }
    for (axis, name) in AXES.iter().enumerate() {
        planned.log(recorder, &PLANNED_MOTION.of(&[name]), axis, &style("planned", palette::PLANNED, 2.0))?;
    }
    Ok(())
}

/// Radius of the taught, the planned and the executed path (m), seen from far. Lines in one place show through each other in the viewer: the edges of the executed one
/// are seen in any case.
const TAUGHT_M: f32 = 0.0012;
const PLANNED_M: f32 = 0.0025;
pub(super) const EXECUTED_M: f32 = 0.005;

/// Logs where the tool went, as a camera sees it.
pub(super) fn log_executed(recorder: &Recorder, records: &[StepRecord], camera: &Camera) -> Result<(), Fault> {
    let tools: Vec<_> = records.iter().map(|record| record.tool).collect();
    recorder.poses(TOOL.path(), &tools)?;
    recorder.every_step(EXECUTED_PATH.path(), pieces(records)?)?;
    let look = LineStrips3D::update_fields().with_colors([palette::EXECUTED]).with_radii([EXECUTED_M * camera.share as f32]);
    recorder.always(EXECUTED_PATH.path(), &look)?;
    for (axis, name) in AXES.iter().enumerate() {
        let entity = EXECUTED_MOTION.of(&[name]);
        recorder.always(entity.clone(), &style("executed", palette::EXECUTED, 2.5))?;
        let values: Vec<f64> = tools.iter().map(|tool| tool.translation.vector[axis]).collect();
        recorder.every_step(entity, Scalars::new(values).columns_of_unit_batches()?)?;
    }
    Ok(())
}

/// A path that grows: of each record the piece since the record before.
pub(super) fn pieces(records: &[StepRecord]) -> Result<impl Iterator<Item = SerializedComponentColumn> + use<>, Fault> {
    let places: Vec<[f32; 3]> = records.iter().map(|record| convert::vector(&record.tool.translation.vector)).collect();
    let pieces = (0..places.len()).map(|i| [places[i.saturating_sub(1)], places[i]]);
    Ok(LineStrips3D::update_fields().with_strips(pieces).columns_of_unit_batches()?)
}

/// How a line of a plot looks; equal names share an entry of the legend.
pub(super) fn style(name: &str, color: Color, width: f32) -> SeriesLines {
    SeriesLines::new().with_names([name]).with_colors([color]).with_widths([width])
}

/// A path, so thick (m) for a camera that is far, and as thick in the picture for one that is near.
pub(super) fn strip(points: Vec<[f32; 3]>, color: Color, radius_m: f32, camera: &Camera) -> LineStrips3D {
    LineStrips3D::new([points]).with_colors([color]).with_radii([radius_m * camera.share as f32])
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

    /// The places, when all three coordinates are there.
    pub(super) fn points(&self) -> Option<Vec<[f32; 3]>> {
        let [Some(x), Some(y), Some(z)] = &self.columns else { return None };
        Some((0..x.len()).map(|i| convert::vector(&Vector3::new(x[i], y[i], z[i]))).collect())
    }

    fn log(&self, recorder: &Recorder, entity: &rerun::EntityPath, axis: usize, style: &SeriesLines) -> Result<(), Fault> {
        let Some(values) = &self.columns[axis] else { return Ok(()) };
        recorder.always(entity.clone(), style)?;
        recorder.at_times(entity.clone(), &self.times_s, Scalars::new(values.iter().copied()).columns_of_unit_batches()?)
    }
}
