//! `cpdmp man`: the manual page of the program, and those of its commands.

use std::path::Path;

use clap::Command;
use clap_mangen::Man;

use super::global_flags;
use super::terminal::Terminal;
use crate::report::{Outcome, write_file};

/// Prints the manual page, or writes one for the program and one for each command to a folder.
pub(super) fn man(folder: Option<&Path>, terminal: &Terminal) -> Outcome {
    let mut program = global_flags::command();
    program.build();
    let Some(folder) = folder else {
        terminal.result(&page(&program));
        return Outcome::Passed;
    };
    let pages = program
        .get_subcommands()
        .filter(|command| command.get_name() != "help")
        .map(|command| (format!("cpdmp-{}.1", command.get_name()), page(command)));
    let pages: Vec<(String, String)> = std::iter::once(("cpdmp.1".to_owned(), page(&program))).chain(pages).collect();
    let written = std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()));
    let written = written
        .and_then(|()| pages.iter().try_for_each(|(name, page)| write_file(&folder.join(name), page).map_err(|error| error.to_string())));
    match written {
        Ok(()) => {
            terminal.note(&format!("{} manual pages in {}\n", pages.len(), folder.display()));
            Outcome::Passed
        }
        Err(error) => {
            terminal.error(&format!("error: {error}\n"));
            Outcome::OutputFailed
        }
    }
}

fn page(command: &Command) -> String {
    let mut page = Vec::new();
    Man::new(command.clone()).render(&mut page).expect("writing to memory does not fail");
    String::from_utf8_lossy(&page).into_owned()
}
