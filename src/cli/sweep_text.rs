//! A sweep for people.

use crate::batch::{CriterionSummary, Summary};
use crate::report::{figure, table};

/// The summary as text.
pub(super) fn text(scenario: &str, summary: &Summary) -> String {
    let ended: Vec<String> = summary.outcomes.iter().map(|(name, count)| format!("{count} {}", name.replace('_', " "))).collect();
    let runs = if summary.runs == 1 { "run" } else { "runs" };
    let mut lines =
        vec![format!("{scenario}, {} {runs}: {}", summary.runs, if ended.is_empty() { "-".to_owned() } else { ended.join(", ") })];
    if !summary.criteria.is_empty() {
        lines.push(String::new());
        let heading = ["criterion", "holds", "as expected", "worst margin", "in member"].map(str::to_owned).to_vec();
        lines.extend(table(&std::iter::once(heading).chain(summary.criteria.iter().map(row)).collect::<Vec<_>>()));
    }
    if let Some(failure) = &summary.first_failure {
        lines.push(String::new());
        lines.push(format!("  the first that did not pass is member {}: {}", failure.index, failure.reason));
        lines.push(format!("  {}", failure.command));
    }
    lines.join("\n") + "\n"
}

fn row(criterion: &CriterionSummary) -> Vec<String> {
    let unit = if criterion.unit == "1" { String::new() } else { format!(" {}", criterion.unit) };
    let of = |count: u64| format!("{count} of {}", criterion.answered);
    vec![
        criterion.name.clone(),
        of(criterion.passed),
        of(criterion.as_expected),
        criterion.worst_margin.map_or("-".to_owned(), |margin| format!("{}{unit}", figure(margin))),
        criterion.worst_index.map_or("-".to_owned(), |index| index.to_string()),
    ]
}
