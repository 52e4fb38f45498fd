//! `cpdmp explain`: what exit codes and codes of faults mean.

use serde::Serialize;

use super::args::{Format, Global};
use super::terminal::Terminal;
use crate::report::{FileCode, Outcome};
use crate::scenario::Code;

/// One code with its meaning.
#[derive(Serialize)]
struct Entry {
    /// Present for exit codes only.
    exit_code: Option<u8>,
    name: &'static str,
    meaning: &'static str,
}

/// Explains one code, or all.
pub(super) fn explain(code: Option<&str>, _global: &Global, terminal: &Terminal) -> Outcome {
    let mut outcomes = Outcome::ALL;
    outcomes.sort_by_key(|outcome| outcome.exit_code());
    let exits = outcomes.map(|outcome| Entry { exit_code: Some(outcome.exit_code()), name: outcome.name(), meaning: outcome.describe() });
    let of_scenarios = Code::ALL.map(Code::describe);
    let of_files =
        FileCode::ALL.map(FileCode::describe).into_iter().filter(|(name, _)| of_scenarios.iter().all(|(known, _)| known != name));
    let faults = of_scenarios.into_iter().chain(of_files).map(|(name, meaning)| Entry { exit_code: None, name, meaning });
    let asked = |entry: &Entry| code.is_none_or(|code| entry.name == code || entry.exit_code.is_some_and(|exit| exit.to_string() == code));
    let entries: Vec<Entry> = exits.into_iter().chain(faults).filter(asked).collect();
    if let Some(signal) = code.and_then(signal_of).filter(|_| entries.is_empty()) {
        let meaning = format!("128 + {signal}: signal {signal} ended the program; what was recorded until then is kept\n");
        terminal.result(&meaning);
        return Outcome::Passed;
    }
    if entries.is_empty() {
        terminal.error(&format!("error: no such code: {}; cpdmp explain lists all\n", code.unwrap_or_default()));
        return Outcome::Usage;
    }
    match terminal.format {
        Format::Json => entries.iter().for_each(|entry| terminal.json(entry)),
        Format::Human => terminal.result(&table(&entries, code.is_none())),
    }
    Outcome::Passed
}

/// The signal whose exit code this is.
fn signal_of(code: &str) -> Option<u8> {
    code.parse::<u8>().ok()?.checked_sub(128).filter(|signal| (1..65).contains(signal))
}

fn table(entries: &[Entry], all: bool) -> String {
    let mut text = String::new();
    let (exits, faults): (Vec<&Entry>, Vec<&Entry>) = entries.iter().partition(|entry| entry.exit_code.is_some());
    if !exits.is_empty() {
        text += "Exit codes (of several, the worst outcome counts; 128 + n when signal n ended the program)\n";
        text.extend(
            exits.iter().map(|entry| format!("{:>4}  {:<18} {}\n", entry.exit_code.unwrap_or_default(), entry.name, entry.meaning)),
        );
    }
    if !faults.is_empty() {
        text += if all {
            "\nFaults of scenarios, stored runs and movements (all lead to exit code 3)\n"
        } else {
            "Fault of an input (exit code 3)\n"
        };
        text.extend(faults.iter().map(|entry| format!("      {:<18} {}\n", entry.name, entry.meaning)));
    }
    text
}
