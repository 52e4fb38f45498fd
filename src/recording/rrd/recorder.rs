//! The stream into a recording file: everything is sent in columns, so the file is small and what it tells does not depend on any clock.

use std::time::Duration;

use nalgebra::Isometry3;
use rerun::{AsComponents, EntityPath, RecordingStream, SerializedComponentColumn, TimeColumn};

use super::axis_range::Ranges;
use super::convert;
use super::entity_path::{PHASE, SIM_TIME, STEP, Timeline};
use crate::simulation::StepRecord;

/// What goes wrong while a file is written, before its path is added.
pub(super) type Fault = Box<dyn std::error::Error + Send + Sync>;

/// From when on something is seen: on the timelines of one page alone, so that the page is empty on all others.
#[derive(Clone, Copy)]
pub(super) enum Since {
    /// From the start of the execution.
    Start,
    /// From a time (s) of another timeline on.
    On(Timeline, f64),
}

/// Writes entities of one run: of all of it, or of some of its steps.
pub(super) struct Recorder {
    stream: RecordingStream,
    /// The logged steps on every timeline.
    steps: [Vec<i64>; 3],
    /// Engine step (s), and duration of the skill (s).
    step_s: f64,
    duration_s: f64,
    /// Takes note of the scalars that are logged.
    ranges: Ranges,
    /// Whether another recorder has begun what this one goes on with.
    continues: bool,
}

impl Recorder {
    /// Sends to `stream`. Other times than those of the records are mapped by the engine's step and the skill's duration (s).
    pub(super) fn new((stream, ranges): (RecordingStream, Ranges), records: &[StepRecord], step_s: f64, duration_s: f64) -> Self {
        stream.set_log_time_enabled(false);
        stream.set_log_tick_enabled(false);
        let steps = [
            records.iter().map(|r| nanoseconds(r.time_s)).collect(),
            records.iter().map(|r| r.step as i64).collect(),
            records.iter().map(|r| nanoseconds(r.time_fraction)).collect(),
        ];
        Self { stream, steps, step_s, duration_s, ranges, continues: false }
    }

    /// Goes on with what another recorder has begun: what holds at all times has been said.
    pub(super) fn continues(self) -> Self {
        Self { continues: true, ..self }
    }

    /// The first record that says something: one that goes on begins with the last record of the one before it, for what lies between.
    pub(super) fn first(&self) -> usize {
        usize::from(self.continues)
    }

    /// Logs what holds at all times.
    pub(super) fn always(&self, entity: impl Into<EntityPath>, what: &dyn AsComponents) -> Result<(), Fault> {
        if self.continues {
            return Ok(());
        }
        Ok(self.stream.log_static(entity, what)?)
    }

    /// Logs what is seen from some time on. What holds from the start of the execution has been said if this recorder goes on.
    pub(super) fn from(&self, when: Since, entity: EntityPath, what: &dyn AsComponents) -> Result<(), Fault> {
        let at = |timeline: Timeline, ns: i64| self.stream.set_time(timeline.name, Duration::from_nanos(ns.unsigned_abs()));
        match when {
            Since::Start if self.continues => return Ok(()),
            Since::Start => {
                let [time, step, phase] = self.steps.each_ref().map(|steps| steps.first().copied().unwrap_or(0));
                at(SIM_TIME, time);
                at(PHASE, phase);
                self.stream.set_time_sequence(STEP.name, step);
            }
            Since::On(timeline, time_s) => at(timeline, nanoseconds(time_s)),
        }
        let logged = self.stream.log(entity, what);
        self.stream.reset_time();
        Ok(logged?)
    }

    /// Logs one row per record, from values for each of them.
    pub(super) fn every_step(
        &self,
        entity: impl Into<EntityPath>,
        columns: impl IntoIterator<Item = SerializedComponentColumn>,
    ) -> Result<(), Fault> {
        let (first, records) = (self.first(), self.steps[0].len());
        let said: Vec<usize> = (first..records).collect();
        let cut = |column: SerializedComponentColumn| {
            let list_array = column.list_array.slice(first, said.len());
            SerializedComponentColumn { list_array, ..column }
        };
        self.at_steps(entity, &said, columns.into_iter().map(cut))
    }

    /// Logs one row for each of some records.
    fn at_steps(
        &self,
        entity: impl Into<EntityPath>,
        which: &[usize],
        columns: impl IntoIterator<Item = SerializedComponentColumn>,
    ) -> Result<(), Fault> {
        let [times, steps, phases] = &self.steps;
        let of = |values: &[i64]| which.iter().map(|i| values[*i]).collect::<Vec<i64>>();
        let times = [
            TimeColumn::new_duration_nanos(SIM_TIME.name, of(times)),
            TimeColumn::new_sequence(STEP.name, of(steps)),
            TimeColumn::new_duration_nanos(PHASE.name, of(phases)),
        ];
        self.send(entity.into(), times, columns)
    }

    /// Logs rows at `times_s` (s).
    pub(super) fn at_times(
        &self,
        entity: impl Into<EntityPath>,
        times_s: &[f64],
        columns: impl IntoIterator<Item = SerializedComponentColumn>,
    ) -> Result<(), Fault> {
        if times_s.is_empty() {
            return Ok(());
        }
        let times = [
            TimeColumn::new_duration_nanos(SIM_TIME.name, times_s.iter().map(|t| nanoseconds(*t))),
            TimeColumn::new_sequence(STEP.name, times_s.iter().map(|t| (t / self.step_s).round() as i64)),
            TimeColumn::new_duration_nanos(PHASE.name, times_s.iter().map(|t| nanoseconds(t / self.duration_s))),
        ];
        self.send(entity.into(), times, columns)
    }

    /// Logs rows at `times_s` (s) of one timeline, and nowhere else.
    pub(super) fn on(
        &self,
        timeline: Timeline,
        entity: impl Into<EntityPath>,
        times_s: &[f64],
        columns: impl IntoIterator<Item = SerializedComponentColumn>,
    ) -> Result<(), Fault> {
        let times = TimeColumn::new_duration_nanos(timeline.name, times_s.iter().map(|t| nanoseconds(*t)));
        self.send(entity.into(), [times], columns)
    }

    fn send(
        &self,
        entity: EntityPath,
        times: impl IntoIterator<Item = TimeColumn>,
        columns: impl IntoIterator<Item = SerializedComponentColumn>,
    ) -> Result<(), Fault> {
        let columns: Vec<SerializedComponentColumn> = columns.into_iter().collect();
        columns.iter().for_each(|column| self.ranges.note(&entity, column));
        Ok(self.stream.send_columns(entity, times, columns)?)
    }

    /// Logs poses, one of each record, when they change.
    pub(super) fn poses(&self, entity: EntityPath, poses: &[Isometry3<f64>]) -> Result<(), Fault> {
        let changed: Vec<usize> = (self.first()..poses.len()).filter(|i| *i == 0 || poses[*i] != poses[i - 1]).collect();
        if changed.is_empty() {
            return Ok(());
        }
        let places = changed.iter().map(|i| convert::vector(&poses[*i].translation.vector));
        let turns = changed.iter().map(|i| convert::quaternion(&poses[*i].rotation));
        let columns = rerun::Transform3D::update_fields().with_many_translation(places).with_many_quaternion(turns);
        self.at_steps(entity, &changed, columns.columns_of_unit_batches()?)
    }
}

/// On a timeline. A phase of 1 is a second, of which the viewer writes fractions, as it does not of numbers.
fn nanoseconds(time_s: f64) -> i64 {
    (time_s * 1e9).round() as i64
}
