//! `cpdmp migrate`: files of an older version of the program, brought to this one's.

use std::path::{Path, PathBuf};

use serde::Serialize;

use super::args::Format;
use super::failure::Failure;
use super::terminal::Terminal;
use crate::learning::Skill;
use crate::report::{Outcome, rewrite_file};
use crate::scenario::Migration;

/// What programs read about one file.
#[derive(Serialize)]
struct Migrated<'a> {
    path: &'a Path,
    version: i64,
    changes: &'a [String],
    written: bool,
}

/// Migrates every file, or none when one of them cannot be.
pub(super) fn migrate(files: &[PathBuf], dry_run: bool, terminal: &Terminal) -> Outcome {
    let mut migrations = Vec::new();
    let mut refused = None;
    for path in files {
        match examine(path) {
            Ok(migration) => migrations.push((path, migration)),
            Err(failure) => refused = refused.max(Some(failure.tell(terminal))),
        }
    }
    if let Some(outcome) = refused {
        terminal.note("nothing was changed\n");
        return outcome;
    }
    migrations.iter().map(|(path, migration)| settle(path, migration, dry_run, terminal)).max().unwrap_or(Outcome::NothingSelected)
}

fn examine(path: &Path) -> Result<Migration, Failure> {
    if path.extension().is_some_and(|extension| extension == "json") {
        // Skills have had one version, and only a file of it is read.
        return Skill::read(path).map(|_| Migration::Current).map_err(|error| Failure::of_learning(path, &error));
    }
    Ok(Migration::of(path)?)
}

/// Writes what has to change, unless nothing is to be written, and tells it.
fn settle(path: &Path, migration: &Migration, dry_run: bool, terminal: &Terminal) -> Outcome {
    let (changes, written) = match migration {
        Migration::Current => (&[][..], Ok(())),
        Migration::Changed { changes, .. } if dry_run => (&changes[..], Ok(())),
        Migration::Changed { changes, text } => (&changes[..], rewrite_file(path, text.as_bytes())),
    };
    if let Err(error) = written {
        return Failure::from(error).tell(terminal);
    }
    tell(&Migrated { path, version: Migration::VERSION, changes, written: !changes.is_empty() && !dry_run }, terminal);
    Outcome::Passed
}

fn tell(migrated: &Migrated<'_>, terminal: &Terminal) {
    if terminal.format == Format::Json {
        return terminal.json(migrated);
    }
    let (path, version) = (migrated.path.display(), migrated.version);
    let changes = migrated.changes.join("; ");
    terminal.result(&match (migrated.changes, migrated.written) {
        ([], _) => format!("{path}: is at version {version}\n"),
        (_, true) => format!("{path}: migrated to version {version}: {changes}\n"),
        (_, false) => format!("{path}: would be migrated to version {version}: {changes}\n"),
    });
}
