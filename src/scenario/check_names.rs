//! Names that refer to something: objects, parameters, and the values that parameters hand on.

use std::collections::BTreeSet;

use super::check_taught::MAX_DEMONSTRATIONS;
use super::checks::list;
use super::fault::{Code, ENOUGH, Fault};
use super::key::{Kind, To};
use super::measure::{Measure, plain};
use super::schema::SCENARIO;
use super::source::Origin;
use super::suggest::{did_you_mean, name_list};
use super::tree::{Node, Value};
use super::walk::walk;

/// No two items of a list may bear one name.
pub(super) fn unique_names(scenario: &Node, key: &str, faults: &mut Vec<Fault>) {
    let mut seen = BTreeSet::new();
    for item in list(scenario, key) {
        if let (Some(name), Some(node)) = (item.name(), item.get("name"))
            && !seen.insert(name)
        {
            let fault = Fault::at(Code::DuplicateName, node.origin, format!("a second {key} has the name `{name}`"));
            faults.push(fault.expected(format!("a name of its own for each {key}")));
        }
    }
}

/// What a recording and its figures call the run itself.
const NAMES_OF_THE_RUN: [&str; 5] = ["executed", "run", "planned", "taught", "start"];

/// What is executed beside the run is called something else than what is of the run.
pub(super) fn names_beside(scenario: &Node, faults: &mut Vec<Fault>) {
    for node in list(scenario, "beside").iter().filter_map(|item| item.get("name")) {
        if node.as_text().is_some_and(|name| NAMES_OF_THE_RUN.contains(&name.to_ascii_lowercase().as_str())) {
            let message = "a recording calls something of the run itself so".to_owned();
            faults
                .push(Fault::at(Code::DuplicateName, node.origin, message).expected("a name that says what differs, such as `uncoupled`"));
        }
    }
}

/// Names of objects and parameters, wherever the table of keys says that one is meant.
pub(super) fn references(scenario: &Node, faults: &mut Vec<Fault>) {
    walk(scenario, &SCENARIO, &mut |key, node| match &key.kind {
        _ if faults.len() > ENOUGH => {}
        Kind::Reference(to) => faults.extend(reference(scenario, *to, node)),
        Kind::References(to) => faults.extend(node.items().iter().filter_map(|item| reference(scenario, *to, item)).take(ENOUGH)),
        Kind::Quantity(measure) if node.as_text().is_some() => {
            faults.extend(reference(scenario, To::Parameter, node));
            quantity_in_range(scenario, key.name, measure, node, faults);
        }
        _ => {}
    });
}

fn reference(scenario: &Node, to: To, node: &Node) -> Option<Fault> {
    let name = node.as_text()?;
    let known = known_names(scenario, to);
    // Without a list of what there is, because of a fault told elsewhere, nothing can be said about names.
    let unusable = scenario.entry(to.list()).is_some_and(|entry| entry.node.value == Value::Missing);
    if unusable || known.contains(&name) {
        return None;
    }
    Some(unknown_name(name, node.origin, to, known))
}

/// The fault of a name that nothing bears.
pub(super) fn unknown_name(name: &str, origin: Origin, to: To, known: Vec<&str>) -> Fault {
    let expected = if known.is_empty() {
        format!("the scenario to have {}", to.describe())
    } else {
        format!("one of {}", name_list(known.iter().copied()))
    };
    let fault = Fault::at(Code::UnknownName, origin, format!("`{name}` is not the name of {}", to.describe()));
    fault.expected(expected).maybe_help(did_you_mean(name, known))
}

/// The names that can be referred to.
pub(super) fn known_names(scenario: &Node, to: To) -> Vec<&str> {
    let objects = list(scenario, "object");
    match to {
        To::Parameter => scenario.get("parameters").map_or(&[][..], Node::entries).iter().map(|entry| entry.key.as_str()).collect(),
        To::Object => objects.iter().filter_map(Node::name).collect(),
        To::MovableObject => {
            let moves = |object: &&Node| object.get("kind").is_none_or(|node| matches!(node.as_text(), Some("ball" | "box" | "cylinder")));
            objects.iter().filter(moves).filter_map(Node::name).collect()
        }
        To::ObjectOfKind(kind) => {
            let of_kind = |object: &&Node| object.get("kind").is_none_or(|node| node.as_text() == Some(kind));
            objects.iter().filter(of_kind).filter_map(Node::name).collect()
        }
    }
}

/// The values that a parameter takes must suit the key that it stands for, in execution and in every demonstration.
fn quantity_in_range(scenario: &Node, key: &str, measure: &Measure, node: &Node, faults: &mut Vec<Fault>) {
    let Some(name) = node.as_text() else { return };
    let executed = scenario.get("parameters").and_then(|parameters| parameters.get(name));
    let taught =
        scenario.get("teaching").and_then(|teaching| teaching.get("grid")).and_then(|grid| grid.get(name)).map_or(&[][..], Node::items);
    for value in executed.into_iter().chain(taught.iter().take(MAX_DEMONSTRATIONS)) {
        if let Some(number) = value.as_number().filter(|number| !measure.accepts(*number)) {
            let message = format!("`{name}` is {}, but it stands for `{key}`", plain(number));
            let fault = Fault::at(Code::OutOfRange, value.origin, message).expected(measure.describe());
            faults.push(fault);
        }
    }
}
