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
    /// What has a place: in the scenario, the robot's file, or a file of demonstrations.
    pub faults: Vec<Diagnostic>,
    /// What has none, one sentence each.
    pub elsewhere: Vec<String>,
}

impl Located {
    /// Everything that `error` tells of `scenario`.
    pub fn of(error: &SimulationError, scenario: &Scenario) -> Self {
        let parts = error.parts();
        let of_robot = parts.iter().filter_map(|(_, part)| if let SimulationError::Urdf(found) = part { Some(found) } else { None });
        let of_robot: Vec<Finding> = of_robot.flat_map(|found| found.findings.iter().cloned()).collect();
        let folder = match &scenario.work {
            Work::Arm(experiment) => match &experiment.demonstrations {
                DemonstrationSource::Dataset(folder) => Some(folder),
                DemonstrationSource::Teach(_) => None,
            },
            Work::Planar(_) => None,
        };
        let (mut of_data, mut others) = (Vec::new(), Vec::new());
        for (key, part) in parts {
            match (part, folder) {
                (SimulationError::Urdf(_), _) => {}
                (SimulationError::Demonstrations(error), Some(folder)) => of_data.extend(in_data(folder, error)),
                _ => others.push((key, part.to_string())),
            }
        }
        let (mut faults, elsewhere) = scenario.places.diagnose(others);
        faults.extend(of_data);
        Self { faults, elsewhere }.with(&of_robot)
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
        let elsewhere = self.elsewhere.into_iter().map(|told| InputFault::of_file(file, FileCode::Scene, told));
        faults(&self.faults).into_iter().chain(elsewhere).collect()
    }

    /// All of it, one line each.
    pub fn text(&self) -> String {
        self.faults.iter().map(ToString::to_string).chain(self.elsewhere.iter().cloned()).collect::<Vec<_>>().join("\n")
    }
}

/// Every fault of the recorded demonstrations in `folder`, in the file and line in which it stands.
fn in_data(folder: &Path, error: &DemonstrationError) -> Vec<Diagnostic> {
    let mut texts: BTreeMap<PathBuf, Arc<str>> = BTreeMap::new();
    let mut told = |place: &str, line: Option<usize>, message: String| {
        let within = Some(folder.join(place)).filter(|path| !place.is_empty() && path.is_file());
        let path = within.unwrap_or_else(|| folder.to_path_buf());
        let text = texts.entry(path.clone()).or_insert_with(|| std::fs::read_to_string(&path).unwrap_or_default().into());
        Diagnostic::at_line(Code::Dataset, Severity::Error, &path.display().to_string(), (line, text), message, None)
    };
    match error.faults() {
        [] => vec![told("", None, error.to_string())],
        faults => diagnose_some(faults, |fault| told(&fault.place, fault.row, fault.to_string())),
    }
}
