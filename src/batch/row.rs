//! One row of a sweep: what a member was, and what came of it.

use serde::{Deserialize, Serialize};

use super::Cell;
use crate::report::{CriterionReport, Outcome, RunReport};
use crate::scenario::Member;

/// What one run of a sweep has to say. Nothing in it depends on the machine's speed, so equal runs give equal rows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The member's number, from 0.
    pub index: u64,
    /// Its seed.
    pub seed: u64,
    /// Its values of the keys that vary, in their order.
    pub settings: Vec<Cell>,
    /// How the run ended.
    pub outcome: String,
    /// The exit code of that.
    pub exit_code: u8,
    /// The answers to the scenario's questions, in their order; empty when the run did not come that far.
    pub criteria: Vec<CriterionCell>,
    /// Pairs of parts that touched although the scene does not allow it; `None` when nothing was simulated.
    pub collisions: Option<u64>,
    /// These pairs: `a - b; …`.
    pub collision_pairs: Option<String>,
    /// The smallest distance to any watched object (m).
    pub clearance_m: Option<f64>,
    /// Between whom: `a - b`.
    pub clearance_pair: Option<String>,
    /// The person's largest force (N).
    pub human_peak_force_n: Option<f64>,
    /// Engine steps.
    pub steps: u64,
    /// Hash over every state of the run.
    pub state_hash: Option<String>,
    /// Why it did not pass, if it did not.
    pub failure_reason: Option<String>,
    /// The command that runs this member alone.
    pub command: String,
}

/// The answer to one question.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CriterionCell {
    /// The measured value.
    pub value: Option<f64>,
    /// How far it is on the right side of its limit.
    pub margin: Option<f64>,
    /// Unit of both.
    pub unit: String,
    /// Whether the criterion holds.
    pub passed: bool,
    /// Whether that is what the scenario expects.
    pub as_expected: bool,
}

impl Row {
    /// The row of a member whose run ended with that report.
    pub fn of(member: &Member, report: &RunReport, command: String) -> Self {
        let finite = |number: Option<f64>| number.filter(|number| number.is_finite());
        let cell = |criterion: &CriterionReport| CriterionCell {
            value: finite(criterion.value),
            margin: finite(criterion.margin),
            unit: criterion.unit.to_string(),
            passed: criterion.passed,
            as_expected: criterion.as_expected,
        };
        let simulated = report.human.is_some();
        let touched = report.collisions.iter().filter(|pair| !pair.allowed);
        let pairs: Vec<String> = touched.map(|pair| format!("{} - {}", pair.a, pair.b)).collect();
        let near = report.clearance.iter().filter_map(|pair| Some((pair, finite(pair.min_distance_m)?)));
        let nearest = near.min_by(|a, b| a.1.total_cmp(&b.1));
        Self {
            index: member.index,
            seed: report.seed,
            settings: member.settings.iter().map(|(_, setting)| setting.into()).collect(),
            outcome: report.outcome.name().to_owned(),
            exit_code: report.exit_code,
            criteria: report.criteria.iter().map(cell).collect(),
            collisions: simulated.then_some(pairs.len() as u64),
            collision_pairs: simulated.then(|| pairs.join("; ")),
            clearance_m: nearest.map(|(_, distance)| distance),
            clearance_pair: nearest.map(|(pair, _)| format!("{} - {}", pair.a, pair.b)),
            human_peak_force_n: report.human.and_then(|human| finite(Some(human.peak_force_n))),
            steps: report.steps,
            state_hash: report.state_hash.clone(),
            failure_reason: reason(report),
            command,
        }
    }
}

/// Why a run did not pass, in one line.
fn reason(report: &RunReport) -> Option<String> {
    if report.outcome == Outcome::Passed {
        return None;
    }
    if let Some(error) = &report.error {
        return Some(error.lines().collect::<Vec<_>>().join("; "));
    }
    let wrong = report.criteria.iter().filter(|criterion| criterion.required && !criterion.as_expected);
    Some(wrong.map(told).collect::<Vec<_>>().join("; "))
}

fn told(criterion: &CriterionReport) -> String {
    let unit = if criterion.unit == "1" { String::new() } else { format!(" {}", criterion.unit) };
    let number = |number: Option<f64>| number.map_or("nothing".to_owned(), |number| format!("{number}{unit}"));
    let verdict = if criterion.passed { "holds, but should not" } else { "does not hold" };
    let when = criterion.first_failed_time_s.map_or(String::new(), |time| format!(" at {time} s"));
    format!("{} {verdict}{when}: {}, limit {}", criterion.name, number(criterion.value), number(criterion.limit))
}
