//! What cannot stand beside an experiment in a plane, and what needs one.

use super::checks::{is_typed, list};
use super::fault::{Code, Fault};
use super::tree::{Node, Value};

/// Tables of an arm, its world and its person.
const OF_ARMS: [&str; 9] = ["parameters", "demonstrations", "robot", "simulation", "object", "teaching", "coupling", "execution", "human"];

/// Keys of the learning that planar experiments decide themselves.
const DECIDED: [&str; 6] = ["theta_m", "theta_f", "space", "shaping", "force", "compliance"];

/// The filled scenario without what means nothing to it: defaults that nobody typed, and that could not be typed.
pub(super) fn without_arm(mut scenario: Node) -> Node {
    if scenario.get("planar").is_some() {
        OF_ARMS.iter().for_each(|key| _ = scenario.take(key));
        if let Value::Table(entries) = &mut scenario.value
            && let Some(learning) = entries.iter_mut().find(|entry| entry.key == "learning")
        {
            DECIDED.iter().for_each(|key| _ = learning.node.take(key));
        }
    }
    scenario
}

/// Keys of arms beside `[planar]`, and criteria about the other kind of run.
pub(super) fn planar(scenario: &Node, faults: &mut Vec<Fault>) {
    let planar = is_typed(scenario, "planar");
    if planar {
        let beside = OF_ARMS.iter().filter(|key| is_typed(scenario, key)).filter_map(|key| scenario.entry(key));
        faults.extend(beside.map(|entry| {
            let message = format!("`{}` is about an arm, but [planar] has none", entry.key);
            Fault::at(Code::Conflict, entry.origin, message).expected("a planar experiment, or an arm").help("leave one of them out")
        }));
        let learning = scenario.get("learning");
        let decided = DECIDED.iter().filter_map(|key| learning.filter(|table| is_typed(table, key))?.entry(key));
        faults.extend(decided.map(|entry| {
            let message = format!("`learning.{}` means nothing for a planar experiment, which decides it itself", entry.key);
            Fault::at(Code::Conflict, entry.origin, message).help("leave it out")
        }));
    }
    for kind in list(scenario, "criterion").iter().filter_map(|criterion| criterion.get("kind")) {
        let Some(word) = kind.as_text().filter(|word| word.starts_with("planar_") != planar) else { continue };
        let message = format!("a criterion of kind `{word}` has nothing to judge here");
        let expected = if planar { "a kind that begins with `planar_`" } else { "a kind about the arm" };
        faults.push(Fault::at(Code::Conflict, kind.origin, message).expected(expected));
    }
}
