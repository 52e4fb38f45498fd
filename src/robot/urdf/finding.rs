//! What is wrong, or odd, in a robot description, and where.

use std::fmt;

/// How bad a finding is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The robot can be used; something in the file is not, or looks like a slip.
    Warning,
    /// The robot cannot be used.
    Error,
}

/// One thing found in a robot description.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// How bad it is.
    pub severity: Severity,
    /// Name of the file, as given.
    pub file: String,
    /// Line in the file, from 1; nothing when the finding has no place.
    pub line: Option<u32>,
    /// What it is about, e.g. "link `left_hand`".
    pub element: String,
    /// What is wrong, in one sentence without a full stop.
    pub message: String,
    /// What to do about it; empty when the message says it all.
    pub help: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let severity = match self.severity {
            Severity::Warning => "warning",
            Severity::Error => "error",
        };
        write!(f, "{}:", self.file)?;
        if let Some(line) = self.line {
            write!(f, "{line}:")?;
        }
        write!(f, " {severity}: {}: {}", self.element, self.message)?;
        if !self.help.is_empty() {
            write!(f, " (help: {})", self.help)?;
        }
        Ok(())
    }
}

/// A robot description that cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}", listed(.findings))]
pub struct UrdfError {
    /// Everything found, warnings too, in the order of the checks.
    pub findings: Vec<Finding>,
}

fn listed(findings: &[Finding]) -> String {
    let lines: Vec<String> = findings.iter().map(Finding::to_string).collect();
    lines.join("\n")
}

/// Collects findings.
#[derive(Debug, Default)]
pub(super) struct Findings {
    pub all: Vec<Finding>,
}

/// Where something stands: file and line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Place {
    pub file: String,
    pub line: Option<u32>,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "{}:{line}", self.file),
            None => f.write_str(&self.file),
        }
    }
}

impl Findings {
    pub(super) fn error(&mut self, place: &Place, element: impl Into<String>, message: impl Into<String>, help: &str) {
        self.push(Severity::Error, place, element.into(), message.into(), help);
    }

    pub(super) fn warning(&mut self, place: &Place, element: impl Into<String>, message: impl Into<String>, help: &str) {
        self.push(Severity::Warning, place, element.into(), message.into(), help);
    }

    pub(super) fn has_error(&self) -> bool {
        self.all.iter().any(|finding| finding.severity == Severity::Error)
    }

    fn push(&mut self, severity: Severity, place: &Place, element: String, message: String, help: &str) {
        self.all.push(Finding { severity, file: place.file.clone(), line: place.line, element, message, help: help.to_owned() });
    }
}
