//! Where a repetition begins: what comes before is taken from the run's folder.

use std::path::Path;

use super::args::{Global, Phase, Replay};
use super::files::SNAPSHOTS;
use super::recorded_run::RecordedManifest;
use crate::scenario::{Scenario, Work, spelled};
use crate::simulation::{Snapshot, Snapshots};

/// Where a repetition begins, when not with the run itself.
pub(super) enum Beginning {
    /// With a phase.
    Phase(Phase),
    /// In the middle of the execution.
    Snapshot(Snapshot),
}

impl Beginning {
    /// What was asked for, of the run in `folder`; or why that cannot be.
    pub fn of(arguments: &Replay, scenario: &Scenario) -> Result<Option<Self>, String> {
        let Some(time_s) = arguments.from_time else { return Ok(arguments.from.map(Self::Phase)) };
        let Work::Arm(experiment) = &scenario.work else {
            return Err("an experiment in the plane has no snapshots: leave --from-time out".to_owned());
        };
        let (snapshots, step_s) = (read(&arguments.folder.join(SNAPSHOTS))?, experiment.physics.step_s);
        let asked = (time_s / step_s + 1e-6).floor() as u64;
        let taken = snapshots.up_to(asked).cloned().map(|snapshot| Some(Self::Snapshot(snapshot)));
        let first = snapshots.all.first().map_or(0.0, |snapshot| snapshot.step as f64 * step_s);
        taken.ok_or_else(|| {
            format!("the first snapshot of the run is that of {first:.3} s: ask for that time or a later one, or begin with --from execute")
        })
    }

    /// The phase that is made again, the first if there are several.
    pub fn phase(&self) -> Phase {
        match self {
            Self::Phase(phase) => *phase,
            Self::Snapshot(_) => Phase::Execute,
        }
    }

    /// The step of the execution after which it is made again.
    pub fn step(&self) -> Option<u64> {
        match self {
            Self::Phase(_) => None,
            Self::Snapshot(snapshot) => Some(snapshot.step),
        }
    }
}

fn read(path: &Path) -> Result<Snapshots, String> {
    let help = "the run made no snapshots that can be read (`recording.snapshot_every_steps`)";
    let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}: {help}", path.display()))?;
    Snapshots::from_bytes(&bytes).map_err(|error| format!("{}: {error}", path.display()))
}

/// What flags would change of what is not made again, and of the recording, which is compared as the run left it.
pub(super) fn ineffective(arguments: &Replay, global: &Global) -> Vec<String> {
    let skipped: &[&str] = match arguments.from {
        None => &[],
        Some(Phase::Learn) => &["teaching", "demonstrations"],
        Some(Phase::Execute) => &["teaching", "demonstrations", "learning"],
    };
    let (phase, in_the_middle) = (arguments.from.map_or("", Phase::name), arguments.from_time.is_some());
    let told = |typed: &String| {
        let key = spelled(typed.split('=').next().unwrap_or_default());
        let table = key.split('.').next().unwrap_or_default();
        let why = if table == "seed" && (in_the_middle || arguments.from.is_some()) {
            "decides the teaching too, which is taken from the folder: leave one of the two out".to_owned()
        } else if table == "recording" {
            "has no effect: replay compares what the run recorded, as often as it did".to_owned()
        } else if skipped.contains(&table) {
            format!("has no effect with --from {phase}: what it decides is taken from the folder; leave one of the two out")
        } else if in_the_middle && table != "human" {
            "cannot be changed in the middle of a run: a snapshot holds what it decides; only [human] goes with --from-time".to_owned()
        } else {
            return None;
        };
        Some(format!("--set {key} {why}"))
    };
    let mut faults: Vec<String> = global.set.iter().filter_map(told).collect();
    let from = if in_the_middle { "--from-time".to_owned() } else { format!("--from {phase}") };
    let taken_up = in_the_middle || arguments.from.is_some();
    let of_run = || RecordedManifest::read(&arguments.folder).ok().and_then(|manifest| manifest.seed());
    if taken_up && global.seed.is_some_and(|seed| of_run() != Some(seed)) {
        faults
            .push(format!("--seed (or CPDMP_SEED) decides the teaching too, which {from} takes from the folder: leave one of the two out"));
    }
    if in_the_middle && global.robot.is_some() {
        faults.push("--robot (or CPDMP_ROBOT) cannot be changed in the middle of a run: leave --from-time out".to_owned());
    }
    faults
}
