//! `cpdmp check` of stored runs: what a run said of itself is never forgotten, and nothing that was asked is left out in silence.

use quick_junit::{NonSuccessKind, Report, TestCaseStatus};
use serde_json::Value;

use super::program::Said;
use super::{Folder, GOOD};

fn checked(said: &Said) -> Value {
    let report: Value = serde_json::from_str(&said.stdout).unwrap_or_else(|error| panic!("{error}: {}{}", said.stdout, said.stderr));
    report["checks"][0].clone()
}

fn criterion<'a>(check: &'a Value, name: &str) -> &'a Value {
    let criteria = check["report"]["criteria"].as_array().expect("a list");
    criteria.iter().find(|one| one["name"] == name).unwrap_or_else(|| panic!("no {name} in {check:#}"))
}

/// The kind of a case in the first suite; `None` when it is a success.
fn kind(junit: &str, case: &str) -> Option<String> {
    let report = Report::deserialize_from_str(junit).expect("JUnit");
    let suite = &report.test_suites[0];
    let case = suite.test_cases.iter().find(|one| one.name.as_str() == case).unwrap_or_else(|| panic!("no case {case} in {suite:?}"));
    match &case.status {
        TestCaseStatus::Success { .. } => None,
        TestCaseStatus::NonSuccess { kind: NonSuccessKind::Failure, .. } => Some("failure".to_owned()),
        TestCaseStatus::NonSuccess { kind: NonSuccessKind::Error, .. } => Some("error".to_owned()),
        TestCaseStatus::Skipped { message, .. } => Some(format!("skipped: {}", message.as_deref().unwrap_or_default())),
    }
}

/// Contract: a run that did not show what it must is not green when its folder is checked, whether or not geometry can tell, and no flag makes it
/// better than it was.
#[test]
fn a_run_that_failed_is_not_green_when_it_is_checked() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    assert_eq!(folder.call(&["run", "a.toml", "--set", "criterion.goal.max_m=0", "--out", "out", "-q"]).code, Some(10));
    let said = folder.call(&["check", "out", "--format", "json", "-q", "--junit", "j.xml"]);
    assert_eq!(said.code, Some(10), "{}{}", said.stdout, said.stderr);
    let check = checked(&said);
    assert_eq!(check["outcome"], "criteria_not_met");
    let goal = criterion(&check, "goal");
    assert_eq!((&goal["status"], &goal["as_expected"], &goal["limit"]), (&"recorded".into(), &false.into(), &0.0.into()), "{goal}");
    assert!(goal["value"].as_f64().is_some_and(|value| value > 0.0) && goal["place"]["line"].is_number(), "{goal}");
    assert_eq!(criterion(&check, "recorded_criteria")["value"], 1.0);
    let junit = std::fs::read_to_string(folder.path().join("j.xml")).expect("written");
    assert_eq!((kind(&junit, "completed"), kind(&junit, "goal").as_deref()), (None, Some("failure")));
    let said = folder.call(&["check", "out"]);
    assert!(said.stdout.contains("goal fails") && said.stdout.contains("(as the run recorded it)"), "{}", said.stdout);

    // Another limit is another scenario: the old answer says nothing about it.
    let changed = ["check", "out", "--set", "criterion.goal.max_m=1"];
    let said = folder.call(&[&changed[..], &["--format", "json", "-q"]].concat());
    let check = checked(&said);
    assert_eq!(said.code, Some(10), "{check:#}");
    let goal = criterion(&check, "goal");
    assert_eq!((&goal["status"], &goal["required"]), (&"not_judged".into(), &false.into()));
    assert!(goal["not_judged_because"].as_str().is_some_and(|reason| reason.contains("another scenario")), "{goal}");
    let junit = folder.call(&[&changed[..], &["--format", "junit", "-q"]].concat()).stdout;
    assert!(kind(&junit, "goal").is_some_and(|told| told.starts_with("skipped: not judged: ")), "{junit}");
    assert_eq!(kind(&junit, "recorded_criteria").as_deref(), Some("failure"));
}

/// Contract: a run that ended before its time ends its check as it ended itself, with the reason; of its criteria none is judged.
#[test]
fn a_run_that_was_cut_short_ends_its_check_as_it_ended() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    assert_eq!(folder.call(&["run", "a.toml", "--out", "taught", "-q"]).code, Some(0));
    let endless = ["--set", "execution.duration_s=600", "--set", "execution.settle_s=60", "--timeout", "3"];
    let taught = ["run", "a.toml", "--set", "demonstrations=taught/demonstrations", "-q"];
    let unlearned = ["--set", "learning.motion.states=200", "--set", "learning.rate_hz=1"];
    let early = ["run", "a.toml", "-q", "--timeout", "0.02"];
    let runs = [
        ([&taught[..], &endless[..]].concat(), 12, "time_limit", "`execute`", true),
        (early.to_vec(), 12, "time_limit", "`teach`", false),
        ([&["run", "a.toml", "-q"][..], &unlearned[..]].concat(), 4, "learning_failed", "200 states", false),
    ];
    for (arguments, code, outcome, reason, has_log) in runs {
        let said = folder.call(&[&arguments[..], &["--out", "out"]].concat());
        assert_eq!(said.code, Some(code), "{}{}", said.stdout, said.stderr);
        assert_eq!(folder.path().join("out/steps.parquet").is_file(), has_log, "{arguments:?}");
        let said = folder.call(&["check", "out", "--format", "json", "-q", "--junit", "j.xml"]);
        assert_eq!(said.code, Some(code), "{}{}", said.stdout, said.stderr);
        let check = checked(&said);
        assert_eq!((&check["outcome"], &check["exit_code"]), (&outcome.into(), &code.into()));
        let error = check["report"]["error"].as_str().expect("a reason");
        assert!(error.contains("the run ended with") && error.contains(reason), "{error}");
        assert_eq!(criterion(&check, "goal")["status"], "not_judged");
        let names: Vec<&str> =
            check["report"]["criteria"].as_array().expect("a list").iter().filter_map(|one| one["name"].as_str()).collect();
        assert_eq!(names.contains(&"joint_limits"), has_log, "what the log holds is judged: {names:?}");
        let junit = std::fs::read_to_string(folder.path().join("j.xml")).expect("written");
        assert_eq!(kind(&junit, "completed").as_deref(), Some("error"), "{junit}");
        assert!(
            kind(&junit, "goal").is_some_and(|told| told.starts_with("skipped: not judged: the run did not come to its end")),
            "{junit}"
        );
    }
}

/// Contract: of a run whose own report is lost or damaged nothing is known, and nothing is green.
#[test]
fn a_run_without_its_report_is_refused() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    assert_eq!(folder.call(&["run", "a.toml", "--out", "out", "-q"]).code, Some(0));
    let report = folder.path().join("out/report.json");
    for damage in [Some("{\n\"outcome\": \"fine\"}"), Some("{}"), None] {
        match damage {
            Some(text) => std::fs::write(&report, text).expect("written"),
            None => std::fs::remove_file(&report).expect("removed"),
        }
        let said = folder.call(&["check", "out"]);
        assert!(said.code == Some(3) && said.stdout.contains("out/report.json"), "{damage:?}: {}{}", said.stdout, said.stderr);
    }
}

/// Contract: a planar run, of which nothing is judged again, is told as it ended, criterion by criterion.
#[test]
fn a_planar_run_is_told_as_it_ended() {
    const PLANAR: &str = include_str!("../../scenarios/obstacle_avoidance.toml");
    let folder = Folder::with(&[("a.toml", PLANAR.as_bytes())]);
    assert_eq!(folder.call(&["run", "a.toml", "--out", "out", "-q"]).code, Some(0));
    let said = folder.call(&["check", "out", "--format", "json", "-q"]);
    assert_eq!(said.code, Some(0), "{}{}", said.stdout, said.stderr);
    let check = checked(&said);
    let criteria = check["report"]["criteria"].as_array().expect("a list").clone();
    assert!(criteria.len() > 1 && criteria.iter().all(|one| one["status"] == "recorded"), "{check:#}");
}
