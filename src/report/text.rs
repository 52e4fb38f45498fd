//! The report for people: what was asked, what came of it, what touched, what it took.

use super::table::figure;
use super::{ClearanceReport, CriterionReport, Outcome, RunReport, beside_section, comparison, verdict};

pub(super) const GREEN: &str = "\u{1b}[32m";
pub(super) const RED: &str = "\u{1b}[31m";
pub(super) const BOLD: &str = "\u{1b}[1m";
pub(super) const PLAIN: &str = "\u{1b}[0m";

/// The report as text with ANSI colours, which the terminal strips where they are not wanted.
pub fn text(report: &RunReport) -> String {
    let mut lines = vec![headline(report), String::new()];
    lines.extend(report.error.iter().map(|error| format!("{RED}{error}{PLAIN}\n")));
    if !report.criteria.is_empty() {
        lines.extend(criteria(&report.criteria));
        lines.push(String::new());
    }
    lines.extend(beside_section::lines(&report.criteria, &report.beside));
    if let Some(comparison) = &report.comparison {
        lines.extend(comparison::table(comparison));
        lines.push(String::new());
    }
    // Of an execution that ended before its time there is something to say, too.
    if report.error.is_none() || report.human.is_some() {
        // What a planar experiment touches is in its comparison.
        lines.extend(report.comparison.is_none().then(|| contacts(report)).into_iter().flatten());
        lines.extend(clearances(report));
        lines.extend(person(report));
        lines.extend(compliance(report));
        lines.extend(learning(report));
        lines.extend(phases(report));
    }
    lines.join("\n") + "\n"
}

fn headline(report: &RunReport) -> String {
    let colour = if report.outcome == Outcome::Passed { GREEN } else { RED };
    let verdict = report.outcome.name().replace('_', " ");
    format!("{BOLD}{}{PLAIN}, seed {}: {colour}{verdict}{PLAIN}", report.scenario, report.seed)
}

/// The table of criteria, its columns as wide as their widest entry.
fn criteria(criteria: &[CriterionReport]) -> Vec<String> {
    let heading = ["criterion", "expected", "value", "limit", "margin", ""].map(str::to_owned);
    let rows: Vec<[String; 6]> = std::iter::once(heading).chain(criteria.iter().map(row)).collect();
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: [usize; 6] = std::array::from_fn(width);
    let line = |(index, row): (usize, &[String; 6])| {
        let [name, expected, value, limit, margin, verdict] = row;
        let colour = if index == 0 { "" } else { verdict_colour(&criteria[index - 1]) };
        let end = if colour.is_empty() { "" } else { PLAIN };
        let [w0, w1, w2, w3, w4, _] = widths;
        format!("  {name:<w0$}  {expected:<w1$}  {value:>w2$}  {limit:>w3$}  {margin:>w4$}  {colour}{verdict}{end}").trim_end().to_owned()
    };
    rows.iter().enumerate().map(line).collect()
}

fn row(criterion: &CriterionReport) -> [String; 6] {
    let unit = if criterion.unit == "1" { String::new() } else { format!(" {}", criterion.unit) };
    let with_unit = |number: Option<f64>| number.map_or("-".to_owned(), |number| format!("{}{unit}", figure(number)));
    let margin =
        criterion.margin.map_or("-".to_owned(), |number| format!("{}{}{unit}", if number < 0.0 { "" } else { "+" }, figure(number)));
    let expected = if criterion.required { &*criterion.expect } else { "-" };
    [criterion.name.clone(), expected.to_owned(), with_unit(criterion.value), with_unit(criterion.limit), margin, verdict::words(criterion)]
}

fn verdict_colour(criterion: &CriterionReport) -> &'static str {
    match (criterion.required, criterion.as_expected) {
        (true, true) => GREEN,
        (true, false) => RED,
        (false, _) => "",
    }
}

fn contacts(report: &RunReport) -> Vec<String> {
    let refused: Vec<_> = report.collisions.iter().filter(|contact| !contact.allowed).collect();
    let mut lines =
        vec![format!("  contacts not allowed  {}", if refused.is_empty() { "none".to_owned() } else { refused.len().to_string() })];
    lines.extend(refused.iter().map(|contact| format!("    {RED}{}{PLAIN}", verdict::contact(contact))));
    lines
}

/// How many things the arm came nearest to are told.
const NEAREST: usize = 4;

/// The nearest part of the arm to everything that it came near but did not touch, the nearest first.
fn clearances(report: &RunReport) -> Vec<String> {
    let mut nearest: Vec<(&ClearanceReport, f64)> = Vec::new();
    for (clearance, distance) in report.clearance.iter().filter_map(|clearance| Some((clearance, clearance.min_distance_m?))) {
        match nearest.iter_mut().find(|(known, _)| known.b == clearance.b) {
            Some(known) if known.1 <= distance => {}
            Some(known) => *known = (clearance, distance),
            None => nearest.push((clearance, distance)),
        }
    }
    nearest.retain(|(_, distance)| *distance > 0.0);
    nearest.sort_by(|a, b| a.1.total_cmp(&b.1));
    let line = |(index, (clearance, distance)): (usize, &(&ClearanceReport, f64))| {
        let label = if index == 0 { "smallest clearance" } else { "" };
        format!("  {label:<20}  {} - {}  {:.1} mm at {:.2} s", clearance.a, clearance.b, distance * 1e3, clearance.time_s)
    };
    nearest.iter().take(NEAREST).enumerate().map(line).collect()
}

fn person(report: &RunReport) -> Option<String> {
    let human = report.human?;
    let told = if human.contact_s == 0.0 {
        "did not touch the arm".to_owned()
    } else {
        format!("at most {:.1} N, {:.2} J of work, {:.1} s in contact", human.peak_force_n, human.work_j, human.contact_s)
    };
    Some(format!("  person                {told}"))
}

fn compliance(report: &RunReport) -> Option<String> {
    let compliance = report.compliance.as_ref()?;
    let windows: Vec<String> = compliance.windows.iter().map(|window| format!("{:.2} … {:.2} s", window.start_s, window.end_s)).collect();
    let told = if windows.is_empty() { "never".to_owned() } else { windows.join(", ") };
    Some(format!("  complies              {told}"))
}

fn learning(report: &RunReport) -> Vec<String> {
    let Some(learning) = &report.learning else { return Vec::new() };
    let likelihood = learning.log_likelihood.last().copied().flatten();
    let models = match (learning.starts, likelihood) {
        (0, None) => String::new(),
        (0, Some(value)) => format!(", {} states, log-likelihood {}", learning.states, figure(value)),
        (starts, None) => format!(", {} states, best of {starts} starts", learning.states),
        (starts, Some(value)) => format!(", {} states, best of {starts} starts, log-likelihood {}", learning.states, figure(value)),
    };
    let mut lines = vec![format!("  learning              {}{models}", learning.status.replace('_', " "))];
    lines.extend(learning.warnings.iter().map(|warning| format!("    warning: {warning}")));
    lines
}

fn phases(report: &RunReport) -> Vec<String> {
    let each: Vec<String> = report.phases.iter().map(|phase| format!("{} {:.1} s", phase.name, phase.wall_s)).collect();
    let factor = report.real_time_factor.map_or(String::new(), |factor| format!("; {factor:.1} times real time"));
    let hash = report.state_hash.as_ref().map(|hash| format!("  state hash            {hash}"));
    let took = (!each.is_empty()).then(|| format!("  wall time             {}{factor}", each.join(", ")));
    took.into_iter().chain(hash).collect()
}
