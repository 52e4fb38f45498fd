//! The result of a run in a few lines, for a page beside its pictures.

use super::{CriterionReport, RunReport, verdict};

/// How the run ended and what was asked of it, in plain text: scenario, seed and outcome; what the scenario shows, in its own words; then each criterion
/// that does not hold, or need not, in a line of its own; then those that must hold and do.
pub fn summary(report: &RunReport, description: &str) -> String {
    let mut lines = vec![format!("{}, seed {}: {}", report.scenario, report.seed, report.outcome.name().replace('_', " "))];
    lines.extend((!description.is_empty()).then(|| description.to_owned()));
    lines.extend(report.error.clone());
    let (plain, others): (Vec<_>, Vec<_>) = report.criteria.iter().partition(|criterion| verdict::words(criterion) == verdict::OK);
    lines.extend(others.into_iter().map(criterion));
    if !plain.is_empty() {
        let names: Vec<&str> = plain.iter().map(|criterion| criterion.name.as_str()).collect();
        lines.push(format!("{}: {}", verdict::OK, names.join(", ")));
    }
    // What a planar experiment touches is in its comparison.
    let refused = report.collisions.iter().filter(|contact| !contact.allowed).count();
    lines.extend((report.comparison.is_none() && refused > 0).then(|| format!("contacts not allowed: {refused}")));
    lines.join("\n")
}

/// Why it fails, or that it does not hold and need not: `toy_in_basket fails, as expected`.
fn criterion(criterion: &CriterionReport) -> String {
    match criterion.fails() {
        true => format!("{} FAILED: {}", criterion.name, verdict::reason(criterion)),
        false => format!("{} {}", criterion.name, verdict::words(criterion).trim_start_matches("ok: ")),
    }
}
