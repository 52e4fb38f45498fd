//! The command line as typed.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, Parser, Subcommand, ValueEnum};

use super::examples;
use super::learning_args::{Generate, Inspect, Learn};
use super::sweep_args::{MergeArguments, SweepArguments};
use super::view::View;
use super::viewer::Viewer;

/// A physics testbed for Compliant Parametric Dynamic Movement Primitives.
///
/// Teaches a simulated robot by a virtual human, learns the skill, executes it in a new setting with a helping hand, and judges the result.
#[derive(Debug, Parser)]
#[command(name = "cpdmp", version, propagate_version = true, arg_required_else_help = true)]
#[command(after_help = "Results go to stdout, progress to stderr. `cpdmp explain` lists the exit codes.")]
pub(super) struct Cli {
    #[command(flatten)]
    pub global: Global,
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Teach, learn, execute, judge and record: one run folder per scenario
    #[command(after_long_help = examples::RUN)]
    Run(Run),
    /// Run without recording or display and judge: what a continuous integration calls
    #[command(after_long_help = examples::CHECK)]
    Check(Check),
    /// Check scenarios and what they need, without simulating: all faults at once
    #[command(after_long_help = examples::VALIDATE)]
    Validate(Paths),
    /// Let the virtual human teach: all lessons, each replayed for its wrenches, go into a new dataset (--out)
    #[command(after_long_help = examples::TEACH)]
    Teach(Teach),
    /// Learn a skill from a dataset, simulated or your own
    Learn(Learn),
    /// Generate a skill's movement for new parameters, start and goal, without physics
    Generate(Generate),
    /// Say what a skill, a dataset, a run folder or a robot's file holds
    Inspect(Inspect),
    /// Show the recording of a run in the rerun viewer
    View(View),
    /// Bring files of an older version of the program to this one's
    #[command(after_long_help = examples::MIGRATE)]
    Migrate(Files),
    /// Run a scenario again and again with other values of its keys: one table, one row per run
    #[command(after_long_help = examples::SWEEP)]
    Sweep(SweepArguments),
    /// Run a run again and compare its state hashes; with --set, say where another run parts from it
    #[command(after_long_help = examples::REPLAY)]
    Replay(Replay),
    /// Join the tables of a sweep's shards into one (--out)
    #[command(after_long_help = examples::MERGE)]
    Merge(MergeArguments),
    /// Draw the figures of a run again, from what its folder holds
    #[command(after_long_help = examples::FIGURES)]
    Figures(RunFolder),
    /// List the scenarios of a folder, with what each shows
    List(Folders),
    /// Explain exit codes and the codes of faults
    #[command(after_long_help = examples::EXPLAIN)]
    Explain(Code),
    /// Print the JSON Schema of a file format: editors complete and check files with it
    #[command(after_long_help = examples::SCHEMA)]
    Schema(FileFormat),
    /// Print the completions of a shell
    #[command(after_long_help = examples::COMPLETIONS)]
    Completions(Shell),
    /// Print the manual page, or write those of all commands to a folder with --out
    Man,
}

/// What is run, and who watches.
#[derive(Debug, Args)]
pub(super) struct Run {
    #[command(flatten)]
    pub scenarios: Paths,
    /// Show the run in the rerun viewer while it goes on; a viewer that is missing, slow or closed changes nothing about the run
    #[arg(long, env = "CPDMP_VIEWER")]
    pub viewer: bool,
    #[command(flatten)]
    pub with: Viewer,
}

/// Scenarios.
#[derive(Debug, Args)]
pub(super) struct Paths {
    /// Scenario files, folders of them, or patterns with `*` and `?` in the file name
    #[arg(required = true, value_name = "SCENARIO")]
    pub paths: Vec<PathBuf>,
}

/// Files that may be of an older version.
#[derive(Debug, Args)]
pub(super) struct Files {
    /// Scenarios and lists of datasets, which are brought to this version; skills and other JSON files, which are only looked at
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Say what would be changed, and change nothing
    #[arg(long)]
    pub dry_run: bool,
}

/// What is taught.
#[derive(Debug, Args)]
pub(super) struct Teach {
    /// The scenario whose lessons are given
    #[arg(value_name = "SCENARIO")]
    pub scenario: PathBuf,
}

/// A run that is over.
#[derive(Debug, Args)]
pub(super) struct RunFolder {
    /// The folder that a run has left
    #[arg(value_name = "RUN_DIR")]
    pub folder: PathBuf,
}

/// A run that is made again.
#[derive(Debug, Args)]
pub(super) struct Replay {
    /// The folder that a run has left
    #[arg(value_name = "RUN_DIR")]
    pub folder: PathBuf,
    /// Begin with this phase: what comes before it is taken from the folder, as the run left it
    #[arg(long, value_enum, value_name = "PHASE")]
    pub from: Option<Phase>,
    /// Take the execution up at the last snapshot that the run made up to this time of it (s)
    #[arg(long, value_name = "SECONDS", value_parser = time_s, allow_hyphen_values = true, conflicts_with = "from")]
    pub from_time: Option<f64>,
}

/// A time that is not negative (s).
fn time_s(text: &str) -> Result<f64, String> {
    let time: Option<f64> = text.parse().ok().filter(|time: &f64| *time >= 0.0 && time.is_finite());
    time.ok_or_else(|| "seconds since the execution began, such as 12.5".to_owned())
}

/// A phase that a run can be taken up with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Phase {
    /// Learning, from the folder's demonstrations.
    Learn,
    /// Execution, with the folder's skill.
    Execute,
}

impl Phase {
    /// What reports call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Learn => "learn",
            Self::Execute => "execute",
        }
    }
}

/// What is checked, and where the verdict goes.
#[derive(Debug, Args)]
pub(super) struct Check {
    /// Scenario files, folders of them, or patterns with `*` and `?` in the file name; folders of stored runs; files of samples (CSV or
    /// Parquet with `time_s` and joint angles or tool poses)
    #[arg(required = true, value_name = "PATH")]
    pub paths: Vec<PathBuf>,
    /// Judge files of samples, also those that lie in the folders, in the scene of this scenario
    #[arg(long, value_name = "SCENARIO")]
    pub scene: Option<PathBuf>,
    /// Write the verdict as JUnit to this file, whatever else is printed
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
}

/// Where scenarios are looked for.
#[derive(Debug, Args)]
pub(super) struct Folders {
    /// Scenario files, folders or patterns
    #[arg(default_value = "scenarios", value_name = "PATH")]
    pub paths: Vec<PathBuf>,
}

/// What to explain.
#[derive(Debug, Args)]
pub(super) struct Code {
    /// An exit code (`10`), its name (`criteria_not_met`), or the code of a fault (`unknown_key`); all of them without one
    pub code: Option<String>,
}

/// Of what a schema is asked.
#[derive(Debug, Args)]
pub(super) struct FileFormat {
    /// Which format; all of them are listed without one
    #[arg(value_enum)]
    pub name: Option<SchemaName>,
}

/// A file format with a JSON Schema.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum SchemaName {
    /// Scenario files.
    Scenario,
    /// Settings of learning for `cpdmp learn --settings`.
    Learning,
    /// The `dataset.toml` of a dataset.
    Dataset,
    /// The `skill.json` of a run, or of `cpdmp learn`.
    Skill,
    /// The `report.json` of a run.
    Report,
    /// The `manifest.json` of a run.
    Manifest,
    /// What `cpdmp check --format json` prints.
    Check,
    /// What `cpdmp learn --format json` prints.
    Learn,
    /// What `cpdmp sweep --format json` prints.
    Sweep,
    /// What `cpdmp replay --format json` prints.
    Replay,
}

/// For which shell.
#[derive(Debug, Args)]
pub(super) struct Shell {
    /// The shell
    #[arg(value_enum)]
    pub shell: clap_complete::Shell,
}

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
    /// Refuse a scenario or robot that would be warned of (exit code 3), and let a run that warns of something be one that is not as
    /// expected (10): for run, check, validate and sweep
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
