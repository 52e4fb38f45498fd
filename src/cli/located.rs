//! Faults that only the robot and the scene show, at the places from which they come: in the scenario, or in the robot's file.

use std::path::Path;

use super::check::faults;
use crate::report::{FileCode, InputFault};
use crate::robot::{self, Finding};
use crate::scenario::{Code, Diagnostic, Scenario, Severity};
use crate::simulation::SimulationError;

/// What is wrong with the input.
#[derive(Debug, Default)]
pub(super) struct Located {
    /// What has a place.
    pub faults: Vec<Diagnostic>,
    /// What has none, one sentence each.
    pub elsewhere: Vec<String>,
}

impl Located {
    /// Everything that `error` tells of `scenario`.
    pub fn of(error: &SimulationError, scenario: &Scenario) -> Self {
        let parts = error.parts();
        let of_robot =
            parts.iter().filter_map(|(_, part)| if let SimulationError::Urdf(found) = part { Some(&found.findings) } else { None });
        let of_robot: Vec<Diagnostic> = of_robot.flatten().map(of_finding).collect();
        let others = parts.iter().filter(|(_, part)| !matches!(part, SimulationError::Urdf(_)));
        let (mut faults, elsewhere) = scenario.places.diagnose(others.map(|(key, part)| (*key, part.to_string())));
        faults.extend(of_robot);
        Self { faults, elsewhere }
    }

    /// The same, and what is odd about the robot's file.
    pub fn with(mut self, warnings: &[Finding]) -> Self {
        self.faults.extend(warnings.iter().map(of_finding));
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

/// The finding with the line of the robot's file, as far as it can still be read.
fn of_finding(found: &Finding) -> Diagnostic {
    let severity = if found.severity == robot::Severity::Error { Severity::Error } else { Severity::Warning };
    let text = found.line.and_then(|_| std::fs::read_to_string(&found.file).ok()).unwrap_or_default();
    let message = format!("{}: {}", found.element, found.message);
    let help = (!found.help.is_empty()).then(|| found.help.clone());
    Diagnostic::at_line(Code::Robot, severity, &found.file, (found.line.map(|line| line as usize), &text), message, help)
}
