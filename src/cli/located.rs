//! Faults that only the robot and the scene show, at the places from which they come: in the scenario, in the robot's file, or in the data.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::check::faults;
use crate::demonstration::DemonstrationError;
use crate::report::{FileCode, InputFault};
use crate::robot::{self, Finding};
use crate::scenario::{Code, Diagnostic, Scenario, Severity, Work, diagnose_some};
use crate::simulation::{DemonstrationSource, SimulationError};

/// What is wrong with the input.
#[derive(Debug, Default)]
pub(super) struct Located {
    /// What stands in the scenario or the robot's file.
    pub faults: Vec<Diagnostic>,
    /// What has no place there.
    pub elsewhere: Vec<Elsewhere>,
}

/// Something wrong that neither the scenario nor the robot's file shows.
#[derive(Debug)]
pub(super) struct Elsewhere {
    /// In words.
    pub told: String,
    /// The same of recorded data, fault by fault.
    data: Vec<InputFault>,
}

impl Located {
    /// Everything that `error` tells of `scenario`.
    pub fn of(error: &SimulationError, scenario: &Scenario) -> Self {
        let parts = error.parts();
        let of_robot = parts.iter().filter_map(|(_, part)| if let SimulationError::Urdf(found) = part { Some(found) } else { None });
        let of_robot: Vec<Finding> = of_robot.flat_map(|found| found.findings.iter().cloned()).collect();
        let of_data = parts.iter().filter_map(|(_, part)| {
            let (SimulationError::Demonstrations(error), Work::Arm(experiment)) = (part, &scenario.work) else { return None };
            let DemonstrationSource::Dataset(folder) = &experiment.demonstrations else { return None };
            Some(Elsewhere { told: error.to_string(), data: of_data(folder, error) })
        });
        let of_data: Vec<Elsewhere> = of_data.collect();
        let is_file = |part: &SimulationError| match part {
            SimulationError::Urdf(_) => true,
            SimulationError::Demonstrations(_) => !of_data.is_empty(),
            _ => false,
        };
        let others = parts.iter().filter(|(_, part)| !is_file(part));
        let (faults, unplaced) = scenario.places.diagnose(others.map(|(key, part)| (*key, part.to_string())));
        let unplaced = unplaced.into_iter().map(Elsewhere::new);
        Self { faults, elsewhere: unplaced.chain(of_data).collect() }.with(&of_robot)
    }

    /// The same, and what is odd about the robot's file.
    pub fn with(mut self, findings: &[Finding]) -> Self {
        let mut texts: BTreeMap<String, Arc<str>> = BTreeMap::new();
        let of_finding = |found: &Finding| {
            let severity = if found.severity == robot::Severity::Error { Severity::Error } else { Severity::Warning };
            // What stood there, as far as it can still be read.
            let text = texts.entry(found.file.clone()).or_insert_with(|| std::fs::read_to_string(&found.file).unwrap_or_default().into());
            let message = format!("{}: {}", found.element, found.message);
            let help = (!found.help.is_empty()).then(|| found.help.clone());
            Diagnostic::at_line(Code::Robot, severity, &found.file, (found.line.map(|line| line as usize), text), message, help)
        };
        self.faults.extend(diagnose_some(findings, of_finding));
        self
    }

    /// Whether nothing is known to be wrong.
    pub fn is_empty(&self) -> bool {
        self.faults.is_empty() && self.elsewhere.is_empty()
    }

    /// All of it for a report; what has no place is the whole `file`'s.
    pub fn for_report(self, file: &Path) -> Vec<InputFault> {
        let elsewhere = self.elsewhere.into_iter().flat_map(|one| match one.data.is_empty() {
            true => vec![InputFault::of_file(file, FileCode::Scene, one.told)],
            false => one.data,
        });
        faults(&self.faults).into_iter().chain(elsewhere).collect()
    }

    /// All of it, one line each.
    pub fn text(&self) -> String {
        let elsewhere = self.elsewhere.iter().map(|one| one.told.clone());
        self.faults.iter().map(ToString::to_string).chain(elsewhere).collect::<Vec<_>>().join("\n")
    }
}

impl Elsewhere {
    /// Something that belongs to no file.
    pub fn new(told: String) -> Self {
        Self { told, data: Vec::new() }
    }
}

/// Every fault of the recorded demonstrations in `folder`, in the file in which it stands.
fn of_data(folder: &Path, error: &DemonstrationError) -> Vec<InputFault> {
    let file =
        |place: &str| Some(folder.join(place)).filter(|path| !place.is_empty() && path.is_file()).unwrap_or_else(|| folder.to_path_buf());
    let told = |fault: &crate::demonstration::Fault| {
        let path: PathBuf = file(&fault.place);
        let found = InputFault::of_file(&path, FileCode::Dataset, fault.to_string());
        InputFault { line: fault.row, column: fault.row.map(|_| 1), ..found }
    };
    match error.faults() {
        [] => vec![InputFault::of_file(folder, FileCode::Dataset, error.to_string())],
        faults => faults.iter().map(told).collect(),
    }
}
