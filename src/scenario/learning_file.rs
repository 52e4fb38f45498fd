//! The `[learning]` table on its own: settings for learning from a dataset without a scenario, checked as a scenario's are.

use std::path::{Path, PathBuf};

use super::build_learning;
use super::check_learning::ends_of_no_baseline;
use super::checks::is_typed;
use super::conform::Conform;
use super::diagnostic::{Diagnostic, InvalidScenario, diagnose};
use super::fault::{Code, Fault, Severity, tolerate_unknown_keys};
use super::layer;
use super::overrides;
use super::roots::Roots;
use super::schema::LEARNING_FILE;
use super::source::{Origin, Source, Sources};
use super::tree::{Node, Value};
use crate::learning::LearningSettings;

/// What the user says about learning, each layer above the one before.
#[derive(Clone, Debug, Default)]
pub struct LearningOptions {
    /// A TOML file with a `[learning]` table.
    pub file: Option<PathBuf>,
    /// `KEY=VALUE` each, with or without `learning.` in front; a later one wins.
    pub set: Vec<String>,
    /// Flags that stand for a key of `[learning]`: how the flag is called, the key, its value as typed.
    pub flags: Vec<(&'static str, &'static str, String)>,
    /// Whether a key that nobody knows is a warning instead of an error.
    pub lenient: bool,
}

/// Settings as they were asked for, over the defaults, and what looks odd about them.
///
/// # Errors
/// Every fault of the file, the overrides and the flags at once.
pub fn learning_settings(options: &LearningOptions) -> Result<(LearningSettings, Vec<Diagnostic>), InvalidScenario> {
    let mut sources = Sources::default();
    let mut faults = Vec::new();
    let filled = read(options, &mut sources, &mut faults);
    if options.lenient {
        tolerate_unknown_keys(&mut faults);
    }
    let diagnostics = diagnose(faults, &sources);
    match filled {
        Some(filled) if diagnostics.iter().all(|found| found.severity == Severity::Warning) => {
            Ok((build_learning::learning(&filled.section("learning")), diagnostics))
        }
        _ => Err(InvalidScenario(diagnostics)),
    }
}

fn read(options: &LearningOptions, sources: &mut Sources, faults: &mut Vec<Fault>) -> Option<Node> {
    let directory = options.file.as_deref().and_then(Path::parent).unwrap_or(Path::new(""));
    let roots = Roots::new(directory, &[]);
    let mut tree = match &options.file {
        Some(path) => layer::load(path, &roots, sources, faults)?,
        None => {
            let nothing = Source { name: "settings".to_owned(), directory: PathBuf::new(), text: "".into(), rank: 0 };
            Node::new(Value::Table(Vec::new()), Origin { source: sources.add(nothing), start: 0, end: 0 })
        }
    };
    if faults.iter().any(|fault| matches!(fault.code, Code::Syntax | Code::Extends | Code::OutsideRoot | Code::WrongType)) {
        return None;
    }
    for typed in &options.set {
        overrides::set(&mut tree, "--set", &in_learning(typed), sources, faults);
    }
    for (flag, key, value) in &options.flags {
        overrides::set(&mut tree, flag, &format!("learning.{key}={value}"), sources, faults);
    }
    let filled = Conform { sources, roots: &roots, faults }.table(tree, &LEARNING_FILE, "");
    let learning = filled.get("learning");
    for key in ["theta_m", "theta_f"] {
        if let Some(node) = learning.and_then(|table| table.get(key)).filter(|node| !node.items().is_empty()) {
            let fault = Fault::at(Code::Conflict, node.origin, format!("`learning.{key}` is for scenarios"));
            faults.push(fault.expected("no such key: the dataset says which parameters its demonstrations have, or --theta does"));
        }
    }
    if let Some(space) = learning.filter(|table| is_typed(table, "space")).and_then(|table| table.get("space")) {
        let fault = Fault::at(Code::Conflict, space.origin, "`learning.space` is for scenarios");
        faults.push(fault.expected("no such key: the dataset says which columns are learned, or --motion does"));
    }
    learning.into_iter().for_each(|learning| ends_of_no_baseline(learning, faults));
    Some(filled)
}

/// The key with its table in front, which may be left out.
fn in_learning(typed: &str) -> String {
    let first = typed.split(['.', '=']).next().unwrap_or_default().trim();
    if first == "learning" { typed.to_owned() } else { format!("learning.{typed}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(set: &[&str]) -> Result<LearningSettings, String> {
        let options = LearningOptions { set: set.iter().map(|s| (*s).to_owned()).collect(), ..LearningOptions::default() };
        learning_settings(&options).map(|(settings, _)| settings).map_err(|invalid| format!("{:?}", invalid.0))
    }

    #[test]
    fn nothing_said_is_the_default_and_a_key_needs_no_table_in_front() {
        assert_eq!(of(&[]), Ok(LearningSettings::default()));
        for set in ["motion.states=7", "learning.motion.states=7"] {
            assert_eq!(of(&[set]).map(|settings| settings.motion.states), Ok(7));
        }
    }

    #[test]
    fn every_fault_is_told_and_names_the_key() {
        let faults = of(&["motion.stats=7", "stiffness=-1", "theta_m=[\"x\"]", "alpha"]).expect_err("four faults");
        for part in ["motion.stats", "states", "stiffness", "theta_m", "no `=`"] {
            assert!(faults.contains(part), "{part}: {faults}");
        }
    }
}
