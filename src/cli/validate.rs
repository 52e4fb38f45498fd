//! `cpdmp validate`: everything that can be said about a scenario without simulating it.

use std::path::{Path, PathBuf};

use serde::Serialize;

use super::args::{Format, Global};
use super::judged_run::{of_learning, outcome_of};
use super::load::options;
use super::located::Located;
use super::select::select;
use super::terminal::Terminal;
use crate::learning::LearningError;
use crate::report::Outcome;
use crate::scenario::{Diagnostic, Scenario, Severity, Work};
use crate::simulation::{Setup, Silent, SimulationError};

/// What is known about one scenario.
#[derive(Serialize)]
struct Checked<'a> {
    path: &'a Path,
    outcome: Outcome,
    exit_code: u8,
    scenario: Option<String>,
    /// Faults and warnings of the scenario file and of the robot's.
    diagnostics: Vec<Diagnostic>,
    /// Why the robot or the dataset cannot be used, where no place in a file can be told.
    error: Option<String>,
    /// What a recorded dataset does not show.
    warnings: Vec<String>,
}

impl Checked<'_> {
    /// What is odd about the robot's file or the dataset makes it one that cannot be used.
    fn deny_warnings(&mut self) {
        let odd = self.diagnostics.iter_mut().filter(|found| found.severity == Severity::Warning);
        let mut denied = !self.warnings.is_empty();
        for found in odd {
            found.severity = Severity::Error;
            denied = true;
        }
        if self.outcome == Outcome::Passed && denied {
            self.outcome = Outcome::InvalidInput;
            self.exit_code = self.outcome.exit_code();
            let of_data = std::mem::take(&mut self.warnings);
            self.error = (!of_data.is_empty()).then(|| format!("--deny-warnings: {}", of_data.join("\n")));
        }
    }
}

/// Checks every scenario, its robot and its dataset.
pub(super) fn validate(paths: &[PathBuf], global: &Global, terminal: &Terminal) -> Outcome {
    let files = match select(paths, terminal) {
        Ok(files) => files,
        Err(outcome) => return outcome,
    };
    let options = options(global);
    let check = |path: &PathBuf| {
        let mut checked = checked(path, Scenario::load_with_sweep(path, &options).map_err(|invalid| invalid.0));
        if global.deny_warnings {
            checked.deny_warnings();
        }
        tell(&checked, terminal);
        checked.outcome
    };
    files.iter().map(check).max().unwrap_or(Outcome::NothingSelected)
}

fn checked(path: &Path, loaded: Result<Scenario, Vec<Diagnostic>>) -> Checked<'_> {
    let failed = Outcome::InvalidInput;
    let mut checked = Checked {
        path,
        outcome: failed,
        exit_code: failed.exit_code(),
        scenario: None,
        diagnostics: Vec::new(),
        error: None,
        warnings: Vec::new(),
    };
    match loaded {
        Err(diagnostics) => checked.diagnostics = diagnostics,
        Ok(scenario) => {
            let found = beyond_the_file(&scenario);
            checked.outcome = found.as_ref().map_or_else(|(outcome, _)| *outcome, |_| Outcome::Passed);
            checked.exit_code = checked.outcome.exit_code();
            checked.scenario = Some(scenario.work.name().to_owned());
            checked.diagnostics = scenario.warnings;
            match found {
                Ok(Odd { robot, dataset }) => {
                    checked.diagnostics.extend(robot);
                    checked.warnings = dataset;
                }
                Err((_, Located { faults, elsewhere })) => {
                    checked.diagnostics.splice(0..0, faults);
                    checked.error = (!elsewhere.is_empty()).then(|| elsewhere.join("\n"));
                }
            }
        }
    }
    checked
}

/// What is odd about a scenario that can be used.
pub(super) struct Odd {
    /// In the robot's file.
    pub robot: Vec<Diagnostic>,
    /// What a recorded dataset does not show.
    pub dataset: Vec<String>,
}

impl Odd {
    /// All of it, one line each.
    pub fn lines(&self) -> Vec<String> {
        self.robot.iter().map(ToString::to_string).chain(self.dataset.iter().cloned()).collect()
    }
}

/// Loads the robot and the dataset that the scenario names and looks whether the arm can go its way.
pub(super) fn beyond_the_file(scenario: &Scenario) -> Result<Odd, (Outcome, Located)> {
    match &scenario.work {
        Work::Planar(planar) => {
            let elsewhere = |error: &LearningError| Located { faults: Vec::new(), elsewhere: vec![error.to_string()] };
            let odd = Odd { robot: Vec::new(), dataset: Vec::new() };
            planar.check().map(|()| odd).map_err(|error| (of_learning(&error), elsewhere(&error)))
        }
        Work::Arm(experiment) => {
            let located = |error: &SimulationError| (outcome_of(error), Located::of(error, scenario));
            let setup = Setup::unchecked(experiment).map_err(|error| located(&error))?;
            match setup.preflight(&Silent) {
                Ok(dataset) => Ok(Odd { robot: Located::default().with(&setup.warnings).faults, dataset }),
                Err(error) => {
                    let (outcome, located) = located(&error);
                    Err((outcome, located.with(&setup.warnings)))
                }
            }
        }
    }
}

fn tell(checked: &Checked<'_>, terminal: &Terminal) {
    if terminal.format == Format::Json {
        return terminal.json(checked);
    }
    terminal.faults(&checked.diagnostics);
    if let Some(error) = &checked.error {
        terminal.error(&format!("error: {error}\n"));
    }
    checked.warnings.iter().for_each(|warning| terminal.note(&format!("{warning}\n")));
    let placed = checked.diagnostics.iter().filter(|found| found.severity == Severity::Error).count();
    let faults = placed + checked.error.as_ref().map_or(0, |error| error.lines().count());
    let verdict = match (checked.outcome, faults) {
        (Outcome::Passed, _) => "ok".to_owned(),
        (_, 1) => "1 fault".to_owned(),
        (_, count) => format!("{count} faults"),
    };
    terminal.result(&format!("{}: {verdict}\n", checked.path.display()));
}
