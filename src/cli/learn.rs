//! `cpdmp learn`: a skill from demonstrations of any origin.

use std::path::Path;

use super::args::{Format, Global};
use super::failure::Failure;
use super::learning_args::{Learn, Theta};
use super::terminal::Terminal;
use crate::demonstration::{Dataset, Import, ParameterSource};
use crate::learning::selection::{cross_validate, reproduction};
use crate::learning::{self, LearningError, LearningSettings, ShapingKind, Skill};
use crate::report::{LearnReport, Outcome, Replaceable, prepare_file, replace_file};
use crate::scenario::{Diagnostic, LearningOptions, learning_settings};

/// Learns, tells what came of it, and writes the skill when it was given a place.
pub(super) fn learn(arguments: &Learn, global: &Global, terminal: &Terminal) -> Outcome {
    match learned(arguments, global, terminal) {
        Ok(report) => {
            match terminal.format {
                Format::Human => terminal.result(&report.text()),
                Format::Json => terminal.json(&report),
            }
            match &report.written {
                Some(path) => terminal.note(&format!("written to {}\n", path.display())),
                None => terminal.note("nothing was written: --out SKILL.json keeps the skill\n"),
            }
            report.outcome
        }
        Err(failure) => failure.tell(terminal),
    }
}

fn learned(arguments: &Learn, global: &Global, terminal: &Terminal) -> Result<LearnReport, Failure> {
    let (settings, odd) = settings(arguments, global)?;
    terminal.faults(&odd);
    // Whether the skill can be written is known before time is spent on it.
    if let Some(out) = &global.out {
        prepare_file(out, Replaceable::Skill)?;
    }
    if arguments.init.is_some() && [settings.motion_selection, settings.force_selection].iter().any(|s| s.ridge || s.states.is_some()) {
        let help = "--init keeps the numbers of states of the first skill and starts from nothing else: give numbers instead of \"auto\"";
        return Err(Failure::new(Outcome::InvalidInput, [help.to_owned()]));
    }
    let path = &arguments.dataset;
    let Import { dataset, notes, warnings } = dataset(arguments).map_err(|error| Failure::of_learning(path, &error))?;
    let first = arguments.init.as_deref().map(read_skill).transpose()?;
    let seed = global.seed.unwrap_or(0);
    let of_data = |error: LearningError| Failure::of_learning(arguments.init.as_ref().unwrap_or(path), &error);
    terminal.note(&work_ahead(&dataset, &settings, arguments.cross_validate));
    let learned = match &first {
        Some(first) => learning::learn_from(&dataset, &settings, seed, first),
        None => learning::learn(&dataset, &settings, seed),
    };
    let learned = learned.map_err(of_data)?;
    let repeated = reproduction(&dataset, &learned.skill).map_err(of_data)?;
    let validated = arguments.cross_validate.then(|| cross_validate(&dataset, &settings, seed)).transpose().map_err(of_data)?;
    let mut report = LearnReport::of((path.clone(), &dataset), notes, &learned, &repeated, validated.as_ref(), seed).map_err(of_data)?;
    report.warnings.splice(0..0, warnings);
    if let Some(out) = &global.out {
        let text = learned.skill.to_json().map_err(of_data)?;
        replace_file(out, text.as_bytes(), Replaceable::Skill)?;
        report.written = Some(out.clone());
    }
    Ok(report)
}

/// From how many samples on learning takes long.
const MANY_SAMPLES: f64 = 50_000.0;

/// What is about to take long, so that nobody waits before a silent screen; nothing when it will not.
fn work_ahead(dataset: &Dataset, settings: &LearningSettings, cross_validated: bool) -> String {
    let hidden_markov = settings.shaping == ShapingKind::Phmm;
    let models = [
        ("motion", settings.motion_selection, hidden_markov),
        ("force", settings.force_selection, hidden_markov && !dataset.wrench.is_empty()),
    ];
    let chosen = models.into_iter().filter(|(_, _, learned)| *learned).flat_map(|(model, selection, _)| {
        let states = selection.states.map(|search| format!("the {model} model with {} to {} states", search.min, search.max));
        let ridge = selection.ridge.then(|| format!("the {model} model with each ridge"));
        states.into_iter().chain(ridge)
    });
    let samples: f64 = dataset.demonstrations.iter().map(|d| d.trajectory.duration_s() * settings.rate_hz).sum();
    let many = (samples > MANY_SAMPLES).then(|| {
        let longest = dataset.demonstrations.iter().map(|d| d.trajectory.duration_s()).fold(0.0, f64::max);
        let help = "is its time in seconds (a column time_ms is understood)? rate_hz sets the rate";
        format!("from {samples:.0} samples at {} Hz, since a demonstration lasts {longest:.0} s: {help}", settings.rate_hz)
    });
    let again = cross_validated.then(|| "everything once more for each parameter value left out".to_owned());
    let ahead: Vec<String> = many.into_iter().chain(chosen).chain(again).collect();
    if ahead.is_empty() {
        String::new()
    } else {
        let many = dataset.demonstrations.len();
        format!("{many} demonstration{}; learning {}\n", if many == 1 { "" } else { "s" }, ahead.join(", "))
    }
}

/// Reads a skill; what is wrong with it names its file.
pub(super) fn read_skill(path: &Path) -> Result<Skill, Failure> {
    Skill::read(path).map_err(|error| Failure::of_learning(path, &error))
}

fn settings(arguments: &Learn, global: &Global) -> Result<(LearningSettings, Vec<Diagnostic>), Failure> {
    let typed = [
        ("--states", "motion.states", &arguments.states),
        ("--force-states", "force.states", &arguments.force_states),
        ("--stiffness", "stiffness", &arguments.stiffness),
        ("--features", "motion.features", &arguments.features),
        ("--ridge", "motion.ridge", &arguments.ridge),
        ("--ridge", "force.ridge", &arguments.ridge),
        ("--max-iterations", "motion.max_iterations", &arguments.max_iterations),
        ("--max-iterations", "force.max_iterations", &arguments.max_iterations),
        ("--tolerance", "motion.tolerance", &arguments.tolerance),
        ("--tolerance", "force.tolerance", &arguments.tolerance),
    ];
    let mut flags: Vec<_> = typed.into_iter().filter_map(|(flag, key, value)| Some((flag, key, value.clone()?))).collect();
    if arguments.baseline {
        flags.push(("--baseline", "shaping", "lwr".to_owned()));
    }
    let options = LearningOptions { file: arguments.settings.clone(), set: global.set.clone(), flags, lenient: global.lenient };
    let (mut settings, odd) = learning_settings(&options)?;
    settings.align |= arguments.align;
    Ok((settings, odd))
}

/// The dataset, with the columns and parameters that the flags ask for, and what reading it did to the data and made of it.
fn dataset(arguments: &Learn) -> Result<Import, LearningError> {
    let Import { mut dataset, notes, mut warnings } = Dataset::import(&arguments.dataset)?;
    if !arguments.motion.is_empty() {
        dataset.motion.clone_from(&arguments.motion);
        // Who lists the columns knows what they are.
        warnings.clear();
    }
    if !arguments.wrench.is_empty() || arguments.no_wrench {
        dataset.wrench.clone_from(&arguments.wrench);
    }
    let source = match arguments.theta {
        Some(Theta::Given) | None => dataset.parameter_source,
        Some(Theta::Start) => ParameterSource::Start,
        Some(Theta::Goal) => ParameterSource::Goal,
        Some(Theta::StartRelativeToGoal) => ParameterSource::StartRelativeToGoal,
    };
    let dataset = dataset.with_parameter_source(source);
    dataset.check()?;
    Ok(Import { dataset, notes, warnings })
}
