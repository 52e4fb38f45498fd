//! Flags that make a stored run another one than its log tells of.

use std::path::Path;

use super::sweep::quoted;
use crate::report::InputFault;
use crate::scenario::{LoadOptions, Scenario, Work};
use crate::simulation::moved_otherwise;

/// Why the log of the run whose scenario lies at `path` cannot be judged as `asked`, if it cannot: flags change something that moved in it.
pub(super) fn untold(path: &Path, recorded: &Scenario, asked: &Scenario, options: &LoadOptions) -> Option<InputFault> {
    let names = moved(recorded, asked);
    if names.is_empty() {
        return None;
    }
    let is_to_blame = |typed: &&String| {
        let alone = LoadOptions { set: vec![(*typed).clone()], ..options.without_overrides() };
        Scenario::load(path, &alone).is_ok_and(|alone| !moved(recorded, &alone).is_empty())
    };
    let mut flags: Vec<&String> = options.set.iter().filter(is_to_blame).collect();
    if flags.is_empty() {
        flags.extend(&options.set);
    }
    let flags = flags.iter().map(|typed| format!("--set {}", quoted(typed))).collect::<Vec<_>>().join(" ");
    let names = names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(" and ");
    let message = format!(
        "{flags} makes {names} begin elsewhere or be of another shape than in the run: it could move there, and where it would go now only a \
         simulation tells; run it again: cpdmp run {} {flags} --out ANOTHER_FOLDER",
        path.display()
    );
    Some(InputFault { code: "conflict".to_owned(), warning: false, file: "--set".to_owned(), line: None, column: None, message })
}

fn moved(recorded: &Scenario, asked: &Scenario) -> Vec<String> {
    match (&recorded.work, &asked.work) {
        (Work::Arm(run), Work::Arm(asked)) => moved_otherwise(run, asked),
        _ => Vec::new(),
    }
}
