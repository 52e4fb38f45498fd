//! Flags that make a stored run another one than its log tells of.

use std::path::Path;

use super::sweep::quoted;
use crate::report::InputFault;
use crate::scenario::{Code, LoadOptions, Scenario, Work, changed_keys};
use crate::simulation::moved_otherwise;

/// A stored run, as flags find it.
pub(super) struct Ran<'a> {
    path: &'a Path,
    scenario: Option<&'a Scenario>,
    resolved: String,
}

/// One flag, as typed, and what the user says with it alone.
struct Flag {
    name: &'static str,
    typed: String,
    alone: LoadOptions,
}

impl<'a> Ran<'a> {
    /// The run whose scenario lies at `path`: as it is read without flags, or the mere text where it cannot be used without them.
    pub fn new(path: &'a Path, scenario: Option<&'a Scenario>) -> Self {
        let text = || std::fs::read_to_string(path).unwrap_or_default();
        Self { path, scenario, resolved: scenario.map_or_else(text, |scenario| scenario.resolved.clone()) }
    }

    /// Whether `asked` changes more than what the run is asked.
    pub fn is_in_another_scene(&self, asked: &Scenario) -> bool {
        changed_keys(&self.resolved, &asked.resolved).iter().any(|key| first(key) != "criterion")
    }

    /// Why its log cannot be judged as `asked`, if it cannot: flags change something that moved in it, or that decided how it moved.
    pub fn untold(&self, asked: &Scenario, options: &LoadOptions) -> Option<InputFault> {
        let (moved, decided) = (self.moved(asked), self.decided(asked));
        let (flags, message) = if !moved.is_empty() {
            let flags = self.to_blame(options, |alone| !self.moved(alone).is_empty());
            let what = "begin elsewhere or be of another shape than in the run: it could move there, and where it would go now only a simulation \
                        tells";
            (flags, format!("makes {} {what}", listed(&moved)))
        } else if !decided.is_empty() {
            let flags = self.to_blame(options, |alone| !self.decided(alone).is_empty());
            let what = "which belongs to what was run: of a stored run only criteria, allowed contacts and objects that stand still can be \
                        changed, for all else only a simulation tells what comes of it";
            (flags, format!("changes {}, {what}", listed(&decided)))
        } else {
            return None;
        };
        let file = flags.first().map_or("--set", |flag| flag.name);
        let flags = flags.iter().map(|flag| flag.typed.as_str()).collect::<Vec<_>>().join(" ");
        let again = format!("cpdmp run {} {flags} --out ANOTHER_FOLDER", self.path.display());
        let message = format!("{flags} {message}; run it again: {again}");
        Some(InputFault {
            code: Code::Conflict.describe().0.to_owned(),
            warning: false,
            file: file.to_owned(),
            line: None,
            column: None,
            message,
        })
    }

    fn moved(&self, asked: &Scenario) -> Vec<String> {
        match (self.scenario.map(|scenario| &scenario.work), &asked.work) {
            (Some(Work::Arm(run)), Work::Arm(asked)) => moved_otherwise(run, asked),
            _ => Vec::new(),
        }
    }

    /// The keys that `asked` changes though they decided how the run went.
    fn decided(&self, asked: &Scenario) -> Vec<String> {
        let stands = |key: &str| {
            let Work::Arm(experiment) = &asked.work else { return false };
            experiment.objects.iter().any(|object| !object.moves() && key.split('.').nth(1) == Some(&object.name))
        };
        let is_free = |key: &str| matches!(first(key), "criterion" | "allowed_contact") || first(key) == "object" && stands(key);
        changed_keys(&self.resolved, &asked.resolved).into_iter().filter(|key| !is_free(key)).collect()
    }

    /// The flags of which each alone is to blame; all of them when none is.
    fn to_blame(&self, options: &LoadOptions, is_to_blame: impl Fn(&Scenario) -> bool) -> Vec<Flag> {
        let (blamed, others): (Vec<Flag>, Vec<Flag>) =
            flags(options).into_iter().partition(|flag| Scenario::load(self.path, &flag.alone).is_ok_and(|alone| is_to_blame(&alone)));
        if blamed.is_empty() { others } else { blamed }
    }
}

/// Every flag that makes another scenario of a file's.
fn flags(options: &LoadOptions) -> Vec<Flag> {
    let none = || options.without_overrides();
    let set = options.set.iter().map(|typed| Flag {
        name: "--set",
        typed: format!("--set {}", quoted(typed)),
        alone: LoadOptions { set: vec![typed.clone()], ..none() },
    });
    let seed = options.seed.map(|seed| Flag {
        name: "--seed",
        typed: format!("--seed {seed}"),
        alone: LoadOptions { seed: Some(seed), ..none() },
    });
    let robot = options.robot.iter().map(|robot| Flag {
        name: "--robot",
        typed: format!("--robot {}", quoted(robot)),
        alone: LoadOptions { robot: Some(robot.clone()), ..none() },
    });
    set.chain(seed).chain(robot).collect()
}

fn first(key: &str) -> &str {
    key.split('.').next().unwrap_or_default()
}

fn listed(names: &[String]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(" and ")
}
