//! Writes the recording of a planar experiment from beginning to end.

use std::path::Path;

use rerun::RecordingStreamBuilder;

use super::planar_recorder::PlanarRecorder;
use super::recorder::Fault;
use super::write::save;
use super::{blueprint_property, planar_forcing, planar_graph, planar_guide, planar_layout, planar_map};
use crate::planar::PlanarOutcome;
use crate::recording::RecordingError;

/// The application that the viewer keeps the layout for: another one than for runs of an arm, whose layout is another.
const APPLICATION: &str = "cpdmp-planar";

/// Writes the recording of the planar experiment `name` to `path` (`.rrd`): its data, its result in words, and the layout that it
/// opens with.
///
/// # Errors
/// When the file cannot be created or written to its end.
pub fn write_planar_recording(path: &Path, (name, seed): (&str, u64), outcome: &PlanarOutcome, result: &str) -> Result<(), RecordingError> {
    let recorded = record((name, seed), outcome, result).map_err(|source| RecordingError::Rerun { path: path.to_owned(), source })?;
    save(path, &recorded)
}

/// The content of the file.
fn record((name, seed): (&str, u64), outcome: &PlanarOutcome, result: &str) -> Result<Vec<u8>, Fault> {
    let (stream, storage) = RecordingStreamBuilder::new(APPLICATION).memory()?;
    if !stream.is_enabled() {
        return Err("rerun is switched off by the environment variable RERUN; unset it, or do without a recording".into());
    }
    stream.send_recording_name(format!("{name}, seed {seed}"))?;
    let (blueprint, properties) = planar_layout::layout(outcome)?;
    blueprint_property::send(&stream, APPLICATION, &blueprint, &properties)?;
    let recorder = PlanarRecorder::new(stream.clone());
    planar_map::log_map(&recorder, outcome)?;
    planar_forcing::log_forcing(&recorder, outcome)?;
    if let Some(transitions) = &outcome.transitions {
        planar_graph::log_graph(&recorder, transitions)?;
    }
    planar_guide::log_guide(&recorder, outcome, result)?;
    stream.flush_blocking()?;
    Ok(storage.drain_as_bytes()?)
}
