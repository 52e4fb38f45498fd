//! `report.json`: everything a run has to say, as plain data.

use std::borrow::Cow;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{BesideReport, ComparisonReport, Outcome};
use super::{planar, sections};
use crate::check::{Criterion, Place};
use crate::planar::PlanarOutcome;
use crate::simulation::{Experiment, MotionOutcome, RunOutcome};

/// The version of `report.json`.
const SCHEMA_VERSION: u32 = 1;

/// The report of one run. Keys are only ever added; a number that does not exist is `null`.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct RunReport {
    /// Version of this format.
    pub schema_version: u32,
    /// Version of the program.
    pub version: &'static str,
    /// Name of the scenario.
    pub scenario: String,
    /// Its seed.
    pub seed: u64,
    /// How the run ended.
    pub outcome: Outcome,
    /// The exit code that belongs to it.
    pub exit_code: u8,
    /// Why the run could not be finished, if it could not.
    pub error: Option<String>,
    /// Name of the robot.
    pub robot: Option<String>,
    /// The setting in which the skill was executed.
    pub parameters: Vec<ParameterReport>,
    /// The scenario's questions and their answers.
    pub criteria: Vec<CriterionReport>,
    /// What was executed beside the run, for comparison. No part of the outcome.
    pub beside: Vec<BesideReport>,
    /// Every pair of parts that touched.
    pub collisions: Vec<CollisionReport>,
    /// The smallest distance between each part of the robot and each object, and whatever else came near.
    pub clearance: Vec<ClearanceReport>,
    /// What several methods made of the same settings; `null` for a run of an arm.
    pub comparison: Option<ComparisonReport>,
    /// Where the skill complies.
    pub compliance: Option<ComplianceReport>,
    /// What the person did.
    pub human: Option<HumanReport>,
    /// How learning went.
    pub learning: Option<LearningSection>,
    /// What was simulated, in order.
    pub phases: Vec<PhaseReport>,
    /// Engine steps of all phases.
    pub steps: u64,
    /// Simulated seconds per second of wall time, over the phases that simulate.
    pub real_time_factor: Option<f64>,
    /// Hash over every body's state at every step, or over every number of a planar experiment: equal hashes, equal runs.
    pub state_hash: Option<String>,
    /// What looks odd but did not stop the run.
    pub warnings: Vec<String>,
}

/// One task parameter.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ParameterReport {
    /// Its name, which ends in its unit.
    pub name: String,
    /// Its value.
    pub value: f64,
}

/// One question and its answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CriterionReport {
    /// Its name.
    pub name: String,
    /// Whether the outcome of the run depends on it.
    pub required: bool,
    /// The answer that the scenario expects: `pass`, `fail` or `report`.
    pub expect: Cow<'static, str>,
    /// Whether the criterion holds.
    pub passed: bool,
    /// Whether that is what the scenario expects.
    pub as_expected: bool,
    /// The measured value; `null` when the event it is about never happened.
    pub value: Option<f64>,
    /// The limit it is held against.
    pub limit: Option<f64>,
    /// Unit of value, limit and margin.
    pub unit: Cow<'static, str>,
    /// How far the value is on the right side of the limit.
    pub margin: Option<f64>,
    /// When it first failed (s).
    pub first_failed_time_s: Option<f64>,
    /// Where it was typed; `null` for one from the command line.
    pub place: Option<Place>,
    /// Whose answer it is.
    #[serde(default)]
    pub status: AnswerStatus,
    /// Why it was not judged; `null` when there is an answer.
    #[serde(default)]
    pub not_judged_because: Option<String>,
}

/// Whose answer the answer to a question is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AnswerStatus {
    /// It was judged for this report.
    #[default]
    Judged,
    /// A stored run gave it when it ran.
    Recorded,
    /// There is none. Nothing depends on it, unless a change of a stored run took it away: then a required one is not as expected.
    NotJudged,
}

/// All contacts of one pair.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CollisionReport {
    /// A part of the robot, or an object.
    pub a: String,
    /// The other one.
    pub b: String,
    /// Whether the scene allows it.
    pub allowed: bool,
    /// First time (s).
    pub first_time_s: f64,
    /// Last time (s).
    pub last_time_s: f64,
    /// Deepest penetration (m).
    pub max_depth_m: f64,
    /// When it was deepest (s).
    pub deepest_time_s: f64,
    /// Where: the middle of the two deepest points (m, world).
    pub deepest_point_m: [f64; 3],
    /// Largest normal force (N); `null` when it was not measured: nothing was simulated, or the touch began and ended within a step.
    pub max_force_n: Option<f64>,
    /// Why the contact is allowed; `null` when it is not.
    pub reason: Option<&'static str>,
    /// The key of the scenario that allows it (`object.toy`, `allowed_contact.leaning`).
    pub reason_key: Option<String>,
    /// Where that was typed.
    pub reason_place: Option<Place>,
}

/// The smallest distance to one object.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ClearanceReport {
    /// The nearest part of the robot, or what it holds.
    pub a: String,
    /// The object.
    pub b: String,
    /// The distance (m).
    pub min_distance_m: Option<f64>,
    /// When (s).
    pub time_s: f64,
    /// Nearest point on `a` (m, world).
    pub point_a_m: [f64; 3],
    /// Nearest point on `b` (m, world).
    pub point_b_m: [f64; 3],
}

/// Where the skill complies, and why.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ComplianceReport {
    /// The statistic that decides.
    pub statistic: &'static str,
    /// What it must exceed (m²); `null` when no threshold separates the states.
    pub threshold_m2: Option<f64>,
    /// Every state.
    pub states: Vec<ComplianceState>,
    /// When the skill complied during the execution.
    pub windows: Vec<Window>,
}

/// One state of the skill.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ComplianceState {
    /// Its number.
    pub index: usize,
    /// Its value of the statistic (m²).
    pub value_m2: Option<f64>,
    /// Its beta: 0 stiff, -1 complies.
    pub beta: f64,
}

/// A stretch of time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Window {
    /// Start (s).
    pub start_s: f64,
    /// End (s).
    pub end_s: f64,
}

/// What the person did while the skill was executed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct HumanReport {
    /// Largest force (N).
    pub peak_force_n: f64,
    /// Work done on the arm (J).
    pub work_j: f64,
    /// Time with the hand on the arm (s).
    pub contact_s: f64,
}

/// How learning went.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct LearningSection {
    /// Objective after every iteration of the start that was kept.
    pub log_likelihood: Vec<Option<f64>>,
    /// Number of states.
    pub states: usize,
    /// Number of starts.
    pub starts: usize,
    /// How it ended.
    pub status: &'static str,
    /// What it warns of.
    pub warnings: Vec<String>,
}

/// One phase of the run.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PhaseReport {
    /// Its name.
    pub name: String,
    /// Engine steps.
    pub steps: u64,
    /// Wall time (s).
    pub wall_s: f64,
}

impl CriterionReport {
    /// Whether it speaks against the run.
    pub fn fails(&self) -> bool {
        self.required && !self.as_expected
    }
}

impl RunReport {
    /// The report of a run that came to its end.
    pub fn finished(experiment: &Experiment, outcome: &RunOutcome, criteria: &[Criterion]) -> Self {
        let as_expected = criteria.iter().all(Criterion::as_expected);
        let steps = outcome.phases.iter().map(|phase| phase.steps).sum();
        let parameters = experiment.parameters.0.iter();
        Self {
            robot: Some(outcome.robot.name.clone()),
            criteria: criteria.iter().map(sections::criterion).collect(),
            collisions: outcome.collisions.iter().map(sections::collision).collect(),
            clearance: sections::clearances(&outcome.clearances, &experiment.objects),
            compliance: Some(sections::compliance(outcome)),
            human: Some(sections::human(&outcome.steps)),
            learning: Some(sections::learning(&outcome.learning)),
            phases: outcome.phases.iter().map(sections::phase).collect(),
            steps,
            real_time_factor: sections::real_time_factor(experiment.physics.step_s, &outcome.phases),
            state_hash: Some(format!("{:016x}", outcome.state_hash)),
            warnings: outcome.robot_warnings.iter().map(ToString::to_string).collect(),
            parameters: parameters.map(|(name, value)| ParameterReport { name: name.clone(), value: *value }).collect(),
            ..Self::empty(&experiment.name, experiment.seed, if as_expected { Outcome::Passed } else { Outcome::CriteriaNotMet })
        }
    }

    /// The report of a planar experiment, named `name`, that took `wall_s` (s).
    pub fn of_planar(name: &str, seed: u64, outcome: &PlanarOutcome, criteria: &[Criterion], wall_s: f64) -> Self {
        let as_expected = criteria.iter().all(Criterion::as_expected);
        Self {
            criteria: criteria.iter().map(sections::criterion).collect(),
            comparison: Some(ComparisonReport::of(outcome)),
            learning: outcome.models.first().map(planar::learning),
            phases: vec![PhaseReport { name: "learn".to_owned(), steps: 0, wall_s }],
            state_hash: Some(format!("{:016x}", planar::hash(outcome))),
            warnings: planar::warnings(outcome),
            ..Self::empty(name, seed, if as_expected { Outcome::Passed } else { Outcome::CriteriaNotMet })
        }
    }

    /// The report of a movement that was judged by geometry.
    pub fn of_motion(experiment: &Experiment, outcome: &MotionOutcome, criteria: &[Criterion]) -> Self {
        let as_expected = !criteria.iter().any(Criterion::fails);
        let parameters = experiment.parameters.0.iter();
        Self {
            criteria: criteria.iter().map(sections::criterion).collect(),
            collisions: outcome.collisions.iter().map(sections::collision).collect(),
            clearance: sections::clearances(&outcome.clearances, &experiment.objects),
            parameters: parameters.map(|(name, value)| ParameterReport { name: name.clone(), value: *value }).collect(),
            steps: outcome.samples as u64,
            warnings: outcome.robot_warnings.iter().map(ToString::to_string).chain(outcome.warnings.iter().cloned()).collect(),
            ..Self::empty(&experiment.name, experiment.seed, if as_expected { Outcome::Passed } else { Outcome::CriteriaNotMet })
        }
    }

    /// The report of a run that ended before its time, with what it showed up to its last good step. Its questions have no answers, and its
    /// states no hash: there is no whole run to compare with.
    pub fn cut_short(experiment: &Experiment, left: &RunOutcome, outcome: Outcome, error: &str) -> Self {
        let mut report = Self { error: Some(error.to_owned()), state_hash: None, ..Self::finished(experiment, left, &[]) };
        report.end_as(outcome);
        report
    }

    /// The report of a stored run of which nothing can be judged again.
    pub fn unjudged(name: &str, seed: u64, criteria: &[Criterion]) -> Self {
        Self { criteria: criteria.iter().map(sections::criterion).collect(), ..Self::empty(name, seed, Outcome::Passed) }
    }

    /// The same report with more criteria.
    #[must_use]
    pub fn with_criteria(mut self, criteria: &[Criterion]) -> Self {
        self.criteria.extend(criteria.iter().map(sections::criterion));
        self
    }

    /// The report of a run that could not be finished.
    pub fn failed(name: &str, seed: u64, outcome: Outcome, error: &str) -> Self {
        Self { error: Some(error.to_owned()), ..Self::empty(name, seed, outcome) }
    }

    /// Adds where things were typed; `find` knows the place of a key such as `criterion.goal`.
    pub fn locate(&mut self, find: impl Fn(&str) -> Option<Place>) {
        for criterion in &mut self.criteria {
            criterion.place = find(&format!("criterion.{}", criterion.name));
        }
        for contact in &mut self.collisions {
            contact.reason_place = contact.reason_key.as_deref().and_then(&find);
        }
    }

    /// Makes a run that warns of something one that is not as expected.
    pub fn deny_warnings(&mut self) {
        let learned = self.learning.iter().flat_map(|learning| &learning.warnings);
        let warnings: Vec<&str> = self.warnings.iter().chain(learned).map(String::as_str).collect();
        if let [first, others @ ..] = &warnings[..] {
            let more = if others.is_empty() { String::new() } else { format!(" (and {} more)", others.len()) };
            let denied = format!("--deny-warnings: {first}{more}");
            self.error.get_or_insert(denied);
            self.end_as(self.outcome.max(Outcome::CriteriaNotMet));
        }
    }

    /// The same report with another outcome.
    pub fn end_as(&mut self, outcome: Outcome) {
        self.outcome = outcome;
        self.exit_code = outcome.exit_code();
    }

    fn empty(name: &str, seed: u64, outcome: Outcome) -> Self {
        Self {
            schema_version: SCHEMA_VERSION,
            version: env!("CARGO_PKG_VERSION"),
            scenario: name.to_owned(),
            seed,
            outcome,
            exit_code: outcome.exit_code(),
            error: None,
            robot: None,
            parameters: Vec::new(),
            criteria: Vec::new(),
            beside: Vec::new(),
            collisions: Vec::new(),
            clearance: Vec::new(),
            comparison: None,
            compliance: None,
            human: None,
            learning: None,
            phases: Vec::new(),
            steps: 0,
            real_time_factor: None,
            state_hash: None,
            warnings: Vec::new(),
        }
    }

    /// The report as `report.json`.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a report holds nothing that JSON cannot") + "\n"
    }

    /// The report on one line.
    pub fn to_json_line(&self) -> String {
        serde_json::to_string(self).expect("a report holds nothing that JSON cannot")
    }
}
