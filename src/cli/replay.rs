//! `cpdmp replay`: a run again, held against what its folder holds.

use super::args::{Format, Global, Phase, Replay};
use super::beginning::{Beginning, ineffective};
use super::failure::Failure;
use super::files::{DEMONSTRATIONS, SKILL, SNAPSHOTS, STATE_LOG};
use super::load::options;
use super::progress::Shown;
use super::recorded_run::{Recorded, SCENARIO, as_recorded, is_changed};
use super::repetition::{Repeated, Repetition};
use super::replay_report::ReplayReport;
use super::terminal::Terminal;
use crate::check::{DifferenceKind, ReplayDifference, exact_difference, first_difference};
use crate::report::Outcome;
use crate::scenario::{InvalidScenario, Scenario, Work};
use crate::simulation::{Experiment, TraceDetail, WorldTrace};

/// Runs a run again, or the rest of it from a phase on, and compares every state hash that it left.
pub(super) fn replay(arguments: &Replay, global: &Global, terminal: &Terminal) -> Outcome {
    let folder = arguments.folder.as_path();
    let stop = |outcome, text: &str| Failure::new(outcome, [text.to_owned()]).tell(terminal);
    let without_effect = ineffective(arguments, global);
    if !without_effect.is_empty() {
        return Failure::new(Outcome::Usage, without_effect).tell(terminal);
    }
    let recorded = match Recorded::read(folder, &needed(arguments)) {
        Ok(recorded) => recorded,
        Err(text) => return stop(Outcome::InvalidInput, &text),
    };
    let (path, options) = (folder.join(SCENARIO), recorded.may_use(&options(global)));
    let scenario = match Scenario::load(&path, &options) {
        Ok(scenario) => scenario,
        Err(InvalidScenario(diagnostics)) => {
            let text = format!("{} cannot be run again", folder.display());
            return Failure::new(Outcome::InvalidInput, [text]).because(diagnostics).tell(terminal);
        }
    };
    let original = as_recorded(&path, &options);
    let changed = is_changed(original.as_ref(), &scenario);
    let begun = Beginning::of(arguments, &scenario);
    let (begin, compared) = match begun.and_then(|begin| recorded.from(begin.as_ref()).map(|part| (begin, part))) {
        Ok(both) => both,
        Err(text) => return stop(Outcome::InvalidInput, &text),
    };
    let progress = Shown::new(terminal, global.timeout);
    let repetition = Repetition { folder, from: begin.as_ref(), progress: &progress };
    let repeated = match repetition.of(&scenario) {
        Ok(repeated) => repeated,
        Err((outcome, text)) => {
            drop(progress);
            return stop(outcome, &text);
        }
    };
    let mut difference = first_difference(&compared.traces, &repeated.traces);
    if let (Some(found), true, Some(original)) = (&mut difference, changed, &original) {
        look_closer(found, &compared, original, &scenario, &repetition);
    }
    drop(progress);
    let report = report_of((arguments, begin.as_ref()), &compared, &repeated, difference.as_ref(), changed);
    match terminal.format {
        Format::Human => terminal.result(&report.text()),
        Format::Json => terminal.json(&report),
    }
    report.outcome
}

/// What of the folder the repetition is held against or taken up from.
fn needed(arguments: &Replay) -> Vec<&'static str> {
    let taken_up: &[&str] = match (arguments.from, arguments.from_time) {
        (_, Some(_)) => &[SKILL, SNAPSHOTS],
        (Some(Phase::Execute), None) => &[SKILL],
        (Some(Phase::Learn), None) => &[DEMONSTRATIONS],
        (None, None) => &[],
    };
    [&[STATE_LOG], taken_up].concat()
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
    (arguments, begin): (&Replay, Option<&Beginning>),
    recorded: &Recorded,
    repeated: &Repeated,
    parting: Option<&ReplayDifference>,
    changed: bool,
) -> ReplayReport {
    let same = recorded.state_hash == repeated.state_hash && parting.is_none();
    let outcome = if same { Outcome::Passed } else { Outcome::ReplayDiffers };
    let hashes = recorded.traces.iter().map(|world| world.trace.steps.len()).sum();
    // Each hash is one over all states up to its step: no run leaves all of them and another last one.
    let edited = !same && parting.is_none() && hashes > 0;
    let unknown = match edited {
        true => "all hashes on the way are the same, up to the last step, but not the `state_hash` in manifest.json",
        false => "no hashes were recorded on the way that would say where",
    };
    let reasons = match (same, edited) {
        (true, _) => Vec::new(),
        (false, true) => vec!["manifest.json has been edited since the run: restore it, or make the run again".to_owned()],
        (false, false) => recorded.reasons(changed),
    };
    let report = ReplayReport {
        schema_version: 1,
        run: arguments.folder.clone(),
        from: begin.map(|begin| begin.phase().name()),
        from_step: begin.and_then(Beginning::step),
        outcome,
        exit_code: outcome.exit_code(),
        recorded_state_hash: recorded.state_hash.clone(),
        repeated_state_hash: repeated.state_hash.clone(),
        hashes,
        difference: (!same).then(|| unknown.to_owned()),
        phase: None,
        number: None,
        step: None,
        body: None,
        quantity: None,
        reasons,
    };
    parting.into_iter().fold(report, ReplayReport::parting)
}
