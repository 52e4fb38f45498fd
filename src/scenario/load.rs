//! From a path to a checked scenario.

use std::cmp::Ordering;
use std::path::{Path, PathBuf};

use super::build;
use super::checks;
use super::conform::Conform;
use super::diagnostic::{Diagnostic, InvalidScenario, diagnose};
use super::fault::{Code, Fault, Severity};
use super::layer;
use super::overrides;
use super::resolved;
use super::roots::Roots;
use super::schema::{SCENARIO, SCHEMA_VERSION};
use super::source::Sources;
use super::tree::{Node, Value};
use crate::check::CriterionSpec;
use crate::simulation::Experiment;

/// A scenario file, checked: everything in it makes sense on its own and together.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// What is simulated.
    pub experiment: Experiment,
    /// What the run must show.
    pub criteria: Vec<CriterionSpec>,
    /// What is written to the run folder.
    pub recording: RecordingPlan,
    /// What it shows, in one line; may be empty.
    pub description: String,
    /// The scenario as TOML with every default written out; it can be run again.
    pub resolved: String,
    /// The files that it was read from: its own, and those that it extends.
    pub files: Vec<PathBuf>,
    /// What looks odd, but can be used.
    pub warnings: Vec<Diagnostic>,
}

/// What is written to the run folder besides the report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordingPlan {
    /// The recording for the rerun viewer.
    pub rrd: bool,
    /// One row per logged step.
    pub steps: bool,
    /// The dataset that was learned from.
    pub demonstrations: bool,
}

/// What the user says besides the file.
#[derive(Clone, Debug, Default)]
pub struct LoadOptions {
    /// `KEY=VALUE` each; a later one wins.
    pub set: Vec<String>,
    /// Replaces the scenario's seed.
    pub seed: Option<u64>,
    /// Replaces the scenario's robot: a URDF file, or `builtin:NAME`.
    pub robot: Option<String>,
    /// Further folders whose files the scenario may use.
    pub asset_roots: Vec<PathBuf>,
}

impl Scenario {
    /// Reads a scenario file, with what it extends and with overrides. All faults are found in one pass.
    pub fn load(path: &Path, options: &LoadOptions) -> Result<Self, InvalidScenario> {
        let mut sources = Sources::default();
        let mut faults = Vec::new();
        let scenario = read(path, options, &mut sources, &mut faults);
        let diagnostics = diagnose(faults, &sources);
        match scenario {
            Some(filled) if diagnostics.iter().all(|found| found.severity == Severity::Warning) => Ok(Self {
                experiment: build::experiment(&filled),
                criteria: build::criteria(&filled),
                recording: build::recording(&filled),
                description: filled.text("description").to_owned(),
                resolved: resolved::write(&filled),
                files: sources.files(),
                warnings: diagnostics,
            }),
            _ => Err(InvalidScenario(diagnostics)),
        }
    }
}

/// The filled tree, unless its text or its version leave nothing to look at.
fn read(path: &Path, options: &LoadOptions, sources: &mut Sources, faults: &mut Vec<Fault>) -> Option<Node> {
    let directory = path.parent().unwrap_or(Path::new(""));
    let roots = Roots::new(directory, &options.asset_roots);
    let mut tree = layer::load(path, &roots, sources, faults)?;
    if faults.iter().any(|fault| fault.code == Code::Syntax) {
        return None;
    }
    for typed in &options.set {
        overrides::set(&mut tree, typed, sources, faults);
    }
    if let Some(seed) = options.seed {
        let value = i64::try_from(seed).map_or(Value::Number(seed as f64), Value::Integer);
        overrides::flag(&mut tree, "--seed", &["seed"], (value, &seed.to_string()), sources, faults);
    }
    if let Some(robot) = &options.robot {
        overrides::flag(&mut tree, "--robot", &["robot", "urdf"], (Value::Text(robot.clone()), robot), sources, faults);
    }
    if let Some(fault) = newer_version(&tree) {
        *faults = vec![fault];
        return None;
    }
    only_latest(&mut tree, ["demonstrations", "teaching"], sources);
    let filled = Conform { sources, roots: &roots, faults }.table(tree, &SCENARIO, "");
    faults.extend(checks::check(&filled));
    Some(filled)
}

/// Of two keys that exclude each other, the one that was typed in a layer above the other's stays.
fn only_latest(tree: &mut Node, keys: [&str; 2], sources: &Sources) {
    let [Some(first), Some(second)] = keys.map(|key| tree.get(key).map(|node| sources.rank(node.origin))) else { return };
    match first.cmp(&second) {
        Ordering::Less => _ = tree.take(keys[0]),
        Ordering::Greater => _ = tree.take(keys[1]),
        Ordering::Equal => {}
    }
}

/// A file for a later program is refused before its keys are looked at: they may mean something else there.
fn newer_version(tree: &Node) -> Option<Fault> {
    let node = tree.get("schema_version")?;
    let Value::Integer(version) = node.value else { return None };
    (version > SCHEMA_VERSION).then(|| {
        let message = format!("this scenario is written in version {version} of the language, this program reads version {SCHEMA_VERSION}");
        let help = format!("use a newer cpdmp, or rewrite the scenario for version {SCHEMA_VERSION}");
        Fault::at(Code::Version, node.origin, message).expected(format!("{SCHEMA_VERSION}")).help(help)
    })
}
