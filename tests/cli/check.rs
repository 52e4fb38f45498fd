//! `cpdmp check`: one verdict in four formats, and an exit code that a continuous integration can trust.

use std::fs;

use quick_junit::{NonSuccessKind, Report, TestCaseStatus, TestSuite};
use serde_json::Value;

use super::{Folder, GOOD};

/// A scenario that passes, one that does not, and one that cannot be used.
fn three() -> Folder {
    let missed = GOOD.replace("name = \"good\"", "name = \"missed\"").replace("max_m = 0.02", "max_m = 0.0");
    let faulty = GOOD.replace("mass_kg = 0.05", "mas_kg = 0.05");
    let files = [("s/a.toml", GOOD.as_bytes()), ("s/b.toml", missed.as_bytes()), ("s/c.toml", faulty.as_bytes())];
    Folder::with(&files)
}

fn kind(suite: &TestSuite, case: &str) -> Option<NonSuccessKind> {
    let case = suite.test_cases.iter().find(|one| one.name.as_str() == case).unwrap_or_else(|| panic!("no case {case} in {suite:?}"));
    match &case.status {
        TestCaseStatus::NonSuccess { kind, .. } => Some(*kind),
        _ => None,
    }
}

/// Contract: what passes, what fails and what cannot be run stay apart in every format; the worst decides; nothing is left on the disk but
/// what was asked for.
#[test]
fn one_verdict_in_every_format() {
    let folder = three();
    let said = folder.call(&["check", "s", "--junit", "out/junit.xml", "--jobs", "2"]);
    assert_eq!(said.code, Some(3), "{}{}", said.stdout, said.stderr);
    assert_eq!(folder.names(), ["out", "s"]);
    let rows: Vec<&str> = said.stdout.lines().take(4).collect();
    for (row, (path, outcome)) in
        rows[1..].iter().zip([("s/a.toml", "passed"), ("s/b.toml", "criteria not met"), ("s/c.toml", "invalid input")])
    {
        assert!(row.contains(path) && row.contains(outcome), "{}", said.stdout);
    }
    assert!(said.stdout.contains("1 of 3 as expected") && said.stdout.contains("unknown key"), "{}", said.stdout);

    let xml = fs::read_to_string(folder.path().join("out/junit.xml")).expect("written");
    let report = Report::deserialize_from_str(&xml).expect("JUnit");
    let [good, missed, faulty] = &report.test_suites[..] else { panic!("one suite per scenario: {xml}") };
    assert_eq!((report.failures, report.errors, report.tests), (1, 1, 5));
    assert_eq!((good.name.as_str(), kind(good, "completed"), kind(good, "goal")), ("good", None, None));
    assert_eq!((kind(missed, "completed"), kind(missed, "goal")), (None, Some(NonSuccessKind::Failure)));
    assert_eq!(kind(faulty, "completed"), Some(NonSuccessKind::Error));
    let property = |name: &str| good.properties.iter().find(|one| one.name.as_str() == name).map(|one| one.value.as_str());
    assert_eq!((property("seed"), property("version")), (Some("0"), Some(env!("CARGO_PKG_VERSION"))));
    assert_eq!(property("state_hash").map(str::len), Some(16));
}

#[test]
fn annotations_stand_at_the_line_of_the_criterion() {
    let folder = three();
    let said = folder.call(&["check", "s/b.toml", "s/c.toml", "--format", "github", "-q"]);
    assert_eq!(said.code, Some(3));
    let line = |text: &str, before: &str| text[..text.find(before).expect("there")].matches('\n').count() + 1;
    let goal = format!("::error file=s/b.toml,line={},col=8,title=goal::goal: fails", line(GOOD, "\"goal\""));
    let key = format!("::error file=s/c.toml,line={},col=1,title=unknown_key::unknown key", line(GOOD, "mass_kg"));
    for wanted in [goal, key] {
        assert!(said.stdout.lines().any(|line| line.starts_with(&wanted)), "{wanted}\n{}", said.stdout);
    }
}

/// Contract: a check simulates what a run simulates.
#[test]
fn a_check_is_a_run_without_a_recording() {
    let folder = three();
    let said = folder.call(&["check", "s/a.toml", "--format", "json", "-q"]);
    assert_eq!((said.code, said.stderr.as_str()), (Some(0), ""));
    let check: Value = serde_json::from_str(&said.stdout).expect("JSON");
    assert_eq!((check["schema_version"].as_i64(), check["outcome"].as_str()), (Some(1), Some("passed")));
    let run: Value = serde_json::from_str(&folder.call(&["run", "s/a.toml", "--format", "json", "-q"]).stdout).expect("JSON");
    let report = &check["checks"][0]["report"];
    for key in ["state_hash", "criteria", "collisions", "clearance", "steps"] {
        assert_eq!(report[key], run[key], "{key}");
    }
}

#[test]
fn what_check_cannot_do_is_said_before_anything_runs() {
    let folder = three();
    fs::write(folder.path().join("notes.xml"), "<mine/>").expect("written");
    let said = folder.call(&["check", "s/a.toml", "--junit", "notes.xml"]);
    assert!(said.code == Some(20) && said.stderr.contains("is not a JUnit report"), "{}", said.stderr);
    assert_eq!(folder.call(&["check", "nowhere/*.toml"]).code, Some(5));
    assert_eq!(folder.call(&["check"]).code, Some(2));
    let said = folder.call(&["validate", "s/a.toml", "--format", "junit"]);
    assert!(said.code == Some(2) && said.stderr.contains("for cpdmp check"), "{}", said.stderr);
}

/// Contract: a scenario that asks nothing passes, but not without a word, nor where warnings are denied.
#[test]
fn a_scenario_without_criteria_is_warned_about() {
    let asks_nothing = GOOD.split("[[criterion]]").next().expect("what is before the criterion");
    let folder = Folder::with(&[("a.toml", asks_nothing.as_bytes()), ("b.toml", GOOD.as_bytes())]);
    let said = folder.call(&["check", "a.toml"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert!(said.stderr.contains("warning") && said.stderr.contains("without a criterion"), "{}", said.stderr);
    for command in ["check", "validate", "sweep"] {
        let arguments: &[&str] = if command == "sweep" { &["--repeat", "2", "--out", "s"] } else { &[] };
        let said = folder.call(&[&[command, "a.toml", "--deny-warnings"], arguments].concat());
        assert_eq!(said.code, Some(3), "{command}: {}", said.stdout);
        assert!(said.stderr.contains("without a criterion"), "{command}: {}", said.stderr);
    }
    assert!(!folder.call(&["check", "b.toml"]).stderr.contains("without a criterion"), "it asks something");
}

/// Contract: a verdict that was written earlier does not stand for a check that came to none.
#[test]
fn a_check_without_a_verdict_leaves_no_green_file() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    let written = || std::fs::read_to_string(folder.path().join("v.xml")).expect("written");
    assert_eq!(folder.call(&["check", "a.toml", "--junit", "v.xml"]).code, Some(0));
    assert!(!written().contains("<error"), "{}", written());
    for (arguments, code) in [(["absent/*.toml", "-q"], 5), (["a.csv", "-q"], 2), (["a.toml", "--bogus"], 2), (["a.toml", "--jobs=0"], 2)] {
        let said = folder.call(&[&["check"], &arguments[..], &["--junit", "v.xml"]].concat());
        assert_eq!(said.code, Some(code), "{}", said.stderr);
        let told = written();
        assert!(told.contains("errors=\"1\"") && told.contains("did not come to its end"), "{told}");
    }
    assert_eq!(folder.call(&["check", "a.toml", "--junit", "v.xml"]).code, Some(0));
    assert!(!written().contains("<error"), "what stands there is replaced");
    // Of a command line that is no check's nothing is withdrawn, of one that names two files both are.
    assert_eq!(folder.call(&["list", "check", "--junit", "v.xml"]).code, Some(2));
    assert!(!written().contains("<error"), "{}", written());
    std::fs::copy(folder.path().join("v.xml"), folder.path().join("w.xml")).expect("copied");
    assert_eq!(folder.call(&["check", "a.toml", "--junit", "w.xml", "--junit=v.xml"]).code, Some(2));
    for file in ["v.xml", "w.xml"] {
        let told = std::fs::read_to_string(folder.path().join(file)).expect("there");
        assert!(told.contains("did not come to its end"), "{file}: {told}");
    }
    // The value of a flag is no command.
    assert_eq!(folder.call(&["check", "a.toml", "--junit", "v.xml"]).code, Some(0));
    assert_eq!(folder.call(&["--out", "run", "check", "a.toml", "--bogus", "--junit", "v.xml"]).code, Some(2));
    assert!(written().contains("did not come to its end"), "{}", written());
    assert_eq!(folder.call(&["check", "a.toml", "--junit", "v.xml"]).code, Some(0));
    assert_eq!(folder.call(&["--bogus", "3", "check", "a.toml", "--junit", "v.xml"]).code, Some(2));
    assert!(written().contains("did not come to its end"), "{}", written());
    // What the results go to cannot hold the verdict too, whatever it is called.
    let out = std::fs::File::create(folder.path().join("out.txt")).expect("made");
    let mut program = std::process::Command::new(env!("CARGO_BIN_EXE_cpdmp"));
    let ended = program.current_dir(folder.path()).args(["check", "a.toml", "-q", "--junit", "out.txt"]).stdout(out).status();
    assert_eq!(ended.expect("it runs").code(), Some(2));
    let said = folder.call(&["check", "a.toml", "--junit", "/dev/stdout"]);
    assert!(said.code == Some(2) && said.stderr.contains("--format junit prints it"), "{}", said.stderr);
    // An empty file is free, and a link leads to what is read.
    std::fs::write(folder.path().join("v.xml"), "").expect("written");
    #[cfg(unix)]
    std::os::unix::fs::symlink("v.xml", folder.path().join("link.xml")).expect("a link");
    #[cfg(unix)]
    assert_eq!(folder.call(&["check", "absent/*.toml", "--junit", "link.xml"]).code, Some(5));
    #[cfg(unix)]
    assert!(written().contains("did not come to its end") && folder.path().join("link.xml").is_symlink(), "{}", written());
    // A link to nothing is filled.
    std::fs::remove_file(folder.path().join("v.xml")).expect("removed");
    #[cfg(unix)]
    assert_eq!(folder.call(&["check", "a.toml", "--junit", "link.xml"]).code, Some(0));
    #[cfg(unix)]
    assert!(written().contains("<testsuites") && folder.path().join("link.xml").is_symlink(), "{}", written());
}
