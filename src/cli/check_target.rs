//! What `cpdmp check` is asked to judge: scenarios, stored runs, trajectories.

use std::path::{Path, PathBuf};

use super::args::Check;
use super::files::{REPORT, SKILL, SNAPSHOTS, STATE_LOG, STEP_LOG};
use super::recorded_run::SCENARIO;
use super::select::{inside, is_pattern, is_scenario, matching, scenarios};
use super::terminal::Terminal;
use crate::report::Outcome;

/// One thing to check.
#[derive(PartialEq)]
pub(super) enum Target {
    /// A scenario, which is simulated.
    Scenario(PathBuf),
    /// The folder of a run, whose logged movement is judged again.
    Run(PathBuf),
    /// A file with a movement, which is judged in the scene of this scenario.
    Trajectory(PathBuf, PathBuf),
}

/// Extensions of files with samples.
const SAMPLES: [&str; 4] = ["csv", "tsv", "txt", "parquet"];

/// Everything that the arguments name, in their order, nothing twice. An argument that names nothing is reported.
pub(super) fn targets(arguments: &Check, terminal: &Terminal) -> Result<Vec<Target>, Outcome> {
    let mut targets: Vec<Target> = Vec::new();
    let mut outcome = Outcome::Passed;
    let scene = arguments.scene.as_deref();
    for path in &arguments.paths {
        // What matches a pattern is as good as an argument.
        let named = if is_pattern(path) { matching(path) } else { vec![path.clone()] };
        let unjudged = if scene.is_some() { 0 } else { named.iter().map(|one| samples(one).len()).sum() };
        if unjudged > 0 && is_samples(path) {
            let path = path.display();
            terminal.error(&format!("error: {path} is a movement: say with --scene SCENARIO in which scene it is judged\n"));
            outcome = outcome.max(Outcome::Usage);
            continue;
        }
        if unjudged > 0 {
            let path = path.display();
            terminal.note(&format!("{path}: {unjudged} files of samples are not judged: say with --scene SCENARIO in which scene\n"));
        }
        let found: Vec<Target> = named.iter().flat_map(|one| of_one(one, scene, one != path)).collect();
        if found.is_empty() {
            terminal.error(&format!("error: {} names no scenario, run or trajectory\n", path.display()));
            outcome = outcome.max(Outcome::NothingSelected);
        }
        for target in found {
            if !targets.contains(&target) {
                targets.push(target);
            }
        }
    }
    if outcome == Outcome::Passed && scene.is_some() && !targets.iter().any(|target| matches!(target, Target::Trajectory(..))) {
        terminal.error("error: --scene has no effect: no argument names a file of samples, or a folder that holds some\n");
        outcome = outcome.max(Outcome::Usage);
    }
    if outcome == Outcome::Passed { Ok(targets) } else { Err(outcome) }
}

/// What one path names; a file that only a pattern has `matched` may be none of ours.
fn of_one(path: &Path, scene: Option<&Path>, matched: bool) -> Vec<Target> {
    let moved = scene.iter().flat_map(|scene| samples(path).into_iter().map(|file| Target::Trajectory(file, scene.to_path_buf())));
    if is_run(path) {
        vec![Target::Run(path.to_path_buf())]
    } else if path.is_dir() {
        let runs = inside(path).into_iter().filter(|folder| folder.is_dir() && is_run(folder)).map(Target::Run);
        scenarios(path).into_iter().map(Target::Scenario).chain(runs).chain(moved).collect()
    } else if is_samples(path) {
        moved.collect()
    } else if matched && !is_scenario(path) {
        Vec::new()
    } else {
        vec![Target::Scenario(path.to_path_buf())]
    }
}

/// Whether it is the folder of a run: also one whose manifest is lost, which is refused as such. Taken for a scenario, it would be simulated.
fn is_run(path: &Path) -> bool {
    let held = |names: &[&str]| names.iter().filter(|name| path.join(name).exists()).count();
    // A scenario and a skill may lie side by side in anybody's folder; what only a run leaves does not.
    let left = held(&[REPORT, STEP_LOG, STATE_LOG, SNAPSHOTS, "recording.rrd"]);
    held(&["manifest.json"]) > 0 || (left > 0 && left + held(&[SCENARIO, SKILL]) > 1)
}

/// Whether it is named like a file of samples.
pub(super) fn is_samples(path: &Path) -> bool {
    path.extension().is_some_and(|extension| SAMPLES.iter().any(|known| extension.eq_ignore_ascii_case(known)))
}

/// The files of samples in a folder, sorted; of a file itself.
fn samples(path: &Path) -> Vec<PathBuf> {
    let all = if path.is_dir() && !is_run(path) { inside(path) } else { vec![path.to_path_buf()] };
    all.into_iter().filter(|file| is_samples(file) && !file.is_dir()).collect()
}
