//! What `cpdmp generate` is asked for, by name: every slip of the command line at once.

use nalgebra::{Quaternion, UnitQuaternion};

use super::learning_args::{Generate, Method};
use crate::demonstration::QUATERNION_COLUMNS;
use crate::learning::dmp::Integrator;
use crate::learning::{ExecutionSettings, ParameterSpace, Skill};
use crate::scenario::did_you_mean;

/// The largest magnitude that can be asked for: squares of it stay finite.
const LARGEST: f64 = 1e100;

/// The settings of the movement.
///
/// # Errors
/// Everything that makes no sense, a sentence each.
pub(super) fn request(arguments: &Generate, skill: &Skill) -> Result<ExecutionSettings, Vec<String>> {
    let mut slips = Vec::new();
    let motion = &skill.motion;
    let none = ParameterSpace::default();
    let force = skill.force.as_ref().map_or(&none, |force| &force.parameters);
    let mut known = motion.parameters.names.clone();
    known.extend(force.names.iter().filter(|name| !motion.parameters.names.contains(name)).cloned());
    let theta = assigned("--theta", &arguments.theta, &known, &mut slips);
    let mut columns = motion.columns.clone();
    columns.extend(skill.orientation.iter().flat_map(|_| QUATERNION_COLUMNS.map(str::to_owned)));
    let mut start = assigned("--start", &arguments.start, &columns, &mut slips);
    let mut goal = assigned("--goal", &arguments.goal, &columns, &mut slips);
    let start_orientation = orientation("--start", &mut start, &mut slips);
    let goal_orientation = orientation("--goal", &mut goal, &mut slips);
    let mut positive = |flag: &str, value: f64| {
        if !(value > 0.0 && value.is_finite()) {
            slips.push(format!("{flag} is {value}, but must be a positive number"));
        }
    };
    positive("--dt", arguments.dt);
    positive("--until", arguments.until);
    arguments.duration.into_iter().for_each(|duration| positive("--duration", duration));
    if arguments.deny_extrapolation.is_some_and(|ratio| ratio.is_nan() || ratio < 0.0) {
        slips.push("--deny-extrapolation must be a number from 0 on".to_owned());
    }
    if arguments.expected_wrench && skill.force.is_none() {
        slips.push("--expected-wrench: the skill has no force model".to_owned());
    }
    if arguments.covariance && motion.shaping.phmm().is_none() {
        slips.push("--covariance: the skill is the baseline, which has no covariance".to_owned());
    }
    let read_off = skill.parameter_source.word();
    let from_ends = read_off != "given" && !theta.iter().any(|(name, _)| motion.parameters.names.contains(name));
    let theta_m = if from_ends { Vec::new() } else { values(&motion.parameters, &theta, &mut slips) };
    let theta_f = if arguments.expected_wrench { values(force, &theta, &mut slips) } else { Vec::new() };
    if from_ends && start.is_empty() && goal.is_empty() && !motion.parameters.names.is_empty() {
        let end = if read_off == "goal" { "goal" } else { "start" };
        slips.push(format!("the skill's parameters are read off its {end}: --{end} is missing, for [{}]", motion.columns.join(", ")));
    }
    if !slips.is_empty() {
        return Err(slips);
    }
    let learned = learned_ends(skill, &theta_m);
    let filled = |named: &[(String, f64)], learned: &[f64]| {
        let value = |(name, learned): (&String, &f64)| named.iter().find(|(other, _)| other == name).map_or(*learned, |(_, v)| *v);
        (!named.is_empty()).then(|| motion.columns.iter().zip(learned).map(value).collect::<Vec<f64>>())
    };
    let (start, goal) = (filled(&start, &learned.0), filled(&goal, &learned.1));
    let integrator = match arguments.integrator {
        Method::Hold => Integrator::ExactHold,
        Method::Rk4 => Integrator::RungeKutta4,
    };
    let duration_s = arguments.duration;
    let ends = ExecutionSettings { start, goal, start_orientation, goal_orientation, ..ExecutionSettings::default() };
    Ok(ExecutionSettings { theta_m, theta_f, duration_s, integrator, ..ends })
}

/// Takes the quaternion (x, y, z, w) out of what was named, if it is there: all four components, of any length but zero.
fn orientation(flag: &str, named: &mut Vec<(String, f64)>, slips: &mut Vec<String>) -> Option<UnitQuaternion<f64>> {
    let components = QUATERNION_COLUMNS.map(|column| named.iter().find(|(name, _)| name == column).map(|(_, value)| *value));
    named.retain(|(name, _)| !QUATERNION_COLUMNS.contains(&name.as_str()));
    match components {
        [None, None, None, None] => None,
        [Some(x), Some(y), Some(z), Some(w)] => {
            let quaternion = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9);
            if quaternion.is_none() {
                slips.push(format!("{flag}: qx, qy, qz, qw are all zero, which is no orientation"));
            }
            quaternion
        }
        _ => {
            let missing = QUATERNION_COLUMNS.iter().zip(&components).filter(|(_, value)| value.is_none()).map(|(name, _)| *name);
            slips.push(format!("{flag}: an orientation has four components; missing: {}", missing.collect::<Vec<_>>().join(", ")));
            None
        }
    }
}

/// Start and goal at these parameters; those that are read off the movement stand in the middle of what was demonstrated.
fn learned_ends(skill: &Skill, theta_m: &[(String, f64)]) -> (Vec<f64>, Vec<f64>) {
    let space = &skill.motion.parameters;
    let middle = |(name, [from, to]): (&String, &[f64; 2])| {
        theta_m.iter().find(|(other, _)| other == name).map_or(from / 2.0 + to / 2.0, |(_, value)| *value)
    };
    let theta: Vec<f64> = space.names.iter().zip(&space.ranges).map(middle).collect();
    let (start, goal) = skill.ends_at(&theta.into());
    (start.iter().copied().collect(), goal.iter().copied().collect())
}

/// A value for every parameter: as given, or the one that all demonstrations shared.
fn values(space: &ParameterSpace, given: &[(String, f64)], slips: &mut Vec<String>) -> Vec<(String, f64)> {
    let mut values = Vec::new();
    for (name, [from, to]) in space.names.iter().zip(&space.ranges) {
        match given.iter().find(|(other, _)| other == name) {
            Some((_, value)) => values.push((name.clone(), *value)),
            None if from == to => values.push((name.clone(), *from)),
            None => {
                let range = if from.abs() < f64::MAX { format!(" (demonstrated: {from} to {to})") } else { String::new() };
                slips.push(format!("--theta {name}=VALUE is missing{range}"));
            }
        }
    }
    values
}

/// `NAME=VALUE` each.
fn assigned(flag: &str, typed: &[String], known: &[String], slips: &mut Vec<String>) -> Vec<(String, f64)> {
    let mut values: Vec<(String, f64)> = Vec::new();
    for text in typed {
        let Some((name, value)) = text.split_once('=').map(|(name, value)| (name.trim(), value.trim())) else {
            slips.push(format!("{flag} {text}: no `=`; expected NAME=VALUE"));
            continue;
        };
        if !known.iter().any(|other| other == name) {
            let guess = did_you_mean(name, known.iter().map(String::as_str)).map_or(String::new(), |guess| format!("; {guess}"));
            slips.push(format!("{flag} {text}: no `{name}`; known: [{}]{guess}", known.join(", ")));
        }
        if values.iter().any(|(other, _)| other == name) {
            slips.push(format!("{flag} {text}: `{name}` is given twice"));
        }
        match value.parse::<f64>() {
            Ok(number) if number.is_finite() && number.abs() > LARGEST => {
                slips.push(format!("{flag} {text}: `{value}` is too large to be computed with (up to {LARGEST:e})"));
            }
            Ok(number) if number.is_finite() => values.push((name.to_owned(), number)),
            _ => slips.push(format!("{flag} {text}: `{value}` is not a finite number")),
        }
    }
    values
}
