//! The files of a run: report, manifest and resolved scenario always, what was learned and recorded if the run came that far.

use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use super::judged_run::{JudgedRun, Left};
use super::{figure_files, planar_files};
use crate::recording;
use crate::report::{FileHash, Manifest, Outcome, OutputError, RunFolder, hash_bytes, hash_file, write_file};
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

/// Writes everything into the folder. What cannot be written of a recording is returned, and told in the report, which is written all the
/// same.
pub(super) fn write(run: &mut JudgedRun, scenario: &Scenario, folder: &RunFolder, started: SystemTime) -> Result<Vec<String>, OutputError> {
    let failures = run.left.as_ref().map(|left| recordings(left, scenario, folder.staging())).unwrap_or_default();
    let lost: Vec<String> = failures.into_iter().map(|failure| format!("not written: {failure}")).collect();
    if !lost.is_empty() {
        run.report.end_as(run.report.outcome.max(Outcome::OutputFailed));
        run.report.warnings.extend(lost.iter().cloned());
    }
    folder.write("scenario.toml", &scenario.resolved)?;
    let report = run.report.to_json();
    folder.write(REPORT, &report)?;
    // The last one, for it vouches for the others.
    let manifest = Manifest {
        report_xxh3_64: Some(hash_bytes(report.as_bytes())),
        steps_xxh3_64: hash_file(&folder.staging().join(STEP_LOG)).xxh3_64,
        left: left(folder.staging()),
        ..manifest(run, scenario, started)
    };
    folder.write("manifest.json", &manifest.to_json())?;
    Ok(lost)
}

/// What can only be written after a whole run. Returns what could not be written.
fn recordings(left: &Left, scenario: &Scenario, folder: &Path) -> Vec<String> {
    match (left, &scenario.work) {
        (Left::Arm(left), Work::Arm(experiment)) => of_arm(left, experiment, scenario.recording, folder),
        (Left::Planar(left), Work::Planar(run)) => planar_files::write(left, run, scenario.recording, folder),
        _ => vec!["what was run is not what the scenario asks for".to_owned()],
    }
}

fn of_arm(left: &RunOutcome, experiment: &Experiment, plan: RecordingPlan, folder: &Path) -> Vec<String> {
    let mut failures = Vec::new();
    if plan.demonstrations {
        failures.extend(left.dataset.write(&folder.join(DEMONSTRATIONS)).err().map(|error| error.to_string()));
    }
    let skill = left.skill.to_json().map_err(|error| error.to_string());
    let written = skill.and_then(|text| write_file(&folder.join(SKILL), &text).map_err(|error| error.to_string()));
    failures.extend(written.err());
    if plan.steps {
        failures.extend(recording::write_step_log(&folder.join(STEP_LOG), left).err().map(|error| error.to_string()));
        failures.extend(beside(left, &folder.join(BESIDE)).err());
    }
    match figure_files::arm_run(experiment, left).and_then(|run| figure_files::of_arm(&run)) {
        Ok(figures) => failures.extend(figure_files::draw(&figures, &folder.join("figures"))),
        Err(error) => failures.push(format!("figures: {error}")),
    }
    if plan.hash_every_steps > 0 {
        failures.extend(recording::write_state_log(&folder.join(STATE_LOG), &left.traces).err().map(|error| error.to_string()));
    }
    if !left.snapshots.all.is_empty() {
        let bytes = left.snapshots.to_bytes().map_err(|error| error.to_string());
        failures.extend(bytes.and_then(|bytes| write_file(&folder.join(SNAPSHOTS), bytes).map_err(|error| error.to_string())).err());
    }
    #[cfg(feature = "rerun")]
    if plan.rrd {
        failures.extend(recording::write_recording(&folder.join("recording.rrd"), experiment, left).err().map(|error| error.to_string()));
    }
    failures
}

/// The steps of every execution beside the run, in a file of its own each.
fn beside(left: &RunOutcome, folder: &Path) -> Result<(), String> {
    if !left.beside.is_empty() {
        std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
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
