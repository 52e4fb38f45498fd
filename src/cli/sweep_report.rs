//! What `cpdmp sweep` says to programs.

use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;

use crate::batch::{Plan, Shard, Summary};
use crate::report::Outcome;

/// A sweep, or what it would be: with `--dry-run` nothing has come of it.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct SweepReport<'a> {
    /// Version of this format.
    pub schema_version: u32,
    /// Name of the scenario.
    pub scenario: &'a str,
    /// The worst outcome of all runs.
    pub outcome: Option<Outcome>,
    /// The exit code that belongs to it.
    pub exit_code: Option<u8>,
    /// Runs of the whole sweep.
    pub members: u64,
    /// Which part of it was to be run: `K/N`.
    pub shard: String,
    /// Hash over everything that decides what the runs are: equal hashes, equal sweeps.
    pub sweep_hash: &'a str,
    /// The table, one row per run.
    pub table: Option<&'a Path>,
    /// The table in a few figures.
    pub summary: Option<&'a Summary>,
}

impl<'a> SweepReport<'a> {
    /// Of a sweep that has not begun.
    pub fn of(plan: &'a Plan, shard: Shard) -> Self {
        Self {
            schema_version: 1,
            scenario: &plan.scenario,
            outcome: None,
            exit_code: None,
            members: plan.members,
            shard: shard.to_string(),
            sweep_hash: &plan.hash,
            table: None,
            summary: None,
        }
    }

    /// The same, with what came of it.
    pub fn done(self, table: &'a Path, summary: &'a Summary) -> Self {
        let (outcome, exit_code) = (Some(summary.worst), Some(summary.worst.exit_code()));
        Self { outcome, exit_code, table: Some(table), summary: Some(summary), ..self }
    }
}
