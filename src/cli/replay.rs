//! `cpdmp replay`: a run again, held against what its folder holds.

use super::args::{Format, Global, Phase, Replay};
use super::failure::Failure;
use super::load::options;
use super::progress::Shown;
use super::recorded_run::{Recorded, is_changed};
use super::repetition::{Repeated, Repetition};
use super::replay_report::ReplayReport;
use super::terminal::Terminal;
use crate::check::{DifferenceKind, ReplayDifference, exact_difference, first_difference};
use crate::report::Outcome;
use crate::scenario::{InvalidScenario, LoadOptions, Scenario, Work, spelled};
use crate::simulation::{Experiment, TraceDetail, WorldTrace};

/// Runs a run again, or the rest of it from a phase on, and compares every state hash that it left.
pub(super) fn replay(arguments: &Replay, global: &Global, terminal: &Terminal) -> Outcome {
    let folder = arguments.folder.as_path();
    let stop = |outcome, text: &str| Failure::new(outcome, [text.to_owned()]).tell(terminal);
    let without_effect = ineffective(arguments.from, global);
    if !without_effect.is_empty() {
        return Failure::new(Outcome::Usage, without_effect).tell(terminal);
    }
    let recorded = match Recorded::read(folder).and_then(|recorded| recorded.from(arguments.from)) {
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
    let repetition = Repetition { folder, from: arguments.from, progress: &progress };
    let repeated = match repetition.of(&scenario) {
        Ok(repeated) => repeated,
        Err((outcome, text)) => {
            drop(progress);
            return stop(outcome, &text);
        }
    };
    let mut difference = first_difference(&recorded.traces, &repeated.traces);
    if let (Some(found), true) = (&mut difference, is_changed(global))
        && let Ok(as_recorded) = load(&LoadOptions::default())
    {
        look_closer(found, &recorded, &as_recorded, &scenario, &repetition);
    }
    drop(progress);
    let report = report_of(arguments, &recorded, &repeated, difference.as_ref(), global);
    match terminal.format {
        Format::Human => terminal.result(&report.text()),
        Format::Json => terminal.json(&report),
    }
    report.outcome
}

/// What flags would change of phases that are not made again, and of the recording, which is compared as the run left it.
fn ineffective(from: Option<Phase>, global: &Global) -> Vec<String> {
    let skipped: &[&str] = match from {
        None => &[],
        Some(Phase::Learn) => &["teaching", "demonstrations"],
        Some(Phase::Execute) => &["teaching", "demonstrations", "learning"],
    };
    let phase = from.map_or("", Phase::name);
    let told = |typed: &String| {
        let key = spelled(typed.split('=').next().unwrap_or_default());
        let table = key.split('.').next().unwrap_or_default();
        if skipped.contains(&table) {
            Some(format!(
                "--set {key} has no effect with --from {phase}: what it decides is taken from the folder; leave one of the two out"
            ))
        } else {
            (table == "recording").then(|| format!("--set {key} has no effect: replay compares what the run recorded, as often as it did"))
        }
    };
    let mut faults: Vec<String> = global.set.iter().filter_map(told).collect();
    if from.is_some() && global.seed.is_some() {
        faults.push(format!("--seed decides the teaching, which --from {phase} takes from the folder: leave one of the two out"));
    }
    faults
}

/// Finds the very step, by running both scenarios again and keeping whole states where the hashes part. Possible only where the recorded run
/// can be made again to the last bit, which is looked at first.
fn look_closer(found: &mut ReplayDifference, recorded: &Recorded, as_recorded: &Scenario, changed: &Scenario, repetition: &Repetition) {
    let (Work::Arm(original), Work::Arm(changed)) = (&as_recorded.work, &changed.work) else { return };
    let DifferenceKind::Between { equal_up_to, step, .. } = found.what else { return };
    let steps = equal_up_to.map_or(0, |equal| equal + 1)..=step;
    let traces = |experiment: &Experiment| {
        let mut experiment = experiment.clone();
        experiment.trace.detail = Some(TraceDetail { phase: found.phase.clone(), number: found.number, steps: steps.clone() });
        repetition.traces(&experiment).unwrap_or_default()
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

/// What there is to say about a run and its repetition.
fn report_of(
    arguments: &Replay,
    recorded: &Recorded,
    repeated: &Repeated,
    parting: Option<&ReplayDifference>,
    global: &Global,
) -> ReplayReport {
    let same = recorded.state_hash == repeated.state_hash && parting.is_none();
    let outcome = if same { Outcome::Passed } else { Outcome::ReplayDiffers };
    let unknown = "no hashes were recorded on the way that would say where";
    let report = ReplayReport {
        schema_version: 1,
        run: arguments.folder.clone(),
        from: arguments.from.map(Phase::name),
        outcome,
        exit_code: outcome.exit_code(),
        recorded_state_hash: recorded.state_hash.clone(),
        repeated_state_hash: repeated.state_hash.clone(),
        hashes: recorded.traces.iter().map(|world| world.trace.steps.len()).sum(),
        difference: (!same).then(|| unknown.to_owned()),
        phase: None,
        number: None,
        step: None,
        body: None,
        quantity: None,
        reasons: if same { Vec::new() } else { recorded.reasons(global) },
    };
    parting.into_iter().fold(report, ReplayReport::parting)
}
