//! Reads the scenarios of a command, all of them before the first one is used.

use std::path::{Path, PathBuf};

use serde::Serialize;

use super::args::{Format, Global};
use super::terminal::Terminal;
use crate::report::Outcome;
use crate::scenario::{Diagnostic, LoadOptions, Scenario};

/// A scenario that is ready, and the file it came from.
pub(super) struct Ready {
    pub path: PathBuf,
    pub scenario: Scenario,
}

/// What the flags say to the reader of scenarios.
pub(super) fn options(global: &Global) -> LoadOptions {
    LoadOptions {
        set: global.set.clone(),
        seed: global.seed,
        robot: global.robot.clone(),
        asset_roots: global.asset_root.clone(),
        lenient: global.lenient,
        deny_warnings: global.deny_warnings,
    }
}

/// Every scenario, or the faults of every scenario that has some.
pub(super) fn load_all(files: &[PathBuf], global: &Global, terminal: &Terminal) -> Result<Vec<Ready>, Outcome> {
    let options = options(global);
    let mut ready = Vec::new();
    let mut faulty = false;
    for path in files {
        match Scenario::load(path, &options) {
            Ok(scenario) => {
                terminal.faults(&scenario.warnings);
                ready.push(Ready { path: path.clone(), scenario });
            }
            Err(invalid) => {
                faulty = true;
                tell_faults(path, &invalid.0, terminal);
            }
        }
    }
    if faulty { Err(Outcome::InvalidInput) } else { Ok(ready) }
}

/// What other programs read about a scenario that cannot be used.
#[derive(Serialize)]
struct Refused<'a> {
    path: &'a Path,
    outcome: Outcome,
    exit_code: u8,
    diagnostics: &'a [Diagnostic],
}

/// Tells why a scenario cannot be used.
fn tell_faults(path: &Path, diagnostics: &[Diagnostic], terminal: &Terminal) {
    let outcome = Outcome::InvalidInput;
    match terminal.format {
        Format::Human => {
            terminal.faults(diagnostics);
            let count = diagnostics.len();
            let faults = if count == 1 { "fault" } else { "faults" };
            terminal.error(&format!("{}: {count} {faults}, nothing was simulated or written\n\n", path.display()));
        }
        Format::Json => terminal.json(&Refused { path, outcome, exit_code: outcome.exit_code(), diagnostics }),
    }
}
