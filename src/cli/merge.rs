//! `cpdmp merge`: the tables of shards to one.

use std::path::Path;

use serde::Serialize;

use super::args::{Format, Global};
use super::failure::Failure;
use super::sweep_args::MergeArguments;
use super::terminal::Terminal;
use crate::batch;
use crate::report::{Outcome, Replaceable, prepare_file};

/// What programs read about a merged table.
#[derive(Serialize)]
struct Merged<'a> {
    schema_version: u32,
    outcome: Outcome,
    exit_code: u8,
    table: &'a Path,
    rows: u64,
}

/// Joins tables into the file that `--out` names.
pub(super) fn merge(arguments: &MergeArguments, global: &Global, terminal: &Terminal) -> Outcome {
    let stop = |outcome, text: &str| Failure::new(outcome, [text.to_owned()]).tell(terminal);
    let Some(out) = &global.out else {
        return stop(Outcome::Usage, "say where the joined table goes, with --out FILE.parquet");
    };
    if let Err(error) = prepare_file(out, Replaceable::Table) {
        return stop(error.outcome(), &error.to_string());
    }
    match batch::merge(&arguments.tables, out) {
        Ok(rows) => {
            let outcome = Outcome::Passed;
            match terminal.format {
                Format::Human => terminal.result(&format!("{}: {rows} rows\n", out.display())),
                Format::Json => terminal.json(&Merged { schema_version: 1, outcome, exit_code: outcome.exit_code(), table: out, rows }),
            }
            outcome
        }
        Err(error) => stop(error.outcome(), &error.to_string()),
    }
}
