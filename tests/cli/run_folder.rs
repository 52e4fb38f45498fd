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
}

#[test]
fn two_scenarios_for_one_folder_are_refused() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("b.toml", GOOD.as_bytes())]);
    let said = folder.call(&["run", "a.toml", "b.toml"]);
    assert_eq!(said.code, Some(2));
    assert!(said.stderr.contains("as another of these scenarios does"), "{}", said.stderr);
}
