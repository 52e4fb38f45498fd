//! A path that is known as a whole.

use nalgebra::{DVector, Vector3};
use rerun::{EntityPath, Scalars, SeriesLines};

use super::palette;
use super::paths::COLUMNS;
use super::recorder::{Fault, Recorder};
use super::task_states::Plan;
use crate::demonstration::Trajectory;

/// Samples of a taught or planned path that are drawn: a piece of 0.1 s of a movement of 28 s.
const DRAWN_SAMPLES: usize = 280;

/// Widths of taught lines in the plots of motion (points). They are many, and thin; where they are nearer to the plan than this (m), they are wide
/// enough to be seen at both sides of it.
const TAUGHT_WIDTHS: [f32; 2] = [0.8, 10.0];
const ON_PLAN_M: f64 = 0.003;

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

    /// Logs a taught coordinate, wide where it lies on the planned one.
    pub(super) fn log_taught(&self, recorder: &Recorder, entity: &EntityPath, axis: usize, plan: Option<&Plan>) -> Result<(), Fault> {
        let Some(values) = &self.columns[axis] else { return Ok(()) };
        recorder.always(entity.clone(), &SeriesLines::new().with_names(["taught"]).with_colors([palette::TAUGHT]))?;
        let on_plan = |(time_s, value): (&f64, &f64)| plan.is_some_and(|plan| (plan.at(axis, *time_s) - value).abs() < ON_PLAN_M);
        let widths = self.times_s.iter().zip(values).map(|sample| TAUGHT_WIDTHS[usize::from(on_plan(sample))]);
        let looks = SeriesLines::update_fields().with_widths(widths).columns_of_unit_batches()?;
        let scalars = Scalars::new(values.iter().copied()).columns_of_unit_batches()?;
        recorder.at_times(entity.clone(), &self.times_s, scalars.chain(looks))
    }

    /// Logs a coordinate.
    pub(super) fn log(&self, recorder: &Recorder, entity: &EntityPath, axis: usize, style: &SeriesLines) -> Result<(), Fault> {
        let Some(values) = &self.columns[axis] else { return Ok(()) };
        recorder.always(entity.clone(), style)?;
        recorder.at_times(entity.clone(), &self.times_s, Scalars::new(values.iter().copied()).columns_of_unit_batches()?)
    }
}
