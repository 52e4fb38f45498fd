//! One question of a scenario and its answer.

use std::borrow::Cow;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::check::Place;

/// One question and its answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CriterionReport {
    /// Its name.
    pub name: String,
    /// Whether the outcome of the run depends on it.
    pub required: bool,
    /// The answer that the scenario expects: `pass`, `fail` or `report`.
    pub expect: Cow<'static, str>,
    /// Whether the criterion holds.
    pub passed: bool,
    /// Whether that is what the scenario expects.
    pub as_expected: bool,
    /// The measured value; `null` when the event it is about never happened.
    pub value: Option<f64>,
    /// The limit it is held against.
    pub limit: Option<f64>,
    /// Unit of value, limit and margin.
    pub unit: Cow<'static, str>,
    /// How far the value is on the right side of the limit.
    pub margin: Option<f64>,
    /// When it first failed (s); `null` when it did not, or when that is not followed, as of a clearance.
    pub first_failed_time_s: Option<f64>,
    /// Where it was typed; `null` for one from the command line.
    pub place: Option<Place>,
    /// Whose answer it is.
    #[serde(default)]
    pub status: AnswerStatus,
    /// Why it was not judged; `null` when there is an answer.
    #[serde(default)]
    pub not_judged_because: Option<String>,
}

/// Whose answer the answer to a question is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AnswerStatus {
    /// It was judged for this report.
    #[default]
    Judged,
    /// A stored run gave it when it ran.
    Recorded,
    /// There is none. Nothing depends on it, unless a change of a stored run took it away: then a required one is not as expected.
    NotJudged,
}

impl CriterionReport {
    /// Whether it speaks against the run.
    pub fn fails(&self) -> bool {
        self.required && !self.as_expected
    }
}
