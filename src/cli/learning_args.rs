//! The command line of `learn`, `generate` and `inspect` as typed.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

/// What to learn from, and how.
#[derive(Debug, Args)]
#[command(after_long_help = LEARN_EXAMPLES)]
pub(super) struct Learn {
    /// A dataset: a folder with dataset.toml, or what else holds demonstrations
    #[arg(value_name = "DATASET")]
    pub dataset: PathBuf,
    /// Number of states of the motion model, or `auto`: the one that predicts best what is left out
    #[arg(long, value_name = "N")]
    pub states: Option<String>,
    /// Number of states of the force model, or `auto`
    #[arg(long, value_name = "N")]
    pub force_states: Option<String>,
    /// Stiffness K of the movement primitive
    #[arg(long, value_name = "K")]
    pub stiffness: Option<String>,
    /// Strength of the prior W = 0 of both models, as a number of demonstrations; or `auto`: for each model the one that predicts best
    /// what is left out
    #[arg(long, value_name = "X")]
    pub ridge: Option<String>,
    /// What the motion model sees of the parameters: linear, quadratic or rbf
    #[arg(long, value_name = "KIND")]
    pub features: Option<String>,
    /// Take the motion parameters from the demonstrations themselves, whatever the dataset says
    #[arg(long, value_enum, value_name = "SOURCE")]
    pub theta: Option<Theta>,
    /// Align the demonstrations in time before learning: a smooth warp for each, ends fixed; not where the parameters then explain less
    #[arg(long)]
    pub align: bool,
    /// Columns that the motion model learns, instead of the dataset's
    #[arg(long, value_name = "COLUMN,COLUMN", value_delimiter = ',')]
    pub motion: Vec<String>,
    /// Columns that the force model learns, instead of the dataset's
    #[arg(long, value_name = "COLUMN,COLUMN", value_delimiter = ',', conflicts_with = "no_wrench")]
    pub wrench: Vec<String>,
    /// Learn no force model
    #[arg(long)]
    pub no_wrench: bool,
    /// Learn the baseline, LWR-DMP: blind to parameters, without compliance
    #[arg(long, conflicts_with_all = ["init", "states", "force_states"])]
    pub baseline: bool,
    /// Start from the models of this skill, and from nothing else; they decide the number of states
    #[arg(long, value_name = "SKILL.json", conflicts_with_all = ["states", "force_states", "cross_validate"])]
    pub init: Option<PathBuf>,
    /// Most iterations of each model
    #[arg(long, value_name = "K")]
    pub max_iterations: Option<String>,
    /// Stop when the objective rises by less than this fraction of itself; 0 makes exactly the most iterations
    #[arg(long, value_name = "T")]
    pub tolerance: Option<String>,
    /// Predict every demonstration by a skill learned without it, beside the baseline
    #[arg(long)]
    pub cross_validate: bool,
    /// A TOML file with a [learning] table, as in scenarios
    #[arg(long, value_name = "FILE.toml")]
    pub settings: Option<PathBuf>,
}

/// Where the motion parameters come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Theta {
    /// As the dataset gives them.
    Given,
    /// The first sample: start_x_m …
    Start,
    /// The last sample: goal_x_m …
    Goal,
    /// First minus last sample: relative_start_x_m …
    #[value(name = "start_relative_to_goal")]
    StartRelativeToGoal,
}

/// How the movement is integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Method {
    /// The exact solution for a forcing held over the step: second order, stable for every step.
    Hold,
    /// Runge-Kutta: fourth order where the forcing is smooth.
    Rk4,
}

/// What to generate.
#[derive(Clone, Debug, Args)]
#[command(after_long_help = GENERATE_EXAMPLES)]
pub(super) struct Generate {
    /// The skill
    #[arg(value_name = "SKILL.json")]
    pub skill: PathBuf,
    /// A parameter of the motion or the force; may be repeated. One that was the same in all demonstrations keeps that value
    #[arg(long, value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub theta: Vec<String>,
    /// Where a motion column starts; may be repeated. Columns that are not named start as learned. qx, qy, qz, qw together are the orientation
    #[arg(long, value_name = "COLUMN=VALUE", allow_hyphen_values = true)]
    pub start: Vec<String>,
    /// Where a motion column ends; may be repeated. Columns that are not named end as learned. qx, qy, qz, qw together are the orientation
    #[arg(long, value_name = "COLUMN=VALUE", allow_hyphen_values = true)]
    pub goal: Vec<String>,
    /// How long the movement takes (s); as demonstrated without it
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub duration: Option<f64>,
    /// Time between samples (s); adjusted so that the last sample is the end
    #[arg(long, value_name = "S", default_value_t = 0.01, allow_hyphen_values = true)]
    pub dt: f64,
    /// Where to stop, in durations: 1.2 also shows the movement settle
    #[arg(long, value_name = "X", default_value_t = 1.0, allow_hyphen_values = true)]
    pub until: f64,
    /// How to integrate
    #[arg(long, value_enum, default_value = "hold", value_name = "METHOD")]
    pub integrator: Method,
    /// Infer the motion's parameters from the first part of a movement, in a CSV or Parquet file; --theta wins
    #[arg(long, value_name = "FILE")]
    pub observe: Option<PathBuf>,
    /// Also write the wrench that the force model expects
    #[arg(long)]
    pub expected_wrench: bool,
    /// Also write std_COLUMN, the standard deviation that the model expects of every motion column, with what it does not know for want of
    /// demonstrations
    #[arg(long)]
    pub covariance: bool,
    /// Fail (exit code 10) when a parameter, or a combination of parameters, lies further outside what was demonstrated than this fraction of its
    /// range
    #[arg(long, value_name = "RATIO")]
    pub deny_extrapolation: Option<f64>,
}

/// What to look at.
#[derive(Debug, Args)]
#[command(after_long_help = INSPECT_EXAMPLES)]
pub(super) struct Inspect {
    /// A skill, a dataset, a run folder or a robot's URDF file: what it is, its content says
    #[arg(value_name = "PATH")]
    pub path: PathBuf,
}

pub(super) const LEARN_EXAMPLES: &str = "\
Examples:
  cpdmp learn demonstrations --out skill.json
  cpdmp learn demonstrations --theta start --align --cross-validate
  cpdmp learn demonstrations --states 12 --set compliance.threshold_m2=1e-4 --out skill.json
  cpdmp learn demonstrations --init skill.json --max-iterations 9 --tolerance 0 --out more.json

Without --out nothing is written. A file is replaced only when it is a skill. --set takes any key of [learning].";

pub(super) const GENERATE_EXAMPLES: &str = "\
Examples:
  cpdmp generate skill.json --theta height_m=0.2
  cpdmp generate skill.json --theta height_m=0.2 --start x_m=0.1 --duration 5 --out path.csv
  cpdmp generate skill.json --theta height_m=0.2 --covariance --until 1.2 --dt 0.02
  cpdmp generate skill.json --theta height_m=0.2 --deny-extrapolation 0.5

Without --out the samples go to stdout as CSV.";

pub(super) const INSPECT_EXAMPLES: &str = "\
Examples:
  cpdmp inspect skill.json
  cpdmp inspect demonstrations
  cpdmp inspect skill.json --format json";
