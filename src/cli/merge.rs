//! `cpdmp merge`: the tables of shards to one.

use std::path::Path;

use serde::Serialize;

use super::args::{Format, Global};
use super::failure::Failure;
use super::sweep_args::MergeArguments;
use super::terminal::Terminal;
use crate::batch::{self, MergedRows};
use crate::report::{Outcome, Replaceable, prepare_file};

/// What programs read about a merged table.
#[derive(Serialize)]
struct Merged<'a> {
    schema_version: u32,
    outcome: Outcome,
    exit_code: u8,
    table: &'a Path,
    rows: u64,
    not_passed: u64,
}

/// Joins tables into the file that `--out` names. The worst outcome of all runs counts, as in the sweep of the whole.
pub(super) fn merge(arguments: &MergeArguments, global: &Global, terminal: &Terminal) -> Outcome {
    let stop = |outcome, text: &str| Failure::new(outcome, [text.to_owned()]).tell(terminal);
    let Some(out) = &global.out else {
        return stop(Outcome::Usage, "say where the joined table goes, with --out FILE.parquet");
    };
    if let Err(error) = prepare_file(out, Replaceable::Table) {
        return stop(error.outcome(), &error.to_string());
    }
    match batch::merge(&arguments.tables, out) {
        Ok(MergedRows { rows, not_passed, worst: outcome }) => {
            let failed = if not_passed > 0 { format!(", {not_passed} of runs that did not pass") } else { String::new() };
            let merged = Merged { schema_version: 1, outcome, exit_code: outcome.exit_code(), table: out, rows, not_passed };
            match terminal.format {
                Format::Human => terminal.result(&format!("{}: {rows} rows{failed}\n", out.display())),
                Format::Json => terminal.json(&merged),
            }
            outcome
        }
        Err(error) => stop(error.outcome(), &error.to_string()),
    }
}
