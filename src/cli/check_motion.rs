//! `cpdmp check` of a movement that is not simulated: a stored run, or a file of samples in the scene of a scenario.

use std::path::Path;

use super::check::faults;
use super::judged_run::outcome_of;
use super::progress::Clock;
use super::terminal::Terminal;
use crate::check::{allow, judge_motion};
use crate::demonstration::{DemonstrationError, read_trajectory};
use crate::report::{Checked, InputFault, Outcome, RunReport};
use crate::scenario::{LoadOptions, Scenario, Work};
use crate::simulation::{ArmMotion, Experiment, Progress, Setup, SimulationError, check_motion};

/// Judges the movement in `samples` in the scene of `scene`; `path` is what the user named.
pub(super) fn judged(path: &Path, kind: &'static str, samples: &Path, scene: &Path, options: &LoadOptions, terminal: &Terminal) -> Checked {
    let clock = Clock::start();
    let name = path.display().to_string();
    let scenario = match Scenario::load(scene, options) {
        Ok(scenario) => scenario,
        Err(invalid) => {
            terminal.faults(&invalid.0);
            return Checked::refused(name, kind, faults(&invalid.0), clock.elapsed_s());
        }
    };
    let Work::Arm(experiment) = &scenario.work else {
        let fault = whole_file(scene, "planar", "it has no arm: a movement can only be judged in the scene of an arm".to_owned());
        return Checked::refused(name, kind, vec![fault], clock.elapsed_s());
    };
    match report(experiment, &scenario, samples) {
        Ok(mut report) => {
            report.locate(|key| scenario.places.get(key).cloned());
            Checked::judged(name, kind, report, faults(&scenario.warnings), clock.elapsed_s())
        }
        Err(SimulationError::Demonstrations(error)) => Checked::refused(name, kind, of_data(samples, &error), clock.elapsed_s()),
        Err(error) if outcome_of(&error) == Outcome::InvalidInput => {
            Checked::refused(name, kind, vec![whole_file(samples, "trajectory", error.to_string())], clock.elapsed_s())
        }
        Err(error) => {
            let report = RunReport::failed(&experiment.name, experiment.seed, outcome_of(&error), &error.to_string());
            Checked::judged(name, kind, report, Vec::new(), clock.elapsed_s())
        }
    }
}

fn report(experiment: &Experiment, scenario: &Scenario, samples: &Path) -> Result<RunReport, SimulationError> {
    let setup = Setup::new(experiment)?;
    let motion = ArmMotion::new(&setup, &read_trajectory(samples)?)?;
    let mut outcome = check_motion(&setup, &motion)?;
    allow(&mut outcome.collisions, &scenario.allowed_contacts);
    Ok(RunReport::of_motion(experiment, &outcome, &judge_motion(&outcome, &scenario.criteria)))
}

/// Every fault of the samples with its line.
fn of_data(samples: &Path, error: &DemonstrationError) -> Vec<InputFault> {
    let mut told: Vec<InputFault> = error.faults().iter().map(|fault| whole_file(samples, "trajectory", fault.to_string())).collect();
    for (told, fault) in told.iter_mut().zip(error.faults()) {
        told.line = fault.row;
        told.column = fault.row.map(|_| 1);
    }
    if told.is_empty() { vec![whole_file(samples, "unreadable", error.to_string())] } else { told }
}

fn whole_file(file: &Path, code: &str, message: String) -> InputFault {
    InputFault { code: code.to_owned(), warning: false, file: file.display().to_string(), line: None, column: None, message }
}
