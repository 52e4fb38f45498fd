//! The result of a run in a few lines, for a page beside its pictures.

use super::{CriterionReport, RunReport, verdict};

/// How the run ended and what was asked of it, in plain text: scenario, seed and outcome; what the scenario shows, in its own words; each criterion
/// that is not as it should be, with the reason; then, each kind in a line, those that fail as expected, those of which nothing is demanded, and those that
/// hold, as they must.
pub fn summary(report: &RunReport, description: &str) -> String {
    let mut lines = vec![format!("{}, seed {}: {}", report.scenario, report.seed, report.outcome.name().replace('_', " "))];
    lines.extend((!description.is_empty()).then(|| description.to_owned()));
    lines.extend(report.error.clone());
    let criteria = &report.criteria;
    let failed = criteria.iter().filter(|criterion| criterion.fails());
    lines.extend(failed.map(|criterion| format!("{} FAILED: {}", criterion.name, verdict::reason(criterion))));
    let mut list = |title: &str, of: &dyn Fn(&CriterionReport) -> Option<String>| {
        let names: Vec<String> = criteria.iter().filter(|criterion| !criterion.fails()).filter_map(of).collect();
        lines.extend((!names.is_empty()).then(|| format!("{title}: {}", names.join(", "))));
    };
    list("fail, as expected", &|criterion| (criterion.required && !criterion.passed).then(|| criterion.name.clone()));
    list("only reported", &|criterion| (!criterion.required).then(|| format!("{} ({})", criterion.name, verdict::words(criterion))));
    list(verdict::OK, &|criterion| (criterion.required && criterion.passed).then(|| criterion.name.clone()));
    // What a planar experiment touches is in its comparison.
    let refused = report.collisions.iter().filter(|contact| !contact.allowed).count();
    lines.extend((report.comparison.is_none() && refused > 0).then(|| format!("contacts not allowed: {refused}")));
    lines.join("\n")
}
