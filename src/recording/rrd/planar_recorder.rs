//! The stream into the recording of a planar experiment: what always holds, and columns over the phase.

use rerun::{AsComponents, EntityPath, RecordingStream, SerializedComponentColumn, TimeColumn};

use super::planar_entity::PHASE_INPUT;
use super::recorder::Fault;

/// Writes entities of one planar experiment.
pub(super) struct PlanarRecorder {
    stream: RecordingStream,
}

impl PlanarRecorder {
    pub(super) fn new(stream: RecordingStream) -> Self {
        stream.set_log_time_enabled(false);
        stream.set_log_tick_enabled(false);
        Self { stream }
    }

    /// Logs what holds at every phase.
    pub(super) fn always(&self, entity: impl Into<EntityPath>, what: &dyn AsComponents) -> Result<(), Fault> {
        Ok(self.stream.log_static(entity, what)?)
    }

    /// Logs one row per phase input (-).
    pub(super) fn over_phase(
        &self,
        entity: impl Into<EntityPath>,
        inputs: &[f64],
        columns: impl IntoIterator<Item = SerializedComponentColumn>,
    ) -> Result<(), Fault> {
        let times = TimeColumn::new_duration_nanos(PHASE_INPUT.name, inputs.iter().map(|input| ticks(*input)));
        Ok(self.stream.send_columns(entity, [times], columns)?)
    }
}

/// A phase input (-) on the timeline: 1 is a second, of which the viewer writes fractions, as it does not of numbers.
pub(super) fn ticks(input: f64) -> i64 {
    (input * 1e9).round() as i64
}
