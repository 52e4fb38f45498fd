//! `cpdmp generate`: a skill's movement, without physics.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use nalgebra::DMatrix;
use serde::Serialize;

use super::args::{Format, Global};
use super::failure::Failure;
use super::generate_request::request;
use super::learn::read_skill;
use super::learning_args::Generate;
use super::outside::Outside;
use super::terminal::Terminal;
use crate::demonstration::{Trajectory, read_trajectory, write_trajectory};
use crate::learning::{ExecutionSettings, InferenceSettings, LearningError, Skill, generate as generated, infer};
use crate::report::{Outcome, Replaceable, prepare_file};

/// A movement and what was asked for.
#[derive(Serialize)]
struct Movement {
    schema_version: u32,
    outcome: Outcome,
    exit_code: u8,
    skill: PathBuf,
    /// Where the samples are, when they are in a file.
    written: Option<PathBuf>,
    duration_s: f64,
    theta_m: BTreeMap<String, f64>,
    start: Vec<f64>,
    goal: Vec<f64>,
    /// How far outside the demonstrated range, as a fraction of it; none when the range has no width.
    extrapolation: Option<f64>,
    /// The same of the force model's parameters; none when no wrench was asked for, or the range has no width.
    force_extrapolation: Option<f64>,
    /// Variance of the motion for want of demonstrations over the variance that they show (-): from 1 on the movement is more guessed than
    /// learned. None for the baseline.
    extrapolation_ratio: Option<f64>,
    warnings: Vec<String>,
    /// Names of the columns, the time first.
    columns: Vec<String>,
    /// One list per sample; empty when the samples are in a file.
    rows: Vec<Vec<f64>>,
}

/// Generates a movement to stdout or a file.
pub(super) fn generate(arguments: &Generate, global: &Global, terminal: &Terminal) -> Outcome {
    match moved(arguments, global.out.as_deref(), terminal) {
        Ok((movement, csv)) => {
            movement.warnings.iter().for_each(|warning| terminal.note(&format!("warning: {warning}\n")));
            match (terminal.format, &movement.written) {
                (Format::Json, _) => terminal.json(&movement),
                (Format::Human, None) => terminal.result(&csv),
                (Format::Human, Some(path)) => terminal.note(&format!("written to {}\n", path.display())),
            }
            movement.outcome
        }
        Err(failure) => failure.tell(terminal),
    }
}

fn moved(arguments: &Generate, out: Option<&Path>, terminal: &Terminal) -> Result<(Movement, String), Failure> {
    if let Some(out) = out {
        let known = out.extension().is_some_and(|e| e.eq_ignore_ascii_case("csv") || e.eq_ignore_ascii_case("parquet"));
        if !known {
            let message = format!("--out {}: expected a file that ends in .csv or .parquet", out.display());
            return Err(Failure::new(Outcome::Usage, [message]));
        }
        prepare_file(out, Replaceable::Samples)?;
    }
    let mut skill = read_skill(&arguments.skill)?;
    let observed_from = arguments.observe.as_deref().unwrap_or(&arguments.skill);
    let arguments = &observed(arguments, &skill, terminal).map_err(|error| Failure::of_learning(observed_from, &error))?;
    let settings = request(arguments, &skill).map_err(|slips| Failure::new(Outcome::Usage, slips))?;
    if !arguments.expected_wrench {
        // Its parameters need not be given.
        skill.force = None;
    }
    let failed = |error: LearningError| Failure::of_learning(&arguments.skill, &error);
    if arguments.observe.is_none() {
        skill.ends_agree(&settings).map_err(failed)?;
    }
    let asked = skill.request(&settings).map_err(failed)?;
    let outside = Outside::of(&skill, &asked, &settings).map_err(failed)?;
    if let Some(most) = arguments.deny_extrapolation.filter(|most| outside.worst() > *most) {
        let told =
            outside.warnings().into_iter().map(|warning| format!("{warning}: more than the {most} that --deny-extrapolation allows"));
        return Err(Failure::new(Outcome::CriteriaNotMet, told));
    }
    let trajectory = samples(&skill, &settings, arguments).map_err(failed)?;
    if let Some(out) = out {
        write_trajectory(out, &trajectory).map_err(|error| Failure::new(Outcome::OutputFailed, [error.to_string()]))?;
    }
    let csv = if out.is_none() { trajectory.to_csv() } else { String::new() };
    let names = skill.motion.parameters.names.iter().cloned();
    let in_json = terminal.format == Format::Json && out.is_none();
    let row = |t: usize| std::iter::once(trajectory.times_s()[t]).chain(trajectory.values().row(t).iter().copied()).collect();
    let movement = Movement {
        schema_version: 1,
        outcome: Outcome::Passed,
        exit_code: Outcome::Passed.exit_code(),
        skill: arguments.skill.clone(),
        written: out.map(Path::to_path_buf),
        duration_s: settings.duration_s.unwrap_or(skill.motion.duration_s),
        theta_m: names.zip(asked.theta.iter().copied()).collect(),
        start: asked.start.iter().copied().collect(),
        goal: asked.goal.iter().copied().collect(),
        extrapolation: Some(outside.motion()).filter(|ratio| ratio.is_finite()),
        force_extrapolation: outside.force().filter(|ratio| ratio.is_finite()),
        extrapolation_ratio: outside.uncertainty.filter(|ratio| ratio.is_finite()),
        warnings: outside.warnings(),
        columns: std::iter::once("time_s".to_owned()).chain(trajectory.columns().iter().cloned()).collect(),
        rows: if in_json { (0..trajectory.samples()).map(row).collect() } else { Vec::new() },
    };
    Ok((movement, csv))
}

/// The arguments with the parameters that the observed part of a movement shows, each of which `--theta` may replace.
fn observed(arguments: &Generate, skill: &Skill, terminal: &Terminal) -> Result<Generate, LearningError> {
    let mut arguments = arguments.clone();
    let Some(path) = &arguments.observe else { return Ok(arguments) };
    let settings = InferenceSettings { duration_s: arguments.duration, ..InferenceSettings::default() };
    let inference = infer(skill, &read_trajectory(path)?, &settings)?;
    for (j, (name, value)) in inference.theta.iter().enumerate() {
        let deviation = inference.covariance[(j, j)].max(0.0).sqrt();
        terminal.note(&format!("inferred {name} = {value:.4} +- {deviation:.4} from {}\n", path.display()));
        if !arguments.theta.iter().any(|given| given.split('=').next().is_some_and(|given| given.trim() == name)) {
            arguments.theta.push(format!("{name}={value:?}"));
        }
    }
    Ok(arguments)
}

/// The movement, with the columns that were asked for beside it.
fn samples(skill: &Skill, settings: &ExecutionSettings, arguments: &Generate) -> Result<Trajectory, LearningError> {
    let path = generated(skill, settings, arguments.dt, arguments.until)?;
    let duration = settings.duration_s.unwrap_or(skill.motion.duration_s);
    let u: Vec<f64> = path.times_s().iter().map(|time| time / duration).collect();
    let mut columns = path.columns().to_vec();
    let mut parts = vec![path.values().clone()];
    if arguments.covariance {
        columns.extend(skill.motion.columns.iter().map(|name| format!("std_{name}")));
        parts.push(skill.deviation(&skill.request(settings)?.theta, &u)?);
    }
    if let Some(force) = skill.force.as_ref().filter(|_| arguments.expected_wrench) {
        columns.extend(force.columns.iter().cloned());
        parts.push(skill.expected_wrench(&settings.theta_f, &u)?);
    }
    let all: Vec<_> = parts.iter().flat_map(|part| part.column_iter()).collect();
    Ok(Trajectory::new(path.times_s().to_vec(), columns, DMatrix::from_columns(&all))?)
}
