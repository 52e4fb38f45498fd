//! What `cpdmp replay` says.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::Serialize;

use crate::check::{DifferenceKind, ReplayDifference};
use crate::report::Outcome;

/// A run and its repetition.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct ReplayReport {
    /// Version of this format.
    pub schema_version: u32,
    /// The folder of the run.
    pub run: PathBuf,
    /// The phase from which on it was made again, `learn` or `execute`; `null` for all of it.
    pub from: Option<&'static str>,
    /// The step of the execution after which it was made again, from a snapshot; `null` when it began with a phase or the run.
    pub from_step: Option<u64>,
    /// `passed` when the two are the same to the last bit, `replay_differs` when not.
    pub outcome: Outcome,
    /// The exit code that belongs to it.
    pub exit_code: u8,
    /// Hash over every state of the run; with `from`, over every state of its execution.
    pub recorded_state_hash: String,
    /// The same of the repetition.
    pub repeated_state_hash: String,
    /// Hashes that were compared on the way.
    pub hashes: usize,
    /// Where the two first part, in words; `null` when they are the same.
    pub difference: Option<String>,
    /// The phase of the world in which they part: `teach`, `replay`, `learn` or `execute`.
    pub phase: Option<String>,
    /// The world's number in it, from 0.
    pub number: Option<u64>,
    /// The first step that is known to differ.
    pub step: Option<u64>,
    /// The body that differs most, or first, in it.
    pub body: Option<String>,
    /// What of it differs: `position`, `orientation`, `linear velocity` or `angular velocity`.
    pub quantity: Option<&'static str>,
    /// What explains it; empty when the two are the same.
    pub reasons: Vec<String>,
}

impl ReplayReport {
    /// The same report with where the two part.
    pub fn parting(mut self, difference: &ReplayDifference) -> Self {
        let (step, part) = match &difference.what {
            DifferenceKind::Between { step, parts, .. } => (Some(*step), parts.first().cloned()),
            DifferenceKind::Exact { step, body, quantity, .. } => (Some(*step), Some((body.clone(), *quantity))),
            DifferenceKind::Edited { step, part } => (Some(*step), part.clone()),
            DifferenceKind::World(_) => (None, None),
        };
        self.difference = Some(difference.to_string());
        self.phase = Some(difference.phase.clone());
        self.number = Some(difference.number);
        self.step = step;
        self.body = part.as_ref().map(|(body, _)| body.clone());
        self.quantity = part.map(|(_, quantity)| quantity);
        self
    }

    /// The report for people.
    pub fn text(&self) -> String {
        let from = match (self.from_step, self.from) {
            (Some(step), _) => format!(" from step {step} of the execution on"),
            (None, Some(phase)) => format!(" from `{phase}` on"),
            (None, None) => String::new(),
        };
        let run = format!("{}{from}", self.run.display());
        match &self.difference {
            None => format!("{run}: identical, state hash {}, {} hashes on the way\n", self.repeated_state_hash, self.hashes),
            Some(difference) => format!(
                "{run}: differs, state hash {} instead of {}\n  {difference}\n  {}\n",
                self.repeated_state_hash,
                self.recorded_state_hash,
                self.reasons.join("\n  ")
            ),
        }
    }
}
