//! The report of `check` for people: one table for all, and below it what is not as expected.

use super::check_report::{CheckReport, Checked};
use super::table::{figure, table};
use super::text::{BOLD, GREEN, PLAIN, RED};
use super::{AnswerStatus, ClearanceReport, CriterionReport, Outcome, verdict};

/// The report as text with ANSI colours, which the terminal strips where they are not wanted. `all_contacts` lists those that are allowed too.
#[must_use]
pub fn check_text(report: &CheckReport, all_contacts: bool) -> String {
    let heading = ["check", "seed", "outcome", "as expected", "smallest margin", "nearest", "refused contacts", "wall"];
    let rows = std::iter::once(heading.map(str::to_owned).to_vec()).chain(report.checks.iter().map(row));
    let mut lines = table(&rows.collect::<Vec<_>>());
    lines.push(String::new());
    for check in report.checks.iter().filter(|check| check.outcome != Outcome::Passed) {
        lines.extend(complaint(check));
        lines.push(String::new());
    }
    for check in &report.checks {
        lines.extend(not_judged(check));
    }
    for check in report.checks.iter().filter(|_| all_contacts) {
        lines.extend(allowed_contacts(check));
    }
    // Of paths in a plane no pairs are looked at.
    let pairs = report.checks.iter().filter_map(|check| check.report.as_ref()).any(|report| !report.clearance.is_empty());
    lines.extend(pairs.then(|| NOT_WATCHED.to_owned()));
    lines.push(summary(report));
    lines.join("\n") + "\n"
}

/// The pairs that no check looks at, by design.
const NOT_WATCHED: &str =
    "not looked at: links of one arm against each other, links that overlap the torso by construction, parts of one object";

fn row(check: &Checked) -> Vec<String> {
    let dash = || "-".to_owned();
    let outcome = check.outcome.name().replace('_', " ");
    let wall = format!("{:.1} s", check.wall_s);
    let Some(report) = &check.report else {
        return vec![check.path.clone(), dash(), outcome, dash(), dash(), dash(), dash(), wall];
    };
    let required = report.criteria.iter().filter(|criterion| criterion.required);
    let met = required.clone().filter(|criterion| criterion.as_expected).count();
    vec![
        check.path.clone(),
        report.seed.to_string(),
        outcome,
        format!("{met} of {}", required.count()),
        tightest(&report.criteria).unwrap_or_else(dash),
        nearest(&report.clearance).unwrap_or_else(dash),
        check.refused_contacts().count().to_string(),
        wall,
    ]
}

/// The required criterion that comes nearest to its limit, or lies furthest beyond it, relative to the limit.
fn tightest(criteria: &[CriterionReport]) -> Option<String> {
    let expected = criteria.iter().filter(|criterion| criterion.required && criterion.expect == "pass");
    let relative = |criterion: &CriterionReport| {
        let (margin, limit) = (criterion.margin?, criterion.limit?);
        (limit != 0.0).then(|| margin / limit.abs())
    };
    let rated = expected.filter_map(|criterion| Some((criterion, relative(criterion)?)));
    let (criterion, _) = rated.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let margin = criterion.margin?;
    let unit = if criterion.unit == "1" { "" } else { &*criterion.unit };
    let sign = if margin < 0.0 { "" } else { "+" };
    Some(format!("{} {sign}{} {unit}", criterion.name, figure(margin)).trim_end().to_owned())
}

fn nearest(clearances: &[ClearanceReport]) -> Option<String> {
    // What was touched is told among the contacts.
    let measured = clearances.iter().filter_map(|clearance| Some((clearance, clearance.min_distance_m.filter(|&m| m > 0.0)?)));
    let (clearance, distance) = measured.min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(format!("{} - {} {:.1} mm", clearance.a, clearance.b, distance * 1e3))
}

/// Everything about a check that is not as expected.
fn complaint(check: &Checked) -> Vec<String> {
    let seed = check.report.as_ref().map_or(String::new(), |report| format!(", seed {}", report.seed));
    let mut lines = vec![format!("{BOLD}{}{PLAIN}{seed}: {RED}{}{PLAIN}", check.path, check.outcome.name().replace('_', " "))];
    lines.extend(check.error().map(|error| format!("  {}", error.replace('\n', "\n  "))));
    for criterion in check.criteria().filter(|criterion| criterion.fails()) {
        let place = criterion.place.as_ref().map_or(String::new(), |place| format!("{}:{}:{}: ", place.file, place.line, place.column));
        lines.push(format!("  {place}{RED}{}{PLAIN} {}", criterion.name, verdict::reason(criterion)));
    }
    lines.extend(check.refused_contacts().map(|contact| format!("  {}", verdict::contact(contact))));
    lines
}

/// The criteria of a check that it did not judge itself: as the run recorded them, or why there is no answer.
fn not_judged(check: &Checked) -> Vec<String> {
    let others: Vec<_> = check.criteria().filter(|criterion| criterion.status != AnswerStatus::Judged).collect();
    if others.is_empty() {
        return Vec::new();
    }
    let mut lines = vec![format!("{BOLD}{}{PLAIN}: not judged here", check.path)];
    lines.extend(others.iter().map(|criterion| format!("  {}  {}", criterion.name, verdict::numbers(criterion))));
    lines.push(String::new());
    lines
}

/// The contacts of a check that are allowed, each with the reason.
fn allowed_contacts(check: &Checked) -> Vec<String> {
    let allowed: Vec<_> = check.report.iter().flat_map(|report| &report.collisions).filter(|contact| contact.allowed).collect();
    if allowed.is_empty() {
        return Vec::new();
    }
    let mut lines = vec![format!("{BOLD}{}{PLAIN}: contacts that are allowed", check.path)];
    lines.extend(allowed.iter().map(|contact| format!("  {}; {}", verdict::contact(contact), verdict::permission(contact))));
    lines.push(String::new());
    lines
}

fn summary(report: &CheckReport) -> String {
    let passed = report.checks.iter().filter(|check| check.outcome == Outcome::Passed).count();
    let colour = if passed == report.checks.len() { GREEN } else { RED };
    format!("{colour}{passed} of {} as expected{PLAIN}, {:.1} s", report.checks.len(), report.wall_s)
}
