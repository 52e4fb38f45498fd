//! What was executed beside a run: its answers to the run's questions, for comparison.

use schemars::JsonSchema;
use serde::Serialize;

use super::table::{figure, table};
use super::{CriterionReport, sections};
use crate::check::Criterion;
use crate::simulation::Beside;

/// One execution beside the run. The outcome of the run does not depend on it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct BesideReport {
    /// Its name.
    pub name: String,
    /// What it changes of the scenario, as `KEY=VALUE` each.
    pub changes: Vec<String>,
    /// Its answers to the scenario's questions. None is required.
    pub criteria: Vec<CriterionReport>,
    /// Hash over every body's state at every step of its execution.
    pub state_hash: String,
    /// Engine steps of its execution.
    pub steps: u64,
}

impl BesideReport {
    /// The report of an execution and its answers.
    pub fn of(beside: &Beside, criteria: &[Criterion]) -> Self {
        let answer = |criterion: &Criterion| CriterionReport { required: false, as_expected: true, ..sections::criterion(criterion) };
        Self {
            name: beside.name.clone(),
            changes: beside.changes.clone(),
            criteria: criteria.iter().map(answer).collect(),
            state_hash: format!("{:016x}", beside.outcome.state_hash),
            steps: beside.outcome.phases.iter().map(|phase| phase.steps).sum(),
        }
    }
}

/// One row per question, one column for the run and one for everything beside it.
pub(super) fn lines(run: &[CriterionReport], beside: &[BesideReport]) -> Vec<String> {
    if beside.is_empty() || run.is_empty() {
        return Vec::new();
    }
    let heading = ["beside (not judged)", "run"].map(str::to_owned).into_iter().chain(beside.iter().map(|one| one.name.clone()));
    let row = |index: usize| {
        let answers = std::iter::once(run).chain(beside.iter().map(|one| &one.criteria[..]));
        let cells = answers.map(|criteria| criteria.get(index).map_or(String::new(), cell));
        std::iter::once(run[index].name.clone()).chain(cells).collect()
    };
    let mut lines = table(&std::iter::once(heading.collect()).chain((0..run.len()).map(row)).collect::<Vec<_>>());
    lines.push(String::new());
    lines.extend(beside.iter().map(|one| format!("  {}: {}", one.name, one.changes.join(", "))));
    lines.push(String::new());
    lines
}

/// A value, and whether the criterion holds.
fn cell(criterion: &CriterionReport) -> String {
    let unit = if criterion.unit == "1" { String::new() } else { format!(" {}", criterion.unit) };
    let value = criterion.value.map_or("-".to_owned(), |value| format!("{}{unit}", figure(value)));
    format!("{value} {}", if criterion.passed { "holds" } else { "fails" })
}
