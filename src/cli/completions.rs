//! `cpdmp completions`: what a shell needs to complete the command line.

use clap_complete::Shell;

use super::global_flags;
use super::terminal::Terminal;
use crate::report::Outcome;

/// Prints the completions of one shell.
pub(super) fn completions(shell: Shell, terminal: &Terminal) -> Outcome {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut global_flags::command(), "cpdmp", &mut script);
    terminal.result(&String::from_utf8_lossy(&script));
    Outcome::Passed
}
