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

    // The value is held against another limit, which does not make the run better than it was.
    let changed = ["check", "out", "--set", "criterion.goal.max_m=1"];
    let said = folder.call(&[&changed[..], &["--format", "json", "-q"]].concat());
    let check = checked(&said);
    assert_eq!(said.code, Some(10), "{check:#}");
    let goal = criterion(&check, "goal");
    assert_eq!((&goal["status"], &goal["as_expected"], &goal["limit"]), (&"recorded".into(), &true.into(), &1.0.into()));
    let junit = folder.call(&[&changed[..], &["--format", "junit", "-q"]].concat()).stdout;
    assert_eq!(kind(&junit, "goal"), None, "{junit}");
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
        (early.to_vec(), 12, "time_limit", "the time limit was reached", false),
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

/// A scenario that warns: one demonstration says nothing of where people do it differently.
const WARNS: [&str; 5] = ["a.toml", "--set", "teaching.grid.block_height_m=[0.2]", "--set", "learning.theta_m=[]"];

/// Contract: what a run warned of is not forgotten when its folder is checked: denied when it ran, it ends the check as it ended the run, with the
/// reason in every format; denied now, it is one that is not as expected.
#[test]
fn warnings_of_a_run_are_told_and_denied_when_it_is_checked() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    let run = |more: &[&str]| folder.call(&[&["run"], &WARNS[..], more].concat()).code;
    assert_eq!((run(&["--out", "denied", "-q", "--deny-warnings"]), run(&["--out", "warned", "-q"])), (Some(10), Some(0)));
    for (arguments, denied) in [(&["denied"][..], true), (&["warned"], false), (&["warned", "--deny-warnings"], true)] {
        let call = |format: &str| folder.call(&[&["check"], arguments, &["-q", "--format", format]].concat());
        let said = call("json");
        assert_eq!(said.code, Some(if denied { 10 } else { 0 }), "{arguments:?}: {}{}", said.stdout, said.stderr);
        let check = checked(&said);
        assert!(check["report"]["warnings"].to_string().contains("one demonstration"), "{arguments:?}: {check:#}");
        let error = check["report"]["error"].as_str().unwrap_or_default();
        assert_eq!(error.contains("--deny-warnings: ") && error.contains("one demonstration"), denied, "{arguments:?}: {error}");
        assert_eq!(call("human").stdout.contains("--deny-warnings: "), denied, "{arguments:?}");
        assert_eq!(kind(&call("junit").stdout, "completed"), denied.then(|| "failure".to_owned()), "{arguments:?}");
    }
}

/// Contract: a log tells where what could move was. What stands still may be changed, and is judged where it stands; what moved may not, and the flag
/// is named that changes it.
#[test]
fn a_log_is_not_judged_in_a_scene_in_which_it_would_have_been_another() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    assert_eq!(folder.call(&["run", "a.toml", "--out", "out", "-q"]).code, Some(0));
    for flag in ["object.toy.center_m=[0.6, 0.15]", "object.toy.radius_m=0.05", "object.table.top_height_m=-0.1"] {
        let said = folder.call(&["check", "out", "--set", "criterion.goal.max_m=1", "--set", flag]);
        assert_eq!(said.code, Some(3), "{flag}: {}", said.stdout);
        let to_blame = if flag.contains(' ') { format!("'{flag}'") } else { flag.to_owned() };
        assert!(said.stdout.contains(&format!("--set: error[conflict]: --set {to_blame} makes `toy` ")), "{}", said.stdout);
        assert!(said.stdout.contains("run it again: cpdmp run out/scenario.toml --set "), "{}", said.stdout);
    }
    let said = folder.call(&["check", "out", "--set", "object.block.center_m=[0.6, 0.25]", "--format", "json", "-q"]);
    assert_eq!(said.code, Some(10), "{}", said.stdout);
    let contacts = checked(&said)["report"]["collisions"].to_string();
    assert!(contacts.contains("block.base"), "the arm went where the block is put: {contacts}");
    let away = ["--set", "object.block.center_m=[1.3, 0.9]", "--set", "criterion.goal.expect=report"];
    assert_eq!(folder.call(&[&["check", "out"], &away[..]].concat()).code, Some(0));
}

/// Contract: a scenario that was edited in the folder of a run is not what was run: neither judged nor repeated, and told what to do.
#[test]
fn an_edited_scenario_is_not_that_of_the_run() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    assert_eq!(folder.call(&["run", "a.toml", "--out", "out", "-q"]).code, Some(0));
    let path = folder.path().join("out/scenario.toml");
    let text = std::fs::read_to_string(&path).expect("text");
    assert!(text.contains("max_m = 0.02"));
    std::fs::write(&path, text.replace("max_m = 0.02", "max_m = 0.2")).expect("written");
    for command in ["check", "replay"] {
        let said = folder.call(&[command, "out"]);
        assert_eq!(said.code, Some(3), "{command}: {}{}", said.stdout, said.stderr);
        let told = said.stdout + &said.stderr;
        assert!(told.contains("out/scenario.toml: ") && told.contains("edited since") && told.contains("--out ANOTHER_FOLDER"), "{told}");
    }
    std::fs::write(&path, text).expect("written");
    assert_eq!((folder.call(&["check", "out"]).code, folder.call(&["replay", "out"]).code), (Some(0), Some(0)), "restored");
}
