//! The files of a run: report, manifest and resolved scenario always, what was learned and recorded if the run came that far.

use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use super::judged_run::{JudgedRun, Left};
use super::room::Room;
use super::{figure_files, planar_files};
use crate::recording;
use crate::report::{FileHash, Manifest, Outcome, OutputError, RunFolder, hash_bytes, hash_file, summary, write_file};
use crate::scenario::{RecordingPlan, Scenario, Work};
use crate::simulation::{Experiment, RunOutcome};

/// The steps of a run, one row per logged step.
pub(super) const STEP_LOG: &str = "steps.parquet";

/// How a run ended.
pub(super) const REPORT: &str = "report.json";

/// The hashes that a repetition is held against.
pub(super) const STATE_LOG: &str = "state_hashes.parquet";

/// The folder with the steps of what was executed beside the run.
pub(super) const BESIDE: &str = "beside";

/// The states from which a repetition can be taken up.
pub(super) const SNAPSHOTS: &str = "snapshots.bin";

/// What was learned.
pub(super) const SKILL: &str = "skill.json";

/// The folder with what was learned from.
pub(super) const DEMONSTRATIONS: &str = "demonstrations";

/// Keeps room for the report until it is written.
const RESERVE: &str = "reserve.tmp";

/// Room for the manifest, and for what the report has to say of files that could not be written (bytes).
const MANIFEST_ROOM: usize = 64 << 10;

/// What can be made again from the rest of a folder, or only shows it: it goes first when there is no room.
const SPARE: [&str; 3] = ["recording.rrd", "figures", BESIDE];

/// Writes everything into the folder; `spare` gives up what only served during the run. What cannot be written of a recording is returned, and told
/// in the report, which is written all the same.
pub(super) fn write(
    run: &mut JudgedRun,
    scenario: &Scenario,
    folder: &RunFolder,
    started: SystemTime,
    spare: &dyn Fn(),
) -> Result<Vec<String>, OutputError> {
    let mut room = Room::new(folder.staging(), spare);
    if let Some(left) = &run.left {
        // What tells of the run must fit, whatever else does.
        let reserve = vec![0; run.report.to_json().len() + scenario.resolved.len() + MANIFEST_ROOM];
        let place = folder.staging().join(RESERVE);
        if write_file(&place, &reserve).is_err() {
            spare();
            _ = write_file(&place, &reserve);
        }
        recordings(left, scenario, &summary(&run.report, &scenario.description), &mut room);
        _ = std::fs::remove_file(place);
    }
    let mut lost: Vec<String> = Vec::new();
    loop {
        for failure in &room.failures[lost.len()..] {
            lost.push(format!("not written: {}", folder.in_place(failure)));
            run.report.end_as(run.report.outcome.max(Outcome::OutputFailed));
            run.report.warnings.extend(lost.last().cloned());
        }
        match vouched(run, scenario, folder, started) {
            Ok(()) => return Ok(lost),
            Err(error) if !room.clear(&SPARE, &error.to_string()) => return Err(error),
            Err(_) => {}
        }
    }
}

/// The scenario, the report, and the manifest that vouches for all.
fn vouched(run: &JudgedRun, scenario: &Scenario, folder: &RunFolder, started: SystemTime) -> Result<(), OutputError> {
    folder.write("scenario.toml", &scenario.resolved)?;
    let report = run.report.to_json();
    folder.write(REPORT, &report)?;
    let manifest = Manifest {
        report_xxh3_64: Some(hash_bytes(report.as_bytes())),
        steps_xxh3_64: hash_file(&folder.staging().join(STEP_LOG)).xxh3_64,
        left: left(folder.staging()),
        ..manifest(run, scenario, started)
    };
    folder.write("manifest.json", &manifest.to_json())
}

/// What can only be written after a whole run, which ended as `result` says.
fn recordings(left: &Left, scenario: &Scenario, result: &str, room: &mut Room<'_>) {
    match (left, &scenario.work) {
        (Left::Arm(left), Work::Arm(experiment)) => of_arm((left, experiment), scenario.recording, result, room),
        (Left::Planar(left), Work::Planar(run)) => planar_files::write((left, run), scenario.recording, result, room),
        _ => room.failures.push("what was run is not what the scenario asks for".to_owned()),
    }
}

fn text<T, E: ToString>(result: Result<T, E>) -> Result<(), String> {
    result.map(|_| ()).map_err(|error| error.to_string())
}

/// The archive first, what is drawn from it last.
fn of_arm((left, experiment): (&RunOutcome, &Experiment), plan: RecordingPlan, result: &str, room: &mut Room<'_>) {
    if plan.steps {
        room.put(STEP_LOG, |place| text(recording::write_step_log(place, left)));
    }
    room.put(SKILL, |place| left.skill.to_json().map_err(|error| error.to_string()).and_then(|json| text(write_file(place, &json))));
    if plan.demonstrations {
        room.put(DEMONSTRATIONS, |place| text(left.dataset.write(place)));
    }
    if plan.hash_every_steps > 0 {
        room.put(STATE_LOG, |place| text(recording::write_state_log(place, &left.traces)));
    }
    if !left.snapshots.all.is_empty() {
        room.put(SNAPSHOTS, |place| {
            left.snapshots.to_bytes().map_err(|error| error.to_string()).and_then(|bytes| text(write_file(place, bytes)))
        });
    }
    if plan.steps && !left.beside.is_empty() {
        room.put(BESIDE, |place| beside(left, place));
    }
    let figures = figure_files::arm_run(experiment, left).and_then(|run| figure_files::of_arm(&run));
    match figures {
        Ok(figures) => room.put("figures", |place| figure_files::drawn(&figures, place)),
        Err(error) => room.failures.push(format!("figures: {error}")),
    }
    #[cfg(feature = "rerun")]
    if plan.rrd {
        room.put("recording.rrd", |place| text(recording::write_recording(place, experiment, left, result)));
    }
}

/// The steps of every execution beside the run, in a file of its own each.
fn beside(left: &RunOutcome, folder: &Path) -> Result<(), String> {
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    left.beside.iter().try_for_each(|one| {
        let place = folder.join(format!("{}.parquet", one.name));
        recording::write_step_log(&place, &one.outcome).map_err(|error| error.to_string())
    })
}

/// What a repetition is held against or taken up from, and what figures are drawn from, of what there is in the folder.
fn left(folder: &Path) -> Vec<FileHash> {
    let files_in = |inner: &'static str| {
        let found = std::fs::read_dir(folder.join(inner)).into_iter().flatten().flatten();
        found.map(move |entry| Path::new(inner).join(entry.file_name()))
    };
    let mut names: Vec<PathBuf> = [DEMONSTRATIONS, BESIDE].into_iter().flat_map(files_in).collect();
    names.sort();
    names.extend([SKILL, STATE_LOG, SNAPSHOTS].map(PathBuf::from));
    names.retain(|name| folder.join(name).is_file());
    names.into_iter().map(|name| FileHash { path: name.clone(), ..hash_file(&folder.join(name)) }).collect()
}

fn manifest(run: &JudgedRun, scenario: &Scenario, started: SystemTime) -> Manifest {
    Manifest {
        command: std::env::args().collect(),
        directory: std::env::current_dir().ok(),
        started_unix_s: started.duration_since(UNIX_EPOCH).ok().map(|since| since.as_secs()),
        scenario_xxh3_64: Some(hash_bytes(scenario.resolved.as_bytes())),
        inputs: scenario.files.iter().chain(&scenario.work.inputs()).map(|path| hash_file(path)).collect(),
        ..Manifest::new(&run.report)
    }
}
