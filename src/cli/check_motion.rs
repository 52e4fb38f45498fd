//! `cpdmp check` of a movement that is not simulated, in the scene of a scenario.

use std::path::{Path, PathBuf};

use super::check::faults;
use super::judged_run::outcome_of;
use super::located::Located;
use super::progress::Clock;
use super::terminal::Terminal;
use crate::check::{CriterionSpec, allow, judge_motion};
use crate::control::WRENCH_COLUMNS;
use crate::demonstration::{DemonstrationError, read_trajectory};
use crate::recording::step_columns;
use crate::report::{Checked, FileCode, InputFault, Outcome, RunReport};
use crate::scenario::{Diagnostic, LoadOptions, Scenario, Work};
use crate::simulation::{ArmMotion, Experiment, MotionOutcome, Progress, Setup, SimulationError, check_columns, check_motion};

/// Judges the movement in the file `samples` in the scene of `scene`.
pub(super) fn judged_trajectory(samples: &Path, scene: &Path, options: &LoadOptions, clock: &Clock, terminal: &Terminal) -> Checked {
    judged(samples, "trajectory", scene, options, clock, terminal, |scenario| match &scenario.work {
        Work::Arm(experiment) => movement(experiment, scenario, &scenario.criteria, samples, clock),
        Work::Planar(_) => Err(vec![InputFault::of_file(
            scene,
            FileCode::Planar,
            "it has no arm: a movement can only be judged in the scene of an arm".to_owned(),
        )]),
    })
}

/// What `report` finds in the scene of `scene`, or the faults that keep it from finding anything; `path` is what the user named.
pub(super) fn judged(
    path: &Path,
    kind: &'static str,
    scene: &Path,
    options: &LoadOptions,
    clock: &Clock,
    terminal: &Terminal,
    report: impl FnOnce(&Scenario) -> Result<(RunReport, Vec<Diagnostic>), Vec<InputFault>>,
) -> Checked {
    let name = path.display().to_string();
    let scenario = match Scenario::load(scene, options) {
        Ok(scenario) => scenario,
        Err(invalid) => {
            terminal.faults(&invalid.0);
            return Checked::refused(name, kind, faults(&invalid.0), clock.elapsed_s());
        }
    };
    match report(&scenario) {
        Ok((mut report, odd)) => {
            report.warnings.extend(odd.iter().map(ToString::to_string));
            report.warnings.iter().for_each(|warning| terminal.note(&format!("{name}: warning: {warning}\n")));
            report.locate(|key| scenario.places.get(key));
            if options.deny_warnings {
                report.deny_warnings();
            }
            Checked::judged(name, kind, report, [faults(&scenario.warnings), faults(&odd)].concat(), clock.elapsed_s())
        }
        Err(faults) => Checked::refused(name, kind, faults, clock.elapsed_s()),
    }
}

/// The report of the movement in the file `samples`, by `criteria` and what every movement is asked; and what is odd about the robot's file.
pub(super) fn movement(
    experiment: &Experiment,
    scenario: &Scenario,
    criteria: &[CriterionSpec],
    samples: &Path,
    clock: &Clock,
) -> Result<(RunReport, Vec<Diagnostic>), Vec<InputFault>> {
    match moved(experiment, samples, clock) {
        Ok(mut outcome) => {
            allow(&mut outcome.collisions, &scenario.allowed_contacts);
            let report = RunReport::of_motion(experiment, &outcome, &judge_motion(&outcome, experiment, criteria));
            Ok((report, Located::default().with(&outcome.robot_warnings).faults))
        }
        Err(SimulationError::Demonstrations(error)) => Err(of_data(samples, &error)),
        Err(error) if is_of_the_scene(&error) => {
            let scene = scenario.files.first().map_or(samples, PathBuf::as_path);
            Err(Located::of(&error, scenario).for_report(scene))
        }
        Err(error) if outcome_of(&error) == Outcome::InvalidInput => {
            Err(vec![InputFault::of_file(samples, FileCode::Trajectory, error.to_string())])
        }
        Err(error) => {
            let report = RunReport::failed(&experiment.name, experiment.seed, outcome_of(&error), &error.to_string());
            Ok((report, Vec::new()))
        }
    }
}

/// Whether the robot or the scene cannot be used, whatever moves in it.
fn is_of_the_scene(error: &SimulationError) -> bool {
    use SimulationError::{Arm, Scene, Urdf, World};
    let of_scene = |error: &SimulationError| matches!(error, Urdf(_) | Arm(_) | World(_) | Scene(_));
    outcome_of(error) == Outcome::InvalidInput && error.parts().iter().all(|(_, part)| of_scene(part))
}

fn moved(experiment: &Experiment, samples: &Path, clock: &Clock) -> Result<MotionOutcome, SimulationError> {
    let setup = Setup::new(experiment)?;
    let trajectory = read_trajectory(samples)?;
    // What a step log and a taught demonstration hold besides.
    let log = step_columns(setup.arm_joints().len(), &[]).into_iter().map(|column| column.name);
    let passed_over: Vec<String> = log.chain(WRENCH_COLUMNS.map(str::to_owned)).collect();
    let mut odd = check_columns(&setup, &trajectory, &passed_over)?;
    let mut outcome = check_motion(&setup, &ArmMotion::new(&setup, &trajectory, clock)?, clock)?;
    outcome.warnings.append(&mut odd);
    Ok(outcome)
}

/// Every fault of the samples with its line.
fn of_data(samples: &Path, error: &DemonstrationError) -> Vec<InputFault> {
    let mut told: Vec<InputFault> =
        error.faults().iter().map(|fault| InputFault::of_file(samples, FileCode::Trajectory, fault.to_string())).collect();
    for (told, fault) in told.iter_mut().zip(error.faults()) {
        told.line = fault.row;
        told.column = fault.row.map(|_| 1);
    }
    if told.is_empty() { vec![InputFault::of_file(samples, FileCode::Unreadable, error.to_string())] } else { told }
}
