//! `cpdmp teach`: the lessons of a scenario as a dataset, and nothing else.

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::Value;

use super::{Folder, GOOD};

/// Every file of a folder with its bytes.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry"));
    entries.map(|entry| (entry.file_name().to_string_lossy().into_owned(), std::fs::read(entry.path()).expect("read"))).collect()
}

/// Contract: what is taught is, byte for byte, what a run learns from, and can be learned from.
#[test]
fn a_dataset_is_taught_as_a_run_would() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    let said = folder.call(&["teach", "a.toml", "--seed", "3", "--out", "data/taught", "--format", "json"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    let told: Value = serde_json::from_str(&said.stdout).expect("JSON");
    assert_eq!((told["demonstrations"].as_u64(), told["seed"].as_u64(), told["scenario"].as_str()), (Some(3), Some(3), Some("good")));
    assert_eq!(folder.call(&["run", "a.toml", "--seed", "3", "--out", "run", "-q"]).code, Some(0));
    let taught = files(&folder.path().join("data/taught"));
    assert_eq!(taught.len(), 4, "a list and three demonstrations");
    assert!(taught == files(&folder.path().join("run/demonstrations")), "not what the run was taught");
    assert_eq!(folder.call(&["learn", "data/taught", "--out", "s.json", "-q"]).code, Some(0));
}

/// Contract: what cannot be taught, or has no place to go, is told before anything is simulated or written.
#[test]
fn what_cannot_be_taught_is_refused() {
    let planar = include_str!("../../scenarios/obstacle_avoidance.toml");
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("p.toml", planar.as_bytes()), ("full/notes.txt", b"years of work")]);
    for (arguments, code, told) in [
        (&["a.toml"][..], 2, "--out DIR"),
        (&["a.toml", "--out", "full"], 20, "full is there already"),
        (&["a.toml", "--out", "a.toml"], 20, "a.toml is there already"),
        (&["p.toml", "--out", "new"], 3, "[planar]"),
        (&["a.toml", "--out", "new", "--set", "demonstrations=full"], 3, "its demonstrations are read from"),
        (&["a.toml", "--out", "new", "--set", "teaching.duration_s=-1"], 3, "duration_s"),
        (&["a.toml", "--out", "new", "--timeout", "0.02"], 12, "time limit"),
    ] {
        let said = folder.call(&[&["teach"], arguments].concat());
        assert_eq!(said.code, Some(code), "{arguments:?}: {}", said.stderr);
        assert!(said.stderr.contains(told), "{arguments:?}: {}", said.stderr);
    }
    assert_eq!(folder.names(), ["a.toml", "full", "p.toml"]);
}

/// Contract: a lesson that did not go where the person meant to lead it is learned from, but not in silence.
#[test]
fn a_lesson_that_misses_its_way_point_is_told() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    let weak = ["--set", "human.teaching_force_max_n=0.5"];
    let said = folder.call(&[&["teach", "a.toml", "--out", "weak"], &weak[..]].concat());
    assert!(said.code == Some(0) && said.stderr.contains("the tool passed way-point"), "{}", said.stderr);
    let said = folder.call(&[&["check", "a.toml"], &weak[..]].concat());
    assert!(said.stderr.contains("a.toml: warning: lesson `") && said.stderr.contains("mm away"), "{}", said.stderr);
    let said = folder.call(&["teach", "a.toml", "--out", "strong"]);
    assert!(said.code == Some(0) && !said.stderr.contains("warning"), "{}", said.stderr);
}
