//! From a path to a checked scenario.

use std::cmp::Ordering;
use std::path::{Path, PathBuf};

use super::beside;
use super::build;
use super::build_criteria;
use super::build_planar;
use super::check_overrides;
use super::check_planar;
use super::checks;
use super::conform::Conform;
use super::diagnostic::{Diagnostic, InvalidScenario, diagnose, in_order};
use super::fault::{Code, Fault, Severity, deny_warnings, tolerate_unknown_keys};
use super::layer;
use super::overrides;
use super::places::Places;
use super::resolved;
use super::roots::Roots;
use super::schema::{SCENARIO, SCHEMA_VERSION};
use super::source::Sources;
use super::sweep_checks;
use super::tree::{Node, Value};
use super::work::Work;
use crate::check::{AllowedContact, CriterionSpec};
use crate::simulation::Variation;

/// A scenario file, checked: everything in it makes sense on its own and together.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// What is run.
    pub work: Work,
    /// What the run must show.
    pub criteria: Vec<CriterionSpec>,
    /// What is executed beside it.
    pub beside: Vec<Variation>,
    /// Contacts that it allows beyond those that every scene allows.
    pub allowed_contacts: Vec<AllowedContact>,
    /// Where its parts were typed.
    pub places: Places,
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
    /// Steps between two hashes of the states; 0 keeps none.
    pub hash_every_steps: u64,
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
    /// Whether a key that nobody knows is a warning instead of an error.
    pub lenient: bool,
    /// Whether what would be a warning is an error.
    pub deny_warnings: bool,
}

impl LoadOptions {
    /// The same without anything that makes another scenario of the file's.
    #[must_use]
    pub fn without_overrides(&self) -> Self {
        Self { set: Vec::new(), seed: None, robot: None, deny_warnings: false, ..self.clone() }
    }
}

impl Scenario {
    /// Reads a scenario file, with what it extends and with overrides. All faults are found in one pass.
    pub fn load(path: &Path, options: &LoadOptions) -> Result<Self, InvalidScenario> {
        let mut sources = Sources::default();
        let mut faults = Vec::new();
        let layers = layered(path, options, &mut sources, &mut faults);
        let (filled, beside) = layers
            .map(|(tree, roots)| {
                let filled = fill(tree.clone(), &sources, &roots, &mut faults);
                let beside = beside::variations(&tree, &filled, &mut sources, &roots, &mut faults);
                (filled, beside)
            })
            .unzip();
        if options.lenient {
            tolerate_unknown_keys(&mut faults);
        }
        if options.deny_warnings {
            deny_warnings(&mut faults);
        }
        let scenario = Self::of(filled, faults, &sources)?;
        Ok(Self { beside: beside.unwrap_or_default(), ..scenario })
    }

    /// The same of a file all of which must be good: also the values that its `[[sweep]]` would give.
    ///
    /// # Errors
    /// What [`Scenario::load`] tells, and what keeps the sweep of the file from being run.
    pub fn load_with_sweep(path: &Path, options: &LoadOptions) -> Result<Self, InvalidScenario> {
        let of_sweep = sweep_checks::faults_of_file(path, options);
        match Self::load(path, options) {
            Ok(scenario) if of_sweep.iter().all(|found| found.severity == Severity::Warning) => Ok(scenario),
            Ok(scenario) => Err(InvalidScenario(in_order(scenario.warnings.into_iter().chain(of_sweep).collect()))),
            Err(invalid) => Err(InvalidScenario(in_order(invalid.0.into_iter().chain(of_sweep).collect()))),
        }
    }

    /// The scenario of a filled tree, unless there is none or something is wrong with it. What varies in sweeps or beside it is left aside.
    pub(super) fn of(filled: Option<Node>, faults: Vec<Fault>, sources: &Sources) -> Result<Self, InvalidScenario> {
        let diagnostics = diagnose(faults, sources);
        match filled {
            Some(mut filled) if diagnostics.iter().all(|found| found.severity == Severity::Warning) => {
                filled.take("sweep");
                Ok(Self {
                    work: work(&filled),
                    criteria: build_criteria::criteria(&filled),
                    beside: Vec::new(),
                    allowed_contacts: build_criteria::allowed_contacts(&filled),
                    recording: build::recording(&filled),
                    description: filled.text("description").to_owned(),
                    resolved: resolved::write(&check_planar::without_arm(filled.clone())),
                    places: Places::of(filled, sources.clone()),
                    files: sources.files(),
                    warnings: diagnostics,
                })
            }
            _ => Err(InvalidScenario(diagnostics)),
        }
    }
}

fn work(filled: &Node) -> Work {
    match filled.get("planar") {
        Some(_) => Work::Planar(Box::new(build_planar::planar(filled))),
        None => Work::Arm(Box::new(build::experiment(filled))),
    }
}

/// The tree of all layers, and the folders whose files it may use, unless its text or its version leave nothing to look at.
pub(super) fn layered(path: &Path, options: &LoadOptions, sources: &mut Sources, faults: &mut Vec<Fault>) -> Option<(Node, Roots)> {
    let directory = path.parent().unwrap_or(Path::new(""));
    let roots = Roots::new(directory, &options.asset_roots);
    let mut tree = layer::load(path, &roots, sources, faults)?;
    // Without a part of the text, most of what could be said about the rest would be wrong.
    if faults.iter().any(|fault| matches!(fault.code, Code::Syntax | Code::Extends | Code::OutsideRoot | Code::WrongType)) {
        return None;
    }
    for typed in &options.set {
        overrides::set(&mut tree, "--set", typed, sources, faults);
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
    Some((tree, roots))
}

/// The tree with every default filled in, held against the table of keys and checked as a whole.
pub(super) fn fill(mut tree: Node, sources: &Sources, roots: &Roots, faults: &mut Vec<Fault>) -> Node {
    only_latest(&mut tree, ["demonstrations", "teaching"], sources);
    let filled = Conform { sources, roots, faults }.table(tree, &SCENARIO, "");
    faults.extend(checks::check(&filled));
    check_overrides::parameters_without_effect(&filled, sources, faults);
    filled
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
pub(super) fn newer_version(tree: &Node) -> Option<Fault> {
    let node = tree.get("schema_version")?;
    let Value::Integer(version) = node.value else { return None };
    (version > SCHEMA_VERSION).then(|| {
        let message = format!("this scenario is written in version {version} of the language, this program reads version {SCHEMA_VERSION}");
        let help = format!("use a newer cpdmp, or rewrite the scenario for version {SCHEMA_VERSION}");
        Fault::at(Code::Version, node.origin, message).expected(format!("{SCHEMA_VERSION}")).help(help)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learning::LearningSettings;
    use crate::learning::cpdmp::CouplingSettings;
    use crate::planar::{ObstacleAvoidanceSettings, TwoSidedObstacleSettings};
    use crate::scenario::PlanarPlan;
    use crate::simulation::Experiment;
    use crate::world::{HumanSettings, PhysicsSettings, SensorSettings};

    /// A scenario with nothing but what must be typed.
    const BARE: &str = r#"
        schema_version = 1
        name = "bare"
        [teaching]
        waypoint = [{ time_s = 0.0 }, { time_s = 28.0 }]
    "#;

    fn load(text: &str) -> Scenario {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("scenario.toml");
        std::fs::write(&path, text).expect("written");
        Scenario::load(&path, &LoadOptions::default()).expect("a good scenario")
    }

    fn arm(scenario: Scenario) -> Experiment {
        let Work::Arm(experiment) = scenario.work else { panic!("no arm") };
        *experiment
    }

    #[test]
    fn the_defaults_of_the_language_are_those_of_the_rooms() {
        let experiment = arm(load(BARE));
        assert_eq!(experiment.learning, LearningSettings::default());
        assert_eq!(experiment.execution.coupling, CouplingSettings::default());
        assert_eq!(experiment.human, HumanSettings::default());
        assert_eq!(experiment.robot.sensor, SensorSettings::default());
        assert_eq!(experiment.physics, PhysicsSettings::default());
    }

    /// The experiment of a file with nothing but `[planar]` and its kind, and `more`.
    fn plane(kind: &str, more: &str) -> PlanarPlan {
        let Work::Planar(run) = load(&format!("schema_version = 1\nname = \"plane\"\n[planar]\nkind = \"{kind}\"\n{more}")).work else {
            panic!("no plane")
        };
        run.plan
    }

    /// Learning has defaults of its own, which every scenario shares; with the learning of the experiment typed out, all is the same.
    #[test]
    fn the_defaults_of_planar_experiments_are_those_of_their_room() {
        let (avoidance, two_sided) = (ObstacleAvoidanceSettings::default(), TwoSidedObstacleSettings::default());
        let motion = "[learning.motion]\nkmeans_starts = 0\n";
        for (typed, ridge) in [("", None), (&format!("{motion}ridge = 0.01"), Some(0.01))] {
            let PlanarPlan::ObstacleAvoidance(found) = plane("obstacle_avoidance", typed) else { panic!("another experiment") };
            let learning = if ridge.is_some() { avoidance.learning.clone() } else { LearningSettings::default() };
            assert_eq!(*found, ObstacleAvoidanceSettings { learning, ..avoidance.clone() });
        }
        let PlanarPlan::TwoSidedObstacle(found) = plane("two_sided_obstacle", "") else { panic!("another experiment") };
        assert_eq!(*found, TwoSidedObstacleSettings { learning: LearningSettings::default(), ..two_sided.clone() });
        let PlanarPlan::TwoSidedObstacle(found) = plane("two_sided_obstacle", motion) else { panic!("another experiment") };
        assert_eq!(*found, two_sided);
    }

    /// Contract: the resolved scenario says all that there is to say. It holds every kind of object, help and criterion once.
    #[test]
    fn the_resolved_scenario_means_the_same() {
        let rich = r#"
            [parameters]
            height_m = 0.2
            [[object]]
            name = "table"
            kind = "table"
            center_m = [0.6, 0.2]
            size_m = [1, 1]
            top_height_m = -0.1
            [[object]]
            name = "block"
            kind = "u_block"
            center_m = [0.6, 0.2]
            base_height_m = "height_m"
            aperture_m = 0.2
            post_height_m = 0.1
            [[object]]
            name = "toy"
            kind = "ball"
            center_m = [0.6, 0.0]
            radius_m = 0.03
            mass_kg = 0.05
            [[object]]
            name = "parcel"
            kind = "box"
            center_m = [0.6, 0.1]
            size_m = [0.1, 0.1, 0.1]
            mass_kg = 1
            [[object]]
            name = "basket"
            kind = "basket"
            center_m = [0.6, -0.2]
            inner_size_m = [0.2, 0.2]
            wall_height_m = 0.1
            [[object]]
            name = "cabinet"
            kind = "cabinet"
            center_m = [1.5, 0.6]
            door_size_m = [0.5, 0.4]
            bottom_height_m = 0.1
            handle_lateral_m = "height_m"
            grip = "contact"
            [[object]]
            name = "peg"
            kind = "cylinder"
            center_m = [0.6, 0.4]
            raised_m = "height_m"
            radius_m = 0.02
            height_m = 0.1
            fixed = true
            [[object]]
            name = "mat"
            kind = "spring_plate"
            center_m = [0.8, 0.1]
            yaw_rad = 0.5
            size_m = [0.1, 0.1, 0.02]
            [robot.sensor]
            filter_cutoff_hz = inf
            [learning.compliance]
            threshold_m2 = "automatic"
            [human.help]
            kind = "push"
            force_n = [10, 0, 0]
            windows_s = [[1, 2], [3, 4.5]]
            [[allowed_contact]]
            name = "leaning"
            a = "left_hand"
            b = "table"
        "#;
        let criteria = [
            "object_in_container\"\nobject = \"toy\"\ncontainer = \"basket\"",
            "no_contact\"\nobjects = [\"block\"]",
            "door_open\"\nobject = \"cabinet\"\nmin_rad = 0.9",
            "arc_followed\"\nobject = \"cabinet\"\nof = \"reference\"\nmax_m = 0.01",
            "hook_kept\"\nobject = \"cabinet\"\nmax_m = 0.01",
            "tool_force\"\nmean_over_s = 0.02\nmax_n = 20",
            "clearance\"\nobjects = [\"block\"]\nmin_m = 0.005",
            "clearance\"\nobjects = [\"table\"]\nlinks = [\"left_hand\"]\nmin_m = 0.01",
            "no_collision\"",
            "expected_force\"\naxis = \"y\"\nmax_n = 0.5",
            "object_at\"\nobject = \"toy\"\nat = \"basket\"\noffset_m = [0, 0, 0.1]\nmax_m = 0.02",
            "goal_reached\"\nmax_m = 0.02",
            "human_force\"\nmax_n = 15",
            "compliance_window\"\nstiff_at = [\"block\"]",
            "gripper_over_object\"\nobject = \"toy\"\nmax_m = 0.02",
            "reference_unmoved\"\nmax_m = 0",
            "gripper_unmoved\"\nmax_m = 0.015\nexpect = \"fail\"",
        ];
        let criteria = criteria.iter().enumerate().map(|(index, rest)| format!("[[criterion]]\nname = \"c{index}\"\nkind = \"{rest}\n"));
        let typed = load(&format!("{BARE}{rich}{}", criteria.collect::<String>()));
        let again = load(&typed.resolved);
        assert_eq!(again.resolved, typed.resolved);
        let meant = |scenario: &Scenario| {
            let Work::Arm(experiment) = &scenario.work else { panic!("it has an arm") };
            format!("{experiment:?}")
        };
        assert_eq!(meant(&again), meant(&typed));
        assert_eq!(again.criteria, typed.criteria);
        assert_eq!(again.allowed_contacts, typed.allowed_contacts);
        assert_eq!(typed.allowed_contacts.len(), 1);
        assert_eq!((typed.criteria.len(), arm(typed).objects.len()), (17, 8));
    }
}
