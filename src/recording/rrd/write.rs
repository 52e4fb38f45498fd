//! Writes a recording from beginning to end.

use std::cell::OnceCell;
use std::path::Path;

use rerun::RecordingStreamBuilder;
use rerun::blueprint::components::PlayState;
use rerun::external::re_log_encoding::Encoder;

use super::axis_range::Ranges;
use super::chapters::{APPLICATION, Chapters};
use super::recorder::Fault;
use super::workplace::Workplace;
use crate::recording::RecordingError;
use crate::simulation::{Experiment, RunOutcome, skill_duration_s};

/// Writes the recording of a run to `path` (`.rrd`): its data, its result in words, and the layout that it opens with.
///
/// # Errors
/// When the file cannot be created or written to its end.
pub fn write_recording(path: &Path, experiment: &Experiment, outcome: &RunOutcome, result: &str) -> Result<(), RecordingError> {
    let recorded = record(experiment, outcome, result).map_err(|source| RecordingError::Rerun { path: path.to_owned(), source })?;
    save(path, &recorded)
}

/// Writes a file that is whole or not there: on a full disk half a recording would take the place of the report.
pub(super) fn save(path: &Path, recorded: &[u8]) -> Result<(), RecordingError> {
    std::fs::write(path, recorded).map_err(|source| {
        if path.is_file() {
            _ = std::fs::remove_file(path);
        }
        RecordingError::Io { path: path.to_owned(), source }
    })
}

/// The content of the file. It is made in memory: on a full disk rerun's own writer of files may wait for ever.
fn record(experiment: &Experiment, outcome: &RunOutcome, result: &str) -> Result<Vec<u8>, Fault> {
    // Equal identities are shown as one recording: runs that differ must not share one.
    let identity = format!("{}-{}-{:016x}", experiment.name, experiment.seed, outcome.state_hash);
    let (stream, storage) = RecordingStreamBuilder::new(APPLICATION).recording_id(identity).memory()?;
    if !stream.is_enabled() {
        return Err("rerun is switched off by the environment variable RERUN; unset it, or do without a recording".into());
    }
    stream.send_recording_name(name(experiment))?;
    let chapters = Chapters {
        stream: stream.clone(),
        ranges: Ranges::default(),
        experiment,
        work: Workplace::of_steps(&outcome.steps).with_paths(outcome),
        camera: OnceCell::new(),
        duration_s: skill_duration_s(&outcome.steps).unwrap_or_else(|| outcome.plan.duration_s()),
        beside: &outcome.beside,
    };
    chapters.lessons(&outcome.robot, &outcome.lessons)?;
    chapters.skill(outcome)?;
    chapters.execution(outcome, 0)?;
    chapters.end(outcome)?;
    chapters.key(outcome, true)?;
    chapters.result(Some(result))?;
    stream.flush_blocking()?;
    let told = storage.take();
    chapters.layout(&outcome.robot, Some(outcome), !outcome.lessons.is_empty(), PlayState::Paused)?;
    stream.flush_blocking()?;
    // The layout depends on what is told, and comes before it: a viewer arranges what it reads while it still reads.
    Ok(Encoder::encode(storage.take().into_iter().chain(told).map(Ok))?)
}

/// What the viewer calls a recording.
pub(super) fn name(experiment: &Experiment) -> String {
    format!("{}, seed {}", experiment.name, experiment.seed)
}
