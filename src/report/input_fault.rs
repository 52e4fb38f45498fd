//! Something wrong or odd about a file that a command was given.

use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;

/// Something wrong or odd about a file.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct InputFault {
    /// Its code: `cpdmp explain` says what it means.
    pub code: String,
    /// Whether the file can be used all the same.
    pub warning: bool,
    /// The file.
    pub file: String,
    /// Line, from 1, when it is at a place.
    pub line: Option<usize>,
    /// Column, from 1.
    pub column: Option<usize>,
    /// What is wrong, what was expected, and how to mend it.
    pub message: String,
}

/// What can be wrong with a stored run or a movement, besides the faults that scenarios have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileCode {
    /// It cannot be opened or read.
    Unreadable,
    /// It is not as the run wrote it.
    Edited,
    /// The movement in it cannot be judged.
    Trajectory,
    /// The robot or the scene in which it is to be judged cannot be used.
    Scene,
    /// The scene has no arm that could make the movement.
    Planar,
}

impl FileCode {
    /// Every code.
    pub const ALL: [Self; 5] = [Self::Unreadable, Self::Edited, Self::Trajectory, Self::Scene, Self::Planar];

    /// Its name and its meaning in one sentence.
    #[must_use]
    pub fn describe(self) -> (&'static str, &'static str) {
        match self {
            Self::Unreadable => ("unreadable", "a file that is needed cannot be opened or read"),
            Self::Edited => ("edited", "a file in the folder of a run is not as the run wrote it: it would be judged as what it is not"),
            Self::Trajectory => ("trajectory", "a movement cannot be judged: its columns, times or values, or it does not fit the robot"),
            Self::Scene => {
                ("scene", "what the scenario asks for is not possible with its robot or in its scene: a pose, a way, a place, a name")
            }
            Self::Planar => ("planar", "a movement of an arm is to be judged in the scene of an experiment in the plane, which has no arm"),
        }
    }
}

impl InputFault {
    /// A fault of a file as a whole.
    #[must_use]
    pub fn of_file(file: &Path, code: FileCode, message: String) -> Self {
        let (code, file) = (code.describe().0.to_owned(), file.display().to_string());
        Self { code, warning: false, file, line: None, column: None, message }
    }

    /// `file:line:column: error[code]: message`.
    pub(super) fn line(&self) -> String {
        let place = match (self.line, self.column) {
            (Some(line), Some(column)) => format!("{}:{line}:{column}", self.file),
            _ => self.file.clone(),
        };
        let kind = if self.warning { "warning" } else { "error" };
        format!("{place}: {kind}[{}]: {}", self.code, self.message)
    }
}
