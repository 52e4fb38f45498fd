//! How a command can end: the one table of exit codes.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize, Serializer};

/// How a command ended. The exit code and the name are an interface: other programs read them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Everything is as expected.
    Passed,
    /// A criterion was not as expected.
    CriteriaNotMet,
    /// The simulation left the finite numbers.
    Diverged,
    /// The run took longer than it may.
    TimeLimit,
    /// A repetition is not the run that it repeats.
    ReplayDiffers,
    /// No skill could be learned.
    LearningFailed,
    /// The arguments select no scenario.
    NothingSelected,
    /// Another run writes to the same folder.
    OutputBusy,
    /// The output cannot be written.
    OutputFailed,
    /// A scenario, robot or dataset cannot be used.
    InvalidInput,
    /// The command line makes no sense.
    Usage,
    /// A bug in the program.
    InternalError,
}

impl Outcome {
    /// Every outcome, from the mildest to the worst: a command that meets several ends with the worst.
    pub const ALL: [Self; 12] = [
        Self::Passed,
        Self::CriteriaNotMet,
        Self::Diverged,
        Self::TimeLimit,
        Self::ReplayDiffers,
        Self::LearningFailed,
        Self::NothingSelected,
        Self::OutputBusy,
        Self::OutputFailed,
        Self::InvalidInput,
        Self::Usage,
        Self::InternalError,
    ];

    /// The outcome of that name in a report or table.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|outcome| outcome.name() == name)
    }

    /// The exit code of the program.
    pub fn exit_code(self) -> u8 {
        match self {
            Self::Passed => 0,
            Self::InternalError => 1,
            Self::Usage => 2,
            Self::InvalidInput => 3,
            Self::LearningFailed => 4,
            Self::NothingSelected => 5,
            Self::CriteriaNotMet => 10,
            Self::Diverged => 11,
            Self::TimeLimit => 12,
            Self::ReplayDiffers => 13,
            Self::OutputFailed => 20,
            Self::OutputBusy => 21,
        }
    }

    /// The name in `report.json`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Passed => "passed",
            Self::CriteriaNotMet => "criteria_not_met",
            Self::Diverged => "diverged",
            Self::TimeLimit => "time_limit",
            Self::ReplayDiffers => "replay_differs",
            Self::LearningFailed => "learning_failed",
            Self::NothingSelected => "nothing_selected",
            Self::OutputBusy => "output_busy",
            Self::OutputFailed => "output_failed",
            Self::InvalidInput => "invalid_input",
            Self::Usage => "usage",
            Self::InternalError => "internal_error",
        }
    }

    /// What it means, and what to do.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Passed => "every required criterion is as the scenario expects",
            Self::CriteriaNotMet => {
                "a required criterion is not as the scenario expects: the table and report.json say which, by how much and when; or a movement \
                 would go further beyond what was demonstrated than --deny-extrapolation allows, or a run warns of something and \
                 --deny-warnings is given"
            }
            Self::Diverged => {
                "the simulation left the finite numbers: the message says when, which body and which are the fastest; a smaller simulation.step_s may help"
            }
            Self::TimeLimit => "a run took longer than --timeout allows: the message says how far it came",
            Self::ReplayDiffers => {
                "the repetition of a run is not the same to the last bit: the message says from where on, and what explains it"
            }
            Self::LearningFailed => "no skill could be learned from the demonstrations: the message says what they lack",
            Self::NothingSelected => "the arguments name no scenario: check the folder or pattern",
            Self::OutputBusy => "another run is writing to the same folder: wait, or choose another --out",
            Self::OutputFailed => {
                "the output cannot be written: disk full, no permission, or the place holds something that is not a run, a skill or samples"
            }
            Self::InvalidInput => "a scenario, robot file, dataset or skill cannot be used: nothing was simulated, learned or written",
            Self::Usage => "the command line cannot be understood: see --help",
            Self::InternalError => "a bug in the program: please report it with the command and the scenario",
        }
    }
}

impl Serialize for Outcome {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl JsonSchema for Outcome {
    fn schema_name() -> Cow<'static, str> {
        "Outcome".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "description": "How a command ended.", "enum": Self::ALL.map(Self::name) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_outcome_has_a_code_and_a_name_of_its_own() {
        for (index, outcome) in Outcome::ALL.into_iter().enumerate() {
            assert_eq!(outcome as usize, index, "ALL is in the order of the enum");
            let twins = Outcome::ALL.iter().filter(|other| other.exit_code() == outcome.exit_code() || other.name() == outcome.name());
            assert_eq!(twins.count(), 1, "{outcome:?}");
            let read: Outcome = serde_json::from_value(outcome.name().into()).expect("its own name is read");
            assert_eq!(read, outcome);
        }
    }
}
