//! What is wrong with a scenario, before it is turned into a [`Diagnostic`](super::Diagnostic) for the reader.

use std::path::{Path, PathBuf};

use serde::Serialize;

use super::source::Origin;

/// Faults beyond this number are only counted: nobody reads them, and a hostile file must not cost minutes.
pub(super) const ENOUGH: usize = 100;

/// What kind of fault it is. The names are part of the machine-readable output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Code {
    /// The file cannot be opened or read.
    Unreadable,
    /// The file is no text, or too large.
    Encoding,
    /// The text is no TOML.
    Syntax,
    /// The file was written for another version of the program.
    Version,
    /// A chain of `extends` has no end, or one of its files is missing.
    Extends,
    /// A file lies outside the folders that a scenario may use.
    OutsideRoot,
    /// A `--set` that cannot be applied.
    Override,
    /// A key that means nothing here.
    UnknownKey,
    /// A key that is needed.
    MissingKey,
    /// Text where a number belongs, and the like.
    WrongType,
    /// A number that is not finite, or too small or large to make sense.
    OutOfRange,
    /// A list of the wrong length.
    WrongLength,
    /// A name that nothing bears.
    UnknownName,
    /// A name that two things bear.
    DuplicateName,
    /// Times that do not rise.
    Order,
    /// Settings that contradict each other.
    Conflict,
    /// More faults than are shown.
    More,
    /// A parameter of which the demonstrations say nothing, or nothing that far away.
    Untaught,
    /// What the robot cannot do or the scene cannot be.
    Scene,
    /// A description of a robot that cannot be used.
    Robot,
    /// No criterion can fail.
    NothingAsked,
    /// Recorded demonstrations that cannot be used.
    Dataset,
}

impl Code {
    /// Every code, in the order in which `cpdmp explain` lists them.
    pub const ALL: [Self; 22] = [
        Self::Unreadable,
        Self::Encoding,
        Self::Syntax,
        Self::Version,
        Self::Extends,
        Self::OutsideRoot,
        Self::Override,
        Self::UnknownKey,
        Self::MissingKey,
        Self::WrongType,
        Self::OutOfRange,
        Self::WrongLength,
        Self::UnknownName,
        Self::DuplicateName,
        Self::Order,
        Self::Conflict,
        Self::More,
        Self::Untaught,
        Self::Scene,
        Self::Robot,
        Self::NothingAsked,
        Self::Dataset,
    ];

    /// Its name and its meaning in one sentence.
    pub fn describe(self) -> (&'static str, &'static str) {
        match self {
            Self::Unreadable => ("unreadable", "a file that is needed cannot be opened or read"),
            Self::Encoding => ("encoding", "the file is not UTF-8 text, holds a NUL character, or is too large"),
            Self::Syntax => ("syntax", "the text is not TOML"),
            Self::Version => ("version", "the file was written for another version of the program"),
            Self::Extends => ("extends", "a chain of `extends` leads in a circle, is too long, or names a file that is missing"),
            Self::OutsideRoot => ("outside_root", "a file lies outside the scenario's folder, the current folder and every `--asset-root`"),
            Self::Override => ("override", "a `--set KEY=VALUE` that cannot be read or applied"),
            Self::UnknownKey => ("unknown_key", "a key that means nothing where it stands"),
            Self::MissingKey => ("missing_key", "a key without which the scenario makes no sense"),
            Self::WrongType => ("wrong_type", "a value of the wrong type, such as text where a number belongs"),
            Self::OutOfRange => ("out_of_range", "a number that is not finite, or outside the range that makes sense for its key"),
            Self::WrongLength => ("wrong_length", "a list with too few or too many entries"),
            Self::UnknownName => ("unknown_name", "a name that no object, parameter or choice bears"),
            Self::DuplicateName => ("duplicate_name", "a name that two objects or two criteria bear"),
            Self::Order => ("order", "times that do not rise"),
            Self::Conflict => ("conflict", "settings that contradict each other"),
            Self::More => ("more", "there are more faults than are shown"),
            Self::Untaught => ("untaught", "a parameter that the demonstrations do not vary, or not that far (a warning)"),
            Self::Scene => {
                ("scene", "what the scenario asks for is not possible with its robot or in its scene: a pose, a way, a place, a name")
            }
            Self::Robot => ("robot", "the robot's description (URDF) cannot be used, or says something odd (a warning)"),
            Self::NothingAsked => ("nothing_asked", "no criterion of the scenario can fail: whatever happens passes (a warning)"),
            Self::Dataset => ("dataset", "recorded demonstrations cannot be used: their columns, times or values"),
        }
    }
}

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Severity {
    /// The scenario cannot be used.
    Error,
    /// The scenario can be used, but is probably not what was meant.
    Warning,
}

/// Where a fault is.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Place {
    /// A stretch of a text.
    Text(Origin),
    /// A file as a whole.
    File(PathBuf),
}

/// One fault, as it is found.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fault {
    pub code: Code,
    pub severity: Severity,
    pub place: Place,
    pub message: String,
    pub expected: Option<String>,
    pub help: Option<String>,
}

impl Fault {
    /// A fault at a place in a text.
    pub fn at(code: Code, origin: Origin, message: impl Into<String>) -> Self {
        Self { code, severity: Severity::Error, place: Place::Text(origin), message: message.into(), expected: None, help: None }
    }

    /// A fault of a file as a whole.
    pub fn whole_file(code: Code, path: &Path, message: impl Into<String>) -> Self {
        let place = Place::File(path.to_path_buf());
        Self { code, severity: Severity::Error, place, message: message.into(), expected: None, help: None }
    }

    /// The same, as a warning.
    pub fn warning(mut self) -> Self {
        self.severity = Severity::Warning;
        self
    }

    /// Says what would have been right.
    pub fn expected(mut self, text: impl Into<String>) -> Self {
        self.expected = Some(text.into());
        self
    }

    /// Says how to mend it.
    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help = Some(text.into());
        self
    }

    /// Says how to mend it, if that is known.
    pub fn maybe_help(mut self, text: Option<String>) -> Self {
        self.help = text.or(self.help);
        self
    }
}

/// Makes keys that nobody knows a warning instead of an error: what a reader in a hurry asks for. They are left aside either way.
pub(super) fn tolerate_unknown_keys(faults: &mut [Fault]) {
    for fault in faults.iter_mut().filter(|fault| fault.code == Code::UnknownKey) {
        fault.severity = Severity::Warning;
    }
}

/// Makes every warning an error: what somebody asks for who wants none.
pub(super) fn deny_warnings(faults: &mut [Fault]) {
    faults.iter_mut().for_each(|fault| fault.severity = Severity::Error);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_is_listed_once_under_its_own_name() {
        for (index, code) in Code::ALL.into_iter().enumerate() {
            assert_eq!(code as usize, index);
            assert_eq!(serde_json::to_string(&code).expect("a name"), format!("\"{}\"", code.describe().0));
        }
    }
}
