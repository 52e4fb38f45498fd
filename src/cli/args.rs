//! The command line as typed.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

use super::examples;
pub(super) use super::global_args::{Colour, Format, Global, Printed};
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
    /// Scenario files, folders of them, or patterns (`*`, `?`, `[ab]`, and `**` for folders at any depth)
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
    /// Scenario files, folders of them, or patterns (`*`, `?`, `[ab]`, and `**` for folders at any depth); folders of stored runs; files of
    /// samples (CSV or Parquet with `time_s` and joint angles or tool poses)
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
