//! `cpdmp replay`: a run again, held against what its folder holds.

use std::path::{Path, PathBuf};

use serde::Serialize;
use serde_json::Value;

use super::args::{Format, Global};
use super::failure::Failure;
use super::files::STATE_LOG;
use super::judged_run::{JudgedRun, Left, judged_run};
use super::load::options;
use super::progress::Shown;
use super::terminal::Terminal;
use crate::check::{DifferenceKind, ReplayDifference, exact_difference, first_difference, planar_traces};
use crate::recording::read_state_log;
use crate::report::{Host, Outcome, hash_file};
use crate::scenario::{InvalidScenario, LoadOptions, Scenario, Work};
use crate::simulation::{self, Experiment, Progress, TraceDetail, WorldTrace};

/// What the folder of a run says about it.
struct Recorded {
    manifest: Value,
    state_hash: String,
    traces: Vec<WorldTrace>,
}

/// Runs a run again and compares every state hash that it left.
pub(super) fn replay(folder: &Path, global: &Global, terminal: &Terminal) -> Outcome {
    let stop = |outcome, text: &str| Failure::new(outcome, [text.to_owned()]).tell(terminal);
    let recorded = match Recorded::read(folder) {
        Ok(recorded) => recorded,
        Err(text) => return stop(Outcome::InvalidInput, &text),
    };
    let path = folder.join("scenario.toml");
    let load = |options: &LoadOptions| Scenario::load(&path, &recorded.may_use(options));
    let scenario = match load(&options(global)) {
        Ok(scenario) => scenario,
        Err(InvalidScenario(diagnostics)) => {
            let text = format!("{} cannot be run again", folder.display());
            return Failure::new(Outcome::InvalidInput, [text]).because(diagnostics).tell(terminal);
        }
    };
    let progress = Shown::new(terminal, global.timeout);
    let run = judged_run(&scenario, &progress);
    let Some(repeated) = Repeated::of(&run, &scenario) else {
        drop(progress);
        return stop(run.report.outcome, run.report.error.as_deref().unwrap_or("the run could not be repeated"));
    };
    let mut difference = first_difference(&recorded.traces, &repeated.traces);
    if let (Some(found), true) = (&mut difference, is_changed(global))
        && let Ok(as_recorded) = load(&LoadOptions::default())
    {
        look_closer(found, &recorded, &as_recorded, &scenario, &progress);
    }
    drop(progress);
    let told = Told::of(folder, &recorded, &repeated, difference.as_ref(), global);
    tell(&told, terminal);
    told.outcome
}

impl Recorded {
    fn read(folder: &Path) -> Result<Self, String> {
        let place = folder.join("manifest.json");
        let text =
            std::fs::read_to_string(&place).map_err(|error| format!("{} is no run: {}: {error}", folder.display(), place.display()))?;
        let manifest: Value = serde_json::from_str(&text).unwrap_or_default();
        if manifest["format"] != "cpdmp-run" {
            return Err(format!("{} is not the folder of a run", folder.display()));
        }
        let Some(state_hash) = manifest["state_hash"].as_str().map(str::to_owned) else {
            return Err(format!("{} holds a run that did not come to its end: there is nothing to compare with", folder.display()));
        };
        let traces = match read_state_log(&folder.join(STATE_LOG)) {
            Ok(traces) => traces,
            // A run may be recorded without them; its last hash is in the manifest.
            Err(_) if !folder.join(STATE_LOG).exists() => Vec::new(),
            Err(error) => return Err(error.to_string()),
        };
        Ok(Self { manifest, state_hash, traces })
    }

    /// The files that decided the run, as they are found from here, with the hash that each had.
    fn inputs(&self) -> Vec<(PathBuf, Option<&str>)> {
        let directory = Path::new(self.manifest["directory"].as_str().unwrap_or_default());
        let inputs = self.manifest["inputs"].as_array().map_or(&[][..], Vec::as_slice);
        let input = |input: &'_ Value| Some(directory.join(input["path"].as_str()?));
        inputs.iter().filter_map(|found| Some((input(found)?, found["xxh3_64"].as_str()))).collect()
    }

    /// The options, with the folders of those files allowed: the run was allowed to use them.
    fn may_use(&self, options: &LoadOptions) -> LoadOptions {
        let folders = self.inputs().into_iter().filter_map(|(path, _)| Some(path.parent()?.to_path_buf()));
        let mut allowed = options.clone();
        allowed.asset_roots.extend(folders);
        allowed
    }

    /// Why bits may differ, as far as the folder tells.
    fn reasons(&self, global: &Global) -> Vec<String> {
        let mut reasons = Vec::new();
        if is_changed(global) {
            reasons.push("flags make it another run than the recorded one".to_owned());
        }
        // The scenario's own files do not matter: what they said is in the folder's scenario.toml.
        let decisive = self.inputs().into_iter().filter(|(path, _)| path.extension().is_none_or(|extension| extension != "toml"));
        let changed = decisive.filter(|(path, hash)| hash_file(path).xxh3_64.as_deref() != *hash);
        reasons.extend(changed.map(|(path, _)| format!("{} has changed since the run", path.display())));
        let text = |value: &Value| value.as_str().unwrap_or("unknown").to_owned();
        let (version, host) = (text(&self.manifest["version"]), Host::this());
        let arch = text(&self.manifest["host"]["arch"]);
        if version != env!("CARGO_PKG_VERSION") || arch != host.arch {
            let this = format!("cpdmp {} on {}", env!("CARGO_PKG_VERSION"), host.arch);
            reasons.push(format!("made by cpdmp {version} on {arch}, repeated by {this}: equal bits are promised for the same program on the same architecture only"));
        }
        if reasons.is_empty() {
            reasons.push("same version, architecture and input: equal bits are promised for the same binary, so this is another build, or a bug to report".to_owned());
        }
        reasons
    }
}

/// Whether flags make the repetition another run.
fn is_changed(global: &Global) -> bool {
    !global.set.is_empty() || global.seed.is_some() || global.robot.is_some()
}

/// What the repetition left.
struct Repeated {
    state_hash: String,
    traces: Vec<WorldTrace>,
}

impl Repeated {
    fn of(run: &JudgedRun, scenario: &Scenario) -> Option<Self> {
        let traces = match run.left.as_ref()? {
            Left::Arm(left) => left.traces.clone(),
            Left::Planar(left) => planar_traces(left, scenario.recording.hash_every_steps),
        };
        Some(Self { state_hash: run.report.state_hash.clone()?, traces })
    }
}

/// Finds the very step, by running both scenarios again and keeping whole states where the hashes part. Possible only where the recorded run
/// can be made again to the last bit, which is looked at first.
fn look_closer(found: &mut ReplayDifference, recorded: &Recorded, as_recorded: &Scenario, changed: &Scenario, progress: &dyn Progress) {
    let (Work::Arm(original), Work::Arm(changed)) = (&as_recorded.work, &changed.work) else { return };
    let DifferenceKind::Between { equal_up_to, step, .. } = found.what else { return };
    let steps = equal_up_to.map_or(0, |equal| equal + 1)..=step;
    let traces = |experiment: &Experiment| {
        let mut experiment = experiment.clone();
        experiment.trace.detail = Some(TraceDetail { phase: found.phase.clone(), number: found.number, steps: steps.clone() });
        simulation::run(&experiment, progress).map(|left| left.traces).unwrap_or_default()
    };
    let original = traces(original);
    if first_difference(&recorded.traces, &original).is_some() {
        return;
    }
    let changed = traces(changed);
    let of = |traces: &[WorldTrace]| {
        let place = traces.iter().position(|world| world.phase == found.phase && world.number == found.number)?;
        Some(traces[place].trace.clone())
    };
    if let (Some(ours), Some(theirs)) = (of(&original), of(&changed))
        && let Some(exact) = exact_difference(&ours, &theirs)
    {
        found.what = exact;
    }
}

/// What programs read about a repetition.
#[derive(Serialize)]
struct Told {
    schema_version: u32,
    run: PathBuf,
    outcome: Outcome,
    exit_code: u8,
    recorded_state_hash: String,
    repeated_state_hash: String,
    /// Hashes that were compared on the way.
    hashes: usize,
    /// Where the two first part, in words.
    difference: Option<String>,
    phase: Option<String>,
    number: Option<u64>,
    step: Option<u64>,
    body: Option<String>,
    quantity: Option<&'static str>,
    /// What explains it.
    reasons: Vec<String>,
}

impl Told {
    fn of(folder: &Path, recorded: &Recorded, repeated: &Repeated, difference: Option<&ReplayDifference>, global: &Global) -> Self {
        let same = recorded.state_hash == repeated.state_hash && difference.is_none();
        let outcome = if same { Outcome::Passed } else { Outcome::ReplayDiffers };
        let (step, part) = match difference.map(|difference| &difference.what) {
            Some(DifferenceKind::Between { step, parts, .. }) => (Some(*step), parts.first().cloned()),
            Some(DifferenceKind::Exact { step, body, quantity, .. }) => (Some(*step), Some((body.clone(), *quantity))),
            _ => (None, None),
        };
        let unknown = || "no hashes were recorded on the way that would say where".to_owned();
        Self {
            schema_version: 1,
            run: folder.to_path_buf(),
            outcome,
            exit_code: outcome.exit_code(),
            recorded_state_hash: recorded.state_hash.clone(),
            repeated_state_hash: repeated.state_hash.clone(),
            hashes: recorded.traces.iter().map(|world| world.trace.steps.len()).sum(),
            difference: (!same).then(|| difference.map_or_else(unknown, ToString::to_string)),
            phase: difference.map(|difference| difference.phase.clone()),
            number: difference.map(|difference| difference.number),
            step,
            body: part.as_ref().map(|(body, _)| body.clone()),
            quantity: part.map(|(_, quantity)| quantity),
            reasons: if same { Vec::new() } else { recorded.reasons(global) },
        }
    }
}

fn tell(told: &Told, terminal: &Terminal) {
    if terminal.format == Format::Json {
        return terminal.json(told);
    }
    let run = told.run.display();
    match &told.difference {
        None => terminal.result(&format!("{run}: identical, state hash {}, {} hashes on the way\n", told.repeated_state_hash, told.hashes)),
        Some(difference) => terminal.result(&format!(
            "{run}: differs, state hash {} instead of {}\n  {difference}\n  {}\n",
            told.repeated_state_hash,
            told.recorded_state_hash,
            told.reasons.join("\n  ")
        )),
    }
}
