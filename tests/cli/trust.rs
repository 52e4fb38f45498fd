//! What must not make a verdict green: files that changed, names that mean two things, questions about nothing, what a pattern leaves out.

use std::fs;

use cpdmp::report::lock_beside;
use serde_json::Value;

use super::{Folder, GOOD};

const ROBOT: &str = include_str!("../../assets/baxter/baxter.urdf");

/// The kinds of what a check looked at, and its exit code.
fn kinds(folder: &Folder, paths: &[&str]) -> (Option<i32>, Vec<String>) {
    let said = folder.call(&[&["check", "--format", "json", "-q"], paths].concat());
    let report: Value = serde_json::from_str(&said.stdout).unwrap_or_default();
    let checks = report["checks"].as_array().cloned().unwrap_or_default();
    (said.code, checks.iter().map(|check| check["kind"].as_str().unwrap_or_default().to_owned()).collect())
}

/// Contract: a stored run is not judged with a robot that is another one than its own.
#[test]
fn a_run_whose_robot_has_changed_is_not_judged() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("r.urdf", ROBOT.as_bytes())]);
    let said = folder.call(&["run", "a.toml", "--robot", "r.urdf", "--out", "out", "-q"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert_eq!(folder.call(&["check", "out", "-q"]).code, Some(0));
    fs::write(folder.path().join("r.urdf"), format!("{ROBOT}<!-- longer -->\n")).expect("written");
    let said = folder.call(&["check", "out", "-q"]);
    assert!(said.code == Some(3) && said.stdout.contains("it has changed since the run"), "{}", said.stdout);
}

/// Contract: a name stands for one thing.
#[test]
fn an_object_is_not_called_as_a_link() {
    let folder = Folder::with(&[("a.toml", GOOD.replace("\"toy\"", "\"left_wrist\"").as_bytes())]);
    let said = folder.call(&["validate", "a.toml"]);
    assert!(said.code == Some(3) && said.stderr.contains("object `left_wrist`: a link of the robot is called"), "{}", said.stderr);
}

/// Contract: a criterion about nothing is no criterion.
#[test]
fn a_criterion_about_no_object_is_refused() {
    let empty = "\n[[criterion]]\nname = \"nothing\"\nkind = \"no_contact\"\nobjects = []\n";
    let folder = Folder::with(&[("a.toml", format!("{GOOD}{empty}").as_bytes())]);
    let said = folder.call(&["validate", "a.toml"]);
    assert!(said.code == Some(3) && said.stderr.contains("it could not fail"), "{}", said.stderr);
}

/// Contract: a robot that can be seen but not touched is warned of: it would pass through everything.
#[test]
fn a_robot_that_touches_nothing_is_warned_of() {
    let mut ghost = ROBOT.to_owned();
    while let (Some(start), Some(end)) = (ghost.find("<collision"), ghost.find("</collision>")) {
        ghost.replace_range(start..end + "</collision>".len(), "");
    }
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("ghost.urdf", ghost.as_bytes()), ("r.urdf", ROBOT.as_bytes())]);
    let said = folder.call(&["validate", "a.toml", "--robot", "ghost.urdf", "--deny-warnings"]);
    assert!(said.code == Some(3) && said.stderr.contains("can touch anything"), "{}", said.stderr);
    let said = folder.call(&["validate", "a.toml", "--robot", "r.urdf"]);
    assert!(said.code == Some(0) && !said.stderr.contains("can touch anything"), "{}", said.stderr);
    // One that cannot be seen either is no better.
    let mut unseen = ghost.clone();
    while let (Some(start), Some(end)) = (unseen.find("<visual"), unseen.find("</visual>")) {
        unseen.replace_range(start..end + "</visual>".len(), "");
    }
    fs::write(folder.path().join("ghost.urdf"), unseen).expect("written");
    for format in ["junit", "github"] {
        let said = folder.call(&["check", "a.toml", "--robot", "ghost.urdf", "--format", format]);
        assert!(said.stdout.contains("no link of it can touch anything"), "{format}: {}", said.stdout);
    }
}

/// Contract: what a robot can touch is an input of its runs, wherever its shapes are.
#[test]
fn a_run_whose_meshes_have_changed_is_not_judged() {
    let (start, end) = (ROBOT.find("<collision").expect("there"), ROBOT.find("</collision>").expect("there"));
    let mesh = "<collision><geometry><mesh filename=\"h.obj\"/></geometry>";
    let robot = format!("{}{mesh}{}", &ROBOT[..start], &ROBOT[end..]);
    let corner = |size: f64| format!("v 0 0 0\nv {size} 0 0\nv 0 {size} 0\nv 0 0 {size}\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    let small = corner(0.02);
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("r.urdf", robot.as_bytes()), ("h.obj", small.as_bytes())]);
    let ran = folder.call(&["run", "a.toml", "--robot", "r.urdf", "--out", "run", "-q"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(folder.call(&["check", "run"]).code, Some(0));
    fs::write(folder.path().join("h.obj"), corner(0.04)).expect("written");
    let said = folder.call(&["check", "run"]);
    assert!(said.code == Some(3) && said.stdout.contains("h.obj") && said.stdout.contains("has changed"), "{}", said.stdout);
}

/// Contract: a pattern finds runs as their folder does, and a run that lost files is still one.
#[test]
fn runs_are_found_whatever_they_lost() {
    let folder = Folder::with(&[("a.TOML", GOOD.as_bytes())]);
    assert_eq!(folder.call(&["run", "a.TOML", "--out", "runs/one", "-q"]).code, Some(0));
    assert_eq!(kinds(&folder, &["runs"]), (Some(0), vec!["run".to_owned()]));
    assert_eq!(kinds(&folder, &["runs/o*"]), (Some(0), vec!["run".to_owned()]));
    assert_eq!(kinds(&folder, &["."]), (Some(0), vec!["scenario".to_owned()]), "whatever case its ending has");
    for lost in [&["manifest.json", "scenario.toml"][..], &["report.json"]] {
        lost.iter().for_each(|name| fs::remove_file(folder.path().join("runs/one").join(name)).expect("removed"));
        assert_eq!(kinds(&folder, &["runs"]), (Some(3), vec!["run".to_owned()]), "without {lost:?}");
    }
}

/// Contract: what a pattern matches is judged, folders too; a run that is being written, or was killed while it was, is hidden.
#[test]
fn a_pattern_passes_nothing_over() {
    let bad = GOOD.replace("max_m = 0.02", "max_m = 1e-9");
    let folder = Folder::with(&[("x.toml", GOOD.as_bytes()), ("x_more/bad.toml", bad.as_bytes())]);
    assert_eq!(kinds(&folder, &["x*"]), (Some(10), vec!["scenario".to_owned(), "scenario".to_owned()]));
    assert_eq!(folder.call(&["run", "x.toml", "--out", "runs/one", "-q"]).code, Some(0));
    fs::create_dir(folder.path().join("runs/.two.partial")).expect("made");
    fs::write(folder.path().join("runs/.two.partial/report.json"), "{}").expect("written");
    fs::write(folder.path().join("runs/.two.partial/scenario.toml"), GOOD).expect("written");
    for path in ["runs", "runs/*"] {
        assert_eq!(kinds(&folder, &[path]), (Some(0), vec!["run".to_owned()]), "{path}");
    }
}

/// Contract: a run of which only its recording or its snapshots are left beside its scenario is not simulated as if it were one.
#[test]
fn what_is_left_of_a_run_is_no_scenario() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    assert_eq!(folder.call(&["run", "a.toml", "--out", "run", "-q"]).code, Some(0));
    for lost in ["manifest.json", "report.json", "steps.parquet", "state_hashes.parquet", "skill.json"] {
        fs::remove_file(folder.path().join("run").join(lost)).expect("removed");
        assert_eq!(kinds(&folder, &["run"]), (Some(3), vec!["run".to_owned()]), "without {lost} and those before");
    }
}

/// Contract: two checks do not write one verdict.
#[test]
fn a_verdict_that_another_check_writes_is_left_to_it() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    let held = lock_beside(&folder.path().join("v.xml")).expect("free");
    let said = folder.call(&["check", "a.toml", "--junit", "v.xml"]);
    assert!(said.code == Some(21) && said.stderr.contains("in use by"), "{:?} {}", said.code, said.stderr);
    drop(held);
    assert_eq!(folder.call(&["check", "a.toml", "--junit", "v.xml"]).code, Some(0));
    assert_eq!(folder.names(), ["a.toml", "v.xml"], "no lock is left");
}
