//! What cannot stand beside an experiment in a plane, and what needs one.

use super::checks::{is_typed, list};
use super::fault::{Code, Fault};
use super::tree::{Node, Value};

/// Tables of an arm, its world and its person.
const OF_ARMS: [&str; 11] = [
    "parameters",
    "demonstrations",
    "robot",
    "simulation",
    "object",
    "teaching",
    "coupling",
    "execution",
    "human",
    "allowed_contact",
    "beside",
];

/// Keys of the learning that planar experiments decide themselves.
const DECIDED: [&str; 5] = ["theta_m", "theta_f", "space", "shaping", "lwr_ends"];

/// Keys of the learning about what movements in a plane do not have: forces, compliance to them, an orientation.
const ABSENT: [&str; 3] = ["force", "compliance", "orientation_basis"];

/// Keys of the learning that mean nothing for one kind of experiment: where LWR-DMP is no rival, its basis.
const ABSENT_FROM: [(&str, &str); 1] = [("two_sided_obstacle", "lwr_basis")];

/// The filled scenario without what means nothing to it: defaults that nobody typed, and that could not be typed.
pub(super) fn without_arm(mut scenario: Node) -> Node {
    if let Some(kind) = scenario.get("planar").map(kind_of) {
        OF_ARMS.iter().for_each(|key| _ = scenario.take(key));
        if let Value::Table(entries) = &mut scenario.value
            && let Some(learning) = entries.iter_mut().find(|entry| entry.key == "learning")
        {
            meaningless(&kind).for_each(|(key, _)| _ = learning.node.take(key));
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
        let kind = scenario.get("planar").map(kind_of).unwrap_or_default();
        let typed = meaningless(&kind).filter_map(|(key, why)| Some((learning.filter(|table| is_typed(table, key))?.entry(key)?, why)));
        faults.extend(typed.map(|(entry, why)| {
            let message = format!("`learning.{}` means nothing for a planar experiment, which {why}", entry.key);
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

/// The kind of the experiment; empty if there is none, or none that is known.
fn kind_of(planar: &Node) -> String {
    planar.get("kind").and_then(Node::as_text).unwrap_or_default().to_owned()
}

/// Keys of `[learning]` that mean nothing for a kind of experiment, and why.
fn meaningless(kind: &str) -> impl Iterator<Item = (&'static str, &'static str)> {
    let decided = DECIDED.iter().map(|key| (*key, "decides it itself"));
    let absent = ABSENT.iter().map(|key| (*key, "has no such thing"));
    let of_kind = ABSENT_FROM.iter().filter(move |(of, _)| *of == kind).map(|(_, key)| (*key, "has no such thing"));
    decided.chain(absent).chain(of_kind)
}
