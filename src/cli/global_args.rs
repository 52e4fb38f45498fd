//! The flags that several commands understand, as typed.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, ValueEnum};

/// What several commands understand (`global_flags` says which). A flag wins over the environment, that over the scenario, that over the default.
#[derive(Debug, Args)]
pub(super) struct Global {
    /// Override a key of the scenario (`object.toy.radius_m=0.035`), or of [learning]; may be repeated
    #[arg(long, global = true, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Override the scenario's seed
    #[arg(long, global = true, env = "CPDMP_SEED", value_name = "N", value_parser = clap::value_parser!(u64).range(..=i64::MAX as u64))]
    pub seed: Option<u64>,
    /// Use this robot: a URDF file, or builtin:baxter
    #[arg(long, global = true, env = "CPDMP_ROBOT", value_name = "URDF")]
    pub robot: Option<String>,
    /// Let scenarios use the files of this folder too; may be repeated
    #[arg(long, global = true, env = "CPDMP_ASSET_ROOT", value_name = "DIR")]
    pub asset_root: Vec<PathBuf>,
    /// Only warn of keys that a scenario or settings of learning cannot have, and leave them aside
    #[arg(long, global = true, env = "CPDMP_LENIENT")]
    pub lenient: bool,
    /// Refuse a scenario that would be warned of, before a sweep and for validate also its robot and dataset (exit code 3), and let a run
    /// that warns of something be one that is not as expected (10): for run, check, validate and sweep
    #[arg(long, global = true, env = "CPDMP_DENY_WARNINGS", conflicts_with = "lenient")]
    pub deny_warnings: bool,
    /// Write the run to this folder (for several scenarios: to folders in it) instead of runs/<scenario>-<seed>; the skill or the
    /// samples to this file; figures to this folder; the sweep to this folder instead of sweeps/<scenario>; the joined table to this file
    #[arg(long, global = true, env = "CPDMP_OUT", value_name = "PATH")]
    pub out: Option<PathBuf>,
    /// Use this many threads; the result does not depend on it
    #[arg(long, global = true, env = "CPDMP_JOBS", value_name = "N", value_parser = threads)]
    pub jobs: Option<usize>,
    /// End a run that takes longer than this many seconds with exit code 12: looked at before every step of the simulation,
    /// every iteration of a model and every pose of a plan; every scenario has its own
    #[arg(long, global = true, env = "CPDMP_TIMEOUT", value_name = "S", value_parser = seconds)]
    pub timeout: Option<Duration>,
    /// Print results for people, as JSON (one document per line), or of `check` as JUnit or as GitHub annotations
    #[arg(long, global = true, env = "CPDMP_FORMAT", value_enum, default_value = "human")]
    pub format: Printed,
    /// Tell more: also what is odd about the robot's file, and which contacts are allowed why
    #[arg(short, long, global = true, action = clap::ArgAction::Count)]
    pub verbose: u8,
    /// Tell nothing but results and errors
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Colour the output
    #[arg(long, global = true, env = "CPDMP_COLOR", value_enum, default_value = "auto", value_name = "WHEN")]
    pub color: Colour,
    /// Draw no progress bars
    #[arg(long, global = true, env = "CPDMP_NO_PROGRESS")]
    pub no_progress: bool,
}

/// How results are printed, as typed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Printed {
    /// For people.
    Human,
    /// For programs.
    Json,
    /// For continuous integrations.
    Junit,
    /// For GitHub's workflows: annotations at the lines of the scenario.
    Github,
}

/// For whom the results of most commands are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    /// For people.
    Human,
    /// For programs.
    Json,
}

impl Printed {
    /// For whom that is.
    pub fn format(self) -> Format {
        if self == Self::Human { Format::Human } else { Format::Json }
    }

    /// Whether only the verdicts of `check` can be printed like that.
    pub fn is_for_verdicts(self) -> bool {
        matches!(self, Self::Junit | Self::Github)
    }
}

/// When output is coloured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Colour {
    /// On a terminal that can, unless NO_COLOR is set.
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

fn seconds(text: &str) -> Result<Duration, String> {
    let limit = text.parse().ok().filter(|&seconds: &f64| seconds > 0.0).and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    limit.ok_or_else(|| "a number of seconds greater than 0".to_owned())
}

fn threads(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(count @ 1..=1024) => Ok(count),
        _ => Err("a whole number, 1 … 1024".to_owned()),
    }
}
