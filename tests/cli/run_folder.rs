//! The run folder: what may be written where.

use std::fs::{self, File};

use super::{Folder, GOOD};

#[test]
fn a_folder_that_is_not_a_run_is_never_overwritten() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("thesis/chapter.tex", b"years of work")]);
    for out in ["thesis", "thesis/chapter.tex"] {
        let said = folder.call(&["run", "a.toml", "--out", out]);
        assert_eq!(said.code, Some(20), "{}", said.stderr);
        assert!(said.stderr.contains("is not the folder of a run"), "{}", said.stderr);
    }
    assert_eq!(fs::read(folder.path().join("thesis/chapter.tex")).expect("still there"), b"years of work");
}

#[test]
fn a_folder_that_another_run_writes_is_left_alone() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    let lock = File::create(folder.path().join(".out.lock")).expect("a file");
    lock.lock().expect("nobody else has it");
    let said = folder.call(&["run", "a.toml", "--out", "out"]);
    assert_eq!(said.code, Some(21), "{}", said.stderr);
    assert!(said.stderr.contains("in use"), "{}", said.stderr);
    // A lock dies with its process: what is left of it on the disk keeps nobody out.
    drop(lock);
    fs::write(folder.path().join(".out.lock"), "process 1, lock 0").expect("written");
    fs::create_dir(folder.path().join(".out.partial")).expect("what a killed run leaves");
    let said = folder.call(&["run", "a.toml", "--out", "out", "-q"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert_eq!(folder.names(), ["a.toml", "out"]);
}

/// Contract: whoever is kept out is told which process has the folder.
#[test]
fn two_runs_for_one_folder_are_told_of_each_other() {
    let folder = Folder::with(&[(
        "a.toml",
        GOOD.replace("duration_s = 4.0", "duration_s = 60.0").replace("time_s = 4.0", "time_s = 60.0").as_bytes(),
    )]);
    let mut first = std::process::Command::new(env!("CARGO_BIN_EXE_cpdmp"))
        .current_dir(folder.path())
        .args(["run", "a.toml", "--out", "out", "-q"])
        .stdout(std::process::Stdio::null())
        .spawn()
        .expect("it starts");
    let partial = folder.path().join(".out.partial");
    while !partial.exists() && first.try_wait().expect("it is there").is_none() {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let said = folder.call(&["run", "a.toml", "--out", "out"]);
    let running = first.try_wait().expect("it is there").is_none();
    first.kill().expect("killed");
    first.wait().expect("it ends");
    assert!(running, "the first run is still going on");
    assert_eq!(said.code, Some(21), "{}", said.stderr);
    assert!(said.stderr.contains(&format!("process {}", first.id())), "{}", said.stderr);
    assert!(!folder.path().join("out").exists(), "there is never half a run");
}

#[test]
fn two_scenarios_for_one_folder_are_refused() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("b.toml", GOOD.as_bytes())]);
    let said = folder.call(&["run", "a.toml", "b.toml"]);
    assert_eq!(said.code, Some(2));
    assert!(said.stderr.contains("as another of these scenarios does"), "{}", said.stderr);
}
