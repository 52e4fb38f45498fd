//! A sweep in a few figures.

use schemars::JsonSchema;
use serde::Serialize;

use super::Row;
use crate::report::Outcome;

/// What a sweep came to.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Summary {
    /// Rows.
    pub runs: u64,
    /// How many runs ended in which way, the mildest first; ways in which none ended are left out.
    pub outcomes: Vec<(&'static str, u64)>,
    /// Every criterion.
    pub criteria: Vec<CriterionSummary>,
    /// The first run that did not pass.
    pub first_failure: Option<FirstFailure>,
    /// The worst outcome.
    #[serde(skip)]
    pub worst: Outcome,
}

/// A run that did not pass.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct FirstFailure {
    /// The member's number.
    pub index: u64,
    /// Why.
    pub reason: String,
    /// The command that runs it alone.
    pub command: String,
}

/// What the runs of a sweep say about one criterion.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CriterionSummary {
    /// Its name.
    pub name: String,
    /// Runs that came far enough to answer it.
    pub answered: u64,
    /// Runs in which it holds.
    pub passed: u64,
    /// Runs in which it is as the scenario expects.
    pub as_expected: u64,
    /// The smallest margin.
    pub worst_margin: Option<f64>,
    /// The member that has it.
    pub worst_index: Option<u64>,
    /// Its unit.
    pub unit: String,
}

impl Summary {
    /// Of no rows so far.
    pub fn new(criteria: &[String]) -> Self {
        let criterion = |name: &String| CriterionSummary {
            name: name.clone(),
            answered: 0,
            passed: 0,
            as_expected: 0,
            worst_margin: None,
            worst_index: None,
            unit: String::new(),
        };
        let criteria = criteria.iter().map(criterion).collect();
        Self { runs: 0, outcomes: Vec::new(), criteria, first_failure: None, worst: Outcome::Passed }
    }

    /// Counts one row.
    pub fn add(&mut self, row: &Row) {
        self.runs += 1;
        let outcome = Outcome::named(&row.outcome).unwrap_or(Outcome::InternalError);
        self.worst = self.worst.max(outcome);
        if let (None, Some(reason)) = (&self.first_failure, &row.failure_reason) {
            self.first_failure = Some(FirstFailure { index: row.index, reason: reason.clone(), command: row.command.clone() });
        }
        match self.outcomes.iter_mut().find(|(name, _)| *name == outcome.name()) {
            Some((_, count)) => *count += 1,
            None => {
                self.outcomes.push((outcome.name(), 1));
                self.outcomes.sort_by_key(|(name, _)| Outcome::ALL.iter().position(|outcome| outcome.name() == *name));
            }
        }
        for (told, answer) in self.criteria.iter_mut().zip(&row.criteria) {
            told.answered += 1;
            told.passed += u64::from(answer.passed);
            told.as_expected += u64::from(answer.as_expected);
            told.unit.clone_from(&answer.unit);
            if let Some(margin) = answer.margin.filter(|margin| told.worst_margin.is_none_or(|worst| *margin < worst)) {
                told.worst_margin = Some(margin);
                told.worst_index = Some(row.index);
            }
        }
    }
}
