//! The arguments of `sweep` and `merge`.

use std::path::PathBuf;

use clap::Args;

use crate::batch::Shard;

/// A sweep.
#[derive(Debug, Args)]
pub(super) struct SweepArguments {
    /// The scenario; its `[[sweep]]` says what varies, as do the flags below
    #[arg(value_name = "SCENARIO")]
    pub path: PathBuf,
    /// Vary a key of the scenario over these values; several grids are combined each with each
    #[arg(long, value_name = "KEY=A,B,C")]
    pub grid: Vec<String>,
    /// Run everything with this many seeds, from the scenario's seed on
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    pub repeat: Option<u64>,
    /// Run only part K of N, for one of several machines; `cpdmp merge` joins their tables
    #[arg(long, env = "CPDMP_SHARD", value_name = "K/N", default_value = "1/1")]
    pub shard: Shard,
    /// Go on with the sweep that is in the folder already; begin if there is none
    #[arg(long)]
    pub resume: bool,
    /// Refuse sweeps of more runs than this
    #[arg(long, value_name = "N", default_value = "100000", value_parser = clap::value_parser!(u64).range(1..=10_000_000))]
    pub max_runs: u64,
    /// Check every member, say how many there are, and run none
    #[arg(long)]
    pub dry_run: bool,
}

/// Tables to join.
#[derive(Debug, Args)]
pub(super) struct MergeArguments {
    /// Tables of shards, or the folders that they are in
    #[arg(required = true, value_name = "TABLE")]
    pub tables: Vec<PathBuf>,
}
