//! A command that cannot do what it was asked: told to people on stderr, to programs on stdout.

use std::path::Path;

use serde::Serialize;

use super::args::Format;
use super::terminal::Terminal;
use crate::demonstration::{DemonstrationError, Fault};
use crate::learning::LearningError;
use crate::report::{Outcome, OutputError};
use crate::scenario::{Diagnostic, InvalidScenario};

/// Why, and how the command ends.
pub(super) struct Failure {
    pub outcome: Outcome,
    /// Everything that is wrong.
    errors: Vec<String>,
    /// The same with its place, where the data have one.
    faults: Vec<PlacedFault>,
    /// Faults of settings, which have snippets.
    diagnostics: Vec<Diagnostic>,
}

/// Something wrong with data.
#[derive(Serialize)]
struct PlacedFault {
    place: String,
    row: Option<usize>,
    column: Option<String>,
    found: String,
    expected: String,
}

/// What programs read.
#[derive(Serialize)]
struct Told<'a> {
    schema_version: u32,
    outcome: Outcome,
    exit_code: u8,
    error: String,
    errors: &'a [String],
    faults: &'a [PlacedFault],
    diagnostics: &'a [Diagnostic],
}

impl Failure {
    /// Something that no other room can say better.
    pub fn new(outcome: Outcome, errors: impl IntoIterator<Item = String>) -> Self {
        Self { outcome, errors: errors.into_iter().collect(), faults: Vec::new(), diagnostics: Vec::new() }
    }

    /// Of learning from, reading or asking something of the file or dataset at `path`.
    pub fn of_learning(path: &Path, error: &LearningError) -> Self {
        match error {
            LearningError::Demonstration(error) => Self::of_data(path, error),
            LearningError::Settings(faults) => Self::new(Outcome::InvalidInput, faults.iter().map(ToString::to_string)),
            LearningError::Skill(message) => Self::new(Outcome::InvalidInput, [format!("{}: {message}", path.display())]),
            // The file is in the message.
            LearningError::Io { .. } => Self::new(Outcome::InvalidInput, [error.to_string()]),
            LearningError::Model(message) => Self::new(Outcome::InvalidInput, [format!("{}: {message}", path.display())]),
            LearningError::Request(message) => Self::new(Outcome::Usage, [message.clone()]),
            LearningError::Stopped { .. } => Self::new(Outcome::TimeLimit, [error.to_string()]),
            LearningError::Data(_) | LearningError::Math(_) => Self::new(Outcome::LearningFailed, [error.to_string()]),
        }
    }

    /// Of the dataset at `path`.
    pub fn of_data(path: &Path, error: &DemonstrationError) -> Self {
        let faults: Vec<PlacedFault> = error.faults().iter().map(placed).collect();
        let count = if faults.len() == 1 { "1 fault".to_owned() } else { format!("{} faults", faults.len()) };
        let message = match error {
            DemonstrationError::Io { .. } => error.to_string(),
            DemonstrationError::Invalid(_) => format!("{} cannot be used, {count}:\n{error}", path.display()),
        };
        Self { faults, ..Self::new(Outcome::InvalidInput, [message]) }
    }

    /// The same with faults of settings.
    pub fn because(self, diagnostics: Vec<Diagnostic>) -> Self {
        Self { diagnostics, ..self }
    }

    /// Tells it, and returns how the command ends.
    pub fn tell(&self, terminal: &Terminal) -> Outcome {
        if terminal.format == Format::Json {
            terminal.json(&Told {
                schema_version: 1,
                outcome: self.outcome,
                exit_code: self.outcome.exit_code(),
                error: self.errors.join("\n"),
                errors: &self.errors,
                faults: &self.faults,
                diagnostics: &self.diagnostics,
            });
        } else {
            terminal.faults(&self.diagnostics);
            self.errors.iter().for_each(|error| terminal.error(&format!("error: {error}\n")));
        }
        self.outcome
    }
}

impl From<InvalidScenario> for Failure {
    fn from(invalid: InvalidScenario) -> Self {
        Self { diagnostics: invalid.0, ..Self::new(Outcome::InvalidInput, []) }
    }
}

impl From<OutputError> for Failure {
    fn from(error: OutputError) -> Self {
        Self::new(error.outcome(), [error.to_string()])
    }
}

fn placed(fault: &Fault) -> PlacedFault {
    PlacedFault {
        place: fault.place.clone(),
        row: fault.row,
        column: fault.column.clone(),
        found: fault.found.clone(),
        expected: fault.expected.clone(),
    }
}
