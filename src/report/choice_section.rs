//! What learning chose from the data, with the curve it was chosen from.

use schemars::JsonSchema;
use serde::Serialize;

use super::table::figure;
use crate::learning::LearningReport;
use crate::learning::selection::Choices;

/// One setting that was chosen.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ChoiceSection {
    /// Which setting: `motion.states`, `motion.ridge`, `force.states` or `force.ridge`.
    pub setting: &'static str,
    /// What was chosen.
    pub chosen: f64,
    /// Every candidate; none when the demonstrations leave nothing to choose by.
    pub curve: Vec<Candidate>,
}

/// One candidate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Candidate {
    /// Its value.
    pub value: f64,
    /// Its score, less is better; none when it could not be learned.
    pub score: Option<f64>,
}

impl ChoiceSection {
    /// Every choice that learning made.
    pub fn of(report: &LearningReport) -> Vec<Self> {
        let motion = Self::of_model(&report.motion_choices, ["motion.states", "motion.ridge"]);
        motion.chain(Self::of_model(&report.force_choices, ["force.states", "force.ridge"])).collect()
    }

    /// The choices for one model, whose number of states and ridge are called by these names.
    fn of_model(choices: &Choices, [states, ridge]: [&'static str; 2]) -> impl Iterator<Item = Self> {
        let candidate = |value: f64, score: f64| Candidate { value, score: Some(score).filter(|score| score.is_finite()) };
        let states = choices.states.iter().map(move |choice| Self {
            setting: states,
            chosen: choice.states as f64,
            curve: choice.curve.iter().map(|one| candidate(one.states as f64, one.score)).collect(),
        });
        let ridge = choices.ridge.iter().map(move |choice| Self {
            setting: ridge,
            chosen: choice.ridge,
            curve: choice.curve.iter().map(|one| candidate(one.ridge, one.error)).collect(),
        });
        states.chain(ridge)
    }

    /// The choice as a line of text.
    pub fn line(&self) -> String {
        if self.curve.is_empty() {
            let why = "nothing to choose by: it takes three different parameter values";
            return format!("  chosen       {} = {} ({why})", self.setting, figure(self.chosen));
        }
        let score = |one: &Candidate| one.score.map_or("-".to_owned(), figure);
        let curve: Vec<String> = self.curve.iter().map(|one| format!("{}: {}", figure(one.value), score(one))).collect();
        format!("  chosen       {} = {} (score, less is better: {})", self.setting, figure(self.chosen), curve.join(", "))
    }
}
