//! The report of `check` as JUnit, which every continuous integration reads: a suite per scenario, a case per criterion.
//!
//! A criterion that is not as expected is a `failure`; what could not be run at all is an `error`; what is only reported or cannot be judged is `skipped`.

use std::time::Duration;

use quick_junit::{NonSuccessKind, Property, Report, TestCase, TestCaseStatus, TestSuite};

use super::check_report::{CheckReport, Checked};
use super::{CriterionReport, Outcome, verdict};

/// The case that says whether there are answers at all: the scenario could be used, something was learned, the simulation stayed finite.
const COMPLETED: &str = "completed";

/// The report as an XML document.
#[must_use]
pub fn junit(report: &CheckReport) -> String {
    let mut document = Report::new("cpdmp check");
    document.set_time(seconds(report.wall_s));
    let alone = |name: &str| report.checks.iter().filter(|check| name_of(check) == name).count() == 1;
    document.add_test_suites(report.checks.iter().map(|check| {
        let name = name_of(check);
        suite(if alone(name) { name } else { &check.path }, check)
    }));
    document.to_string().expect("a string takes everything that is written to it")
}

/// What stands in the file until there is a verdict: an error, for who reads it then reads of a check that did not come to its end.
#[must_use]
pub fn junit_without_verdict() -> String {
    let message = "the check did not come to its end: what it wrote to its standard error says why";
    let status = not_success(NonSuccessKind::Error, "no_verdict", message);
    let mut suite = TestSuite::new("cpdmp check");
    suite.add_test_case(TestCase::new(COMPLETED, status));
    let mut document = Report::new("cpdmp check");
    document.add_test_suite(suite);
    document.to_string().expect("a string takes everything that is written to it")
}

fn seconds(wall_s: f64) -> Duration {
    Duration::from_secs_f64(wall_s.max(0.0))
}

/// The name of the scenario that was simulated; of anything else the path.
fn name_of(check: &Checked) -> &str {
    let simulated = check.report.as_ref().filter(|_| check.kind == "scenario");
    simulated.map_or(&check.path, |report| &report.scenario)
}

/// The suite of a check, under a name that no other suite of the document bears.
fn suite(name: &str, check: &Checked) -> TestSuite {
    let mut suite = TestSuite::new(name);
    suite.set_time(seconds(check.wall_s));
    suite.add_property(Property::new("file", &check.path));
    suite.add_property(Property::new("version", env!("CARGO_PKG_VERSION")));
    if let Some(report) = &check.report {
        suite.add_property(Property::new("seed", report.seed.to_string()));
        suite.add_properties(report.state_hash.iter().map(|hash| Property::new("state_hash", hash)));
    }
    let status = match check.error() {
        None => TestCaseStatus::success(),
        // What was run and judged, such as a run whose warnings are denied, is no error.
        Some(error) if check.outcome == Outcome::CriteriaNotMet => not_success(NonSuccessKind::Failure, "warnings", &error),
        Some(error) => not_success(NonSuccessKind::Error, check.outcome.name(), &error),
    };
    let mut completed = TestCase::new(COMPLETED, status);
    completed.set_classname(&check.path).set_time(seconds(check.wall_s));
    suite.add_test_case(completed);
    let warnings = check.warnings();
    if !warnings.is_empty() {
        suite.set_system_err(warnings.join("\n"));
    }
    suite.add_test_cases(check.criteria().map(|criterion| case(check, criterion)));
    suite
}

fn case(check: &Checked, criterion: &CriterionReport) -> TestCase {
    let status = match (criterion.required, criterion.as_expected) {
        (true, true) => TestCaseStatus::success(),
        (true, false) => {
            let contacts: String = check.refused_contacts().map(|contact| format!("\n{}", verdict::contact(contact))).collect();
            not_success(NonSuccessKind::Failure, "criterion", &format!("{}{contacts}", verdict::reason(criterion)))
        }
        (false, _) => {
            let mut status = TestCaseStatus::skipped();
            let told = verdict::numbers(criterion);
            status.set_message(if criterion.not_judged_because.is_some() { told } else { format!("only reported: {told}") });
            status
        }
    };
    let mut case = TestCase::new(&criterion.name, status);
    // What is learned and simulated serves all criteria: its time stands at the first case.
    case.set_classname(&check.path).set_time(Duration::ZERO);
    if let Some(place) = &criterion.place {
        case.extra.insert("file".into(), place.file.as_str().into());
        case.extra.insert("line".into(), place.line.to_string().into());
    }
    case.set_system_out(verdict::numbers(criterion));
    case
}

fn not_success(kind: NonSuccessKind, what: &str, message: &str) -> TestCaseStatus {
    let mut status = TestCaseStatus::non_success(kind);
    status.set_type(what).set_message(message.lines().next().unwrap_or_default()).set_description(message);
    status
}
