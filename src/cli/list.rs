//! `cpdmp list`: the scenarios that are there.

use std::path::{Path, PathBuf};

use serde::Serialize;

use super::args::{Format, Global};
use super::load::options;
use super::select::select;
use super::terminal::Terminal;
use crate::report::Outcome;
use crate::scenario::Scenario;

/// What other programs read about one scenario.
#[derive(Serialize)]
struct Listed<'a> {
    path: &'a Path,
    valid: bool,
    name: Option<String>,
    description: Option<String>,
}

/// Lists scenarios with what each shows. One that cannot be used is listed as such and is no failure of this
/// command; one that is not there is.
pub(super) fn list(paths: &[PathBuf], global: &Global, terminal: &Terminal) -> Outcome {
    let files = match select(paths, terminal) {
        Ok(files) => files,
        Err(outcome) => return outcome,
    };
    let (files, missing): (Vec<_>, Vec<_>) = files.into_iter().partition(|file| file.exists());
    missing.iter().for_each(|file| terminal.error(&format!("error: there is no file {}: check the path\n", file.display())));
    let options = options(global);
    let width = files.iter().map(|file| file.display().to_string().chars().count()).max().unwrap_or(0);
    for path in &files {
        let loaded = Scenario::load(path, &options);
        match (terminal.format, loaded) {
            (Format::Json, Ok(scenario)) => {
                let (name, description) = (Some(scenario.work.name().to_owned()), Some(scenario.description));
                terminal.json(&Listed { path, valid: true, name, description });
            }
            (Format::Json, Err(_)) => terminal.json(&Listed { path, valid: false, name: None, description: None }),
            (Format::Human, Ok(scenario)) => terminal.result(&format!("{:<width$}  {}\n", path.display(), scenario.description)),
            (Format::Human, Err(_)) => terminal.result(&format!("{:<width$}  cannot be used: see cpdmp validate\n", path.display())),
        }
    }
    if missing.is_empty() { Outcome::Passed } else { Outcome::InvalidInput }
}
