//! `cpdmp schema`: the JSON Schemas of every file that others read or write.

use clap::ValueEnum;

use super::args::SchemaName;
use super::replay_report::ReplayReport;
use super::sweep_report::SweepReport;
use super::terminal::Terminal;
use crate::demonstration::dataset_schema;
use crate::learning::skill_schema;
use crate::report::{Outcome, check_schema, learn_schema, manifest_schema, report_schema, written_schema};
use crate::scenario::{learning_schema, scenario_schema};

/// Prints one schema, or the names of all.
pub(super) fn schema(name: Option<SchemaName>, terminal: &Terminal) -> Outcome {
    let Some(name) = name else {
        for name in SchemaName::value_variants().iter().filter_map(SchemaName::to_possible_value) {
            terminal.result(&format!("{:<10} {}\n", name.get_name(), name.get_help().map(ToString::to_string).unwrap_or_default()));
        }
        return Outcome::Passed;
    };
    let schema = match name {
        SchemaName::Scenario => scenario_schema(),
        SchemaName::Learning => learning_schema(),
        SchemaName::Dataset => dataset_schema(),
        SchemaName::Skill => skill_schema(),
        SchemaName::Report => report_schema(),
        SchemaName::Manifest => manifest_schema(),
        SchemaName::Check => check_schema(),
        SchemaName::Learn => learn_schema(),
        SchemaName::Sweep => written_schema::<SweepReport<'static>>(),
        SchemaName::Replay => written_schema::<ReplayReport>(),
    };
    terminal.result(&format!("{schema:#}\n"));
    Outcome::Passed
}
