//! Which of the global flags means something to which command: the others are refused and left out of that command's help.
//!
//! What the environment says is for all commands of a shell, so that it is refused by none.

use std::ffi::OsString;

use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Command, CommandFactory};

use super::args::Cli;

/// Flags about output and threads, which leave the result as it is: every command takes them.
const ANYWHERE: [&str; 6] = ["jobs", "format", "verbose", "quiet", "color", "no_progress"];

/// Every command with the other flags that it takes.
const TAKEN: [(&str, &[&str]); 18] = [
    ("run", &["set", "seed", "robot", "asset_root", "lenient", "deny_warnings", "out", "timeout"]),
    ("check", &["set", "seed", "robot", "asset_root", "lenient", "deny_warnings", "timeout"]),
    ("validate", &["set", "seed", "robot", "asset_root", "lenient", "deny_warnings"]),
    ("sweep", &["set", "seed", "robot", "asset_root", "lenient", "deny_warnings", "out", "timeout"]),
    ("replay", &["set", "seed", "robot", "asset_root", "lenient", "deny_warnings", "timeout"]),
    ("teach", &["set", "seed", "robot", "asset_root", "lenient", "deny_warnings", "out", "timeout"]),
    ("learn", &["set", "seed", "lenient", "out"]),
    ("list", &["asset_root", "lenient", "deny_warnings"]),
    ("figures", &["asset_root", "out"]),
    ("generate", &["out"]),
    ("merge", &["out"]),
    ("man", &["out"]),
    ("inspect", &[]),
    ("view", &[]),
    ("migrate", &[]),
    ("explain", &[]),
    ("schema", &[]),
    ("completions", &[]),
];

/// The command line, with the help of every command about the flags that it takes.
pub(super) fn command() -> Command {
    let program = Cli::command();
    let flags: Vec<Arg> = program.get_arguments().filter(|flag| flag.is_global_set()).cloned().collect();
    TAKEN.iter().fold(program, |program, (name, taken)| {
        let hidden = flags.iter().filter(|flag| !is_taken(taken, flag.get_id().as_str())).map(|flag| flag.clone().hide(true));
        program.mut_subcommand(name, |command| command.args(hidden))
    })
}

/// Every flag that was typed and means nothing to the command, with the commands that take it.
pub(super) fn without_effect(matches: &ArgMatches) -> Vec<String> {
    let Some((name, typed)) = matches.subcommand() else { return Vec::new() };
    let taken = TAKEN.iter().find(|(command, _)| *command == name).map_or(&[][..], |(_, taken)| taken);
    let program = Cli::command();
    let flags = program.get_arguments().filter(|flag| flag.is_global_set());
    let useless = flags.filter(|flag| {
        let id = flag.get_id().as_str();
        !is_taken(taken, id) && typed.value_source(id) == Some(ValueSource::CommandLine)
    });
    let told = |flag: &Arg| {
        let takers = TAKEN.iter().filter(|(_, taken)| taken.contains(&flag.get_id().as_str())).map(|(command, _)| *command);
        let takers = takers.collect::<Vec<_>>().join(", ");
        format!("--{} does nothing for cpdmp {name}: leave it out (it is for {takers})", flag.get_long().unwrap_or_default())
    };
    useless.map(told).collect()
}

/// The command in a command line that may make no sense otherwise: the first word that is called as one and is not the value of a flag.
pub(super) fn command_of(words: &[OsString]) -> Option<&str> {
    let program = Cli::command();
    let takes_value = |flag: &str| {
        let mut flags = program.get_arguments().filter(|argument| argument.get_long() == Some(flag));
        flags.next().is_some_and(|argument| argument.get_action().takes_values())
    };
    let mut words = words.iter().map(|word| word.to_str().unwrap_or_default());
    while let Some(word) = words.next() {
        match word.strip_prefix("--") {
            Some(flag) if takes_value(flag) => _ = words.next(),
            _ if TAKEN.iter().any(|(command, _)| *command == word) => return Some(word),
            _ => {}
        }
    }
    None
}

fn is_taken(taken: &[&str], flag: &str) -> bool {
    taken.contains(&flag) || ANYWHERE.contains(&flag)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(words: &[&str]) -> Vec<String> {
        let matches = command().try_get_matches_from(words).unwrap_or_else(|error| panic!("{error}"));
        without_effect(&matches)
    }

    #[test]
    fn the_table_names_every_command_and_every_flag() {
        command().debug_assert();
        let program = Cli::command();
        let names: Vec<&str> = program.get_subcommands().map(Command::get_name).collect();
        assert!(names.iter().all(|name| TAKEN.iter().any(|(command, _)| command == name)), "{names:?}");
        for flag in program.get_arguments().filter(|flag| flag.is_global_set()) {
            let id = flag.get_id().as_str();
            assert!(ANYWHERE.contains(&id) || TAKEN.iter().any(|(_, taken)| taken.contains(&id)), "nobody takes --{id}");
        }
        let known = |id: &&str| program.get_arguments().any(|flag| flag.get_id() == *id);
        assert!(ANYWHERE.iter().chain(TAKEN.iter().flat_map(|(_, taken)| *taken)).all(known));
    }

    #[test]
    fn a_flag_without_effect_is_told_wherever_it_is_typed() {
        assert!(refused(&["cpdmp", "learn", "d", "--set", "a=1", "--seed", "1", "--jobs", "2", "-v"]).is_empty());
        let told = refused(&["cpdmp", "--robot", "a.urdf", "learn", "d", "--timeout", "1"]);
        assert_eq!(told.len(), 2, "{told:?}");
        assert!(told.iter().any(|told| told.starts_with("--robot does nothing for cpdmp learn")), "{told:?}");
        assert!(told.iter().any(|told| told.starts_with("--timeout does nothing for cpdmp learn")), "{told:?}");
    }
}
