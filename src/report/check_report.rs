//! What `cpdmp check` found: one report for all scenarios, from which every format is written.

use schemars::JsonSchema;
use serde::Serialize;

use super::{CollisionReport, CriterionReport, InputFault, Outcome, RunReport};
use crate::world::RESOLUTION_M;

/// The version of this format.
const SCHEMA_VERSION: u32 = 1;

/// Everything that one call of `check` has to say. Keys are only ever added.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CheckReport {
    /// Version of this format.
    pub schema_version: u32,
    /// Version of the program.
    pub version: &'static str,
    /// The worst outcome of all checks.
    pub outcome: Outcome,
    /// The exit code that belongs to it.
    pub exit_code: u8,
    /// Wall time of all checks together (s).
    pub wall_s: f64,
    /// Nothing that is thicker passes unseen between two moments that are looked at, and no distance below 5 cm is told too large by more (m).
    pub resolution_m: f64,
    /// Every check, in the order of the arguments.
    pub checks: Vec<Checked>,
}

/// One scenario, stored run or trajectory that was checked.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Checked {
    /// What was checked, as the user named it.
    pub path: String,
    /// What it is: `scenario` (simulated), `run` (a stored one) or `trajectory`.
    pub kind: &'static str,
    /// How it ended.
    pub outcome: Outcome,
    /// The exit code that belongs to it.
    pub exit_code: u8,
    /// Wall time (s); checks that ran at the same time shared the machine.
    pub wall_s: f64,
    /// What is wrong or odd about the input.
    pub faults: Vec<InputFault>,
    /// The run; `null` when the input cannot be used.
    pub report: Option<RunReport>,
}

impl CheckReport {
    /// From all checks, which took `wall_s` (s) together.
    #[must_use]
    pub fn of(checks: Vec<Checked>, wall_s: f64) -> Self {
        let outcome = checks.iter().map(|check| check.outcome).max().unwrap_or(Outcome::NothingSelected);
        Self {
            schema_version: SCHEMA_VERSION,
            version: env!("CARGO_PKG_VERSION"),
            outcome,
            exit_code: outcome.exit_code(),
            wall_s,
            resolution_m: RESOLUTION_M,
            checks,
        }
    }
}

impl Checked {
    /// What was run, or judged without running, with its report.
    #[must_use]
    pub fn judged(path: String, kind: &'static str, report: RunReport, faults: Vec<InputFault>, wall_s: f64) -> Self {
        let (outcome, exit_code) = (report.outcome, report.exit_code);
        Self { path, kind, outcome, exit_code, wall_s, faults, report: Some(report) }
    }

    /// Input that cannot be used.
    #[must_use]
    pub fn refused(path: String, kind: &'static str, faults: Vec<InputFault>, wall_s: f64) -> Self {
        let outcome = Outcome::InvalidInput;
        Self { path, kind, outcome, exit_code: outcome.exit_code(), wall_s, faults, report: None }
    }

    /// Its criteria; none when there was no run.
    pub(super) fn criteria(&self) -> impl Iterator<Item = &CriterionReport> {
        self.report.iter().flat_map(|report| &report.criteria)
    }

    /// Its contacts that the scene does not allow.
    pub(super) fn refused_contacts(&self) -> impl Iterator<Item = &CollisionReport> {
        self.report.iter().flat_map(|report| &report.collisions).filter(|contact| !contact.allowed)
    }

    /// What is odd about the input and the run.
    pub(super) fn warnings(&self) -> Vec<String> {
        let of_input = self.faults.iter().filter(|fault| fault.warning).map(InputFault::line);
        let of_run = self.run_warnings().map(|warning| format!("{}: warning: {warning}", self.path));
        of_input.chain(of_run).collect()
    }

    /// What is odd about the run besides what is odd about its input.
    pub(super) fn run_warnings(&self) -> impl Iterator<Item = &str> {
        let of_input: Vec<String> = self.faults.iter().map(InputFault::line).collect();
        let all = self.report.iter().flat_map(|report| report.warnings());
        all.filter(move |warning| of_input.iter().all(|told| told != warning))
    }

    /// Why there are no answers, when there are none.
    pub(super) fn error(&self) -> Option<String> {
        match &self.report {
            Some(report) => report.error.clone(),
            None => {
                let errors = self.faults.iter().filter(|fault| !fault.warning);
                Some(errors.map(InputFault::line).collect::<Vec<_>>().join("\n"))
            }
        }
    }
}
