//! The viewer is a program of its own: these tests put a small script in its place that writes down what it was asked.
#![cfg(all(unix, feature = "rerun"))]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::time::{Duration, Instant};

use super::{Folder, GOOD};

/// A folder with a viewer that notes its arguments and then does what `then` says.
fn with_viewer(then: &str) -> Folder {
    let script = format!("#!/bin/sh\necho \"$@\" > asked.part && mv asked.part asked\n{then}\n");
    let folder = Folder::with(&[("viewer", script.as_bytes()), ("a.toml", GOOD.as_bytes()), ("run/recording.rrd", b"RRF2")]);
    let viewer = folder.path().join("viewer");
    fs::set_permissions(&viewer, fs::Permissions::from_mode(0o755)).expect("executable");
    folder
}

/// What the viewer was asked; waits until it was.
fn asked(folder: &Folder) -> String {
    let started = Instant::now();
    loop {
        match fs::read_to_string(folder.path().join("asked")) {
            Ok(text) => return text,
            Err(_) if started.elapsed() < Duration::from_secs(20) => std::thread::sleep(Duration::from_millis(20)),
            Err(error) => panic!("the viewer was not asked: {error}"),
        }
    }
}

#[test]
fn a_run_is_shown_by_folder_or_by_file() {
    for place in ["run", "run/recording.rrd"] {
        let folder = with_viewer("exit 0");
        let said = folder.call(&["view", place, "--viewer-program", "./viewer"]);
        assert_eq!(said.code, Some(0), "{}", said.stderr);
        assert_eq!(asked(&folder), "run/recording.rrd\n");
    }
}

#[test]
fn what_cannot_be_shown_is_told() {
    let folder = with_viewer("exit 1");
    for (arguments, code, words) in [
        (["view", "nothing", "--viewer-program", "./viewer"], 3, "recording.rrd = false"),
        (["view", "run", "--viewer-program", "no-such-viewer"], 20, "pip install rerun-sdk"),
        (["view", "run", "--viewer-program", "./viewer"], 20, "is there a display"),
    ] {
        let said = folder.call(&arguments);
        assert_eq!(said.code, Some(code), "{}", said.stderr);
        assert!(said.stderr.contains(words), "{}", said.stderr);
    }
}

/// Contract: a viewer that hangs or is missing neither delays nor fails a run.
#[test]
fn a_run_does_not_depend_on_its_viewer() {
    let folder = with_viewer("sleep 30; touch closed");
    let said = folder.call(&["run", "a.toml", "--viewer", "--viewer-program", "./viewer"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert_eq!(asked(&folder), "runs/good-0/recording.rrd\n");
    assert!(!folder.path().join("closed").exists(), "the run waited for its viewer");
    let said = folder.call(&["run", "a.toml", "--viewer", "--viewer-program", "no-such-viewer"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert!(said.stderr.contains("pip install rerun-sdk"), "{}", said.stderr);
}
