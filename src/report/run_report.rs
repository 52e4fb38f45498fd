//! `report.json`: everything a run has to say, as plain data.

use schemars::JsonSchema;
use serde::Serialize;

use super::{BesideReport, ClearanceReport, CollisionReport, ComparisonReport, ComplianceReport, CriterionReport, HumanReport, Outcome};
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

impl RunReport {
    /// What looks odd about the run and what it learned.
    pub fn warnings(&self) -> impl Iterator<Item = &str> {
        let learned = self.learning.iter().flat_map(|learning| &learning.warnings);
        self.warnings.iter().chain(learned).map(String::as_str)
    }

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
            warnings: outcome.warnings.clone(),
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
        let warnings: Vec<&str> = self.warnings().collect();
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
