//! Why something could not be learned, stored or executed.

use std::path::PathBuf;

use crate::demonstration::DemonstrationError;
use crate::math::MathError;

/// One setting outside its range.
#[derive(Debug, Clone, PartialEq)]
pub struct SettingFault {
    /// Which setting.
    pub setting: String,
    /// The value that came.
    pub value: f64,
    /// The allowed range with its unit, in words.
    pub range: String,
}

impl SettingFault {
    /// A fault when `value` does not lie in `[from, to]`.
    #[must_use]
    pub fn outside(setting: &str, value: f64, from: f64, to: f64, unit: &str) -> Option<Self> {
        let range = format!("{from} to {to} {unit}").trim_end().to_owned();
        (!(from..=to).contains(&value)).then(|| Self { setting: setting.to_owned(), value, range })
    }
}

impl std::fmt::Display for SettingFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} is {}, but must be {}", self.setting, self.value, self.range)
    }
}

/// Why something could not be learned, stored or executed.
#[derive(Debug, thiserror::Error)]
pub enum LearningError {
    /// Settings outside their ranges, all of them.
    #[error("{}", joined(.0))]
    Settings(Vec<SettingFault>),
    /// The demonstrations cannot be learned from.
    #[error("{0}")]
    Data(String),
    /// The demonstrations are not well formed.
    #[error(transparent)]
    Demonstration(#[from] DemonstrationError),
    /// A model is not well formed.
    #[error("model: {0}")]
    Model(String),
    /// A skill file is not usable.
    #[error("skill: {0}")]
    Skill(String),
    /// A skill is asked for something it cannot do.
    #[error("{0}")]
    Request(String),
    /// Numbers that mathematics refuses.
    #[error(transparent)]
    Math(#[from] MathError),
    /// The file system refused.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// Whoever waits did not let it go on.
    #[error("the time limit was reached before {next}: allow more, or ask for less")]
    Stopped {
        /// What would have come next.
        next: String,
    },
}

fn joined(faults: &[SettingFault]) -> String {
    faults.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}
