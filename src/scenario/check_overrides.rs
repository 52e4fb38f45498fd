//! What somebody varies from outside the files, and what would change nothing.

use std::collections::BTreeSet;

use super::check_names::unknown_name;
use super::checks::is_typed;
use super::fault::Fault;
use super::key::{Kind, To};
use super::schema::SCENARIO;
use super::source::Sources;
use super::tree::Node;
use super::walk::walk;

/// Parameters that flags or a sweep give a value, but that nothing in the scenario asks for: most often a slip of the keyboard.
pub(super) fn parameters_without_effect(scenario: &Node, sources: &Sources, faults: &mut Vec<Fault>) {
    if is_typed(scenario, "planar") {
        return;
    }
    let used = used_parameters(scenario);
    let given = scenario.get("parameters").map_or(&[][..], Node::entries);
    let without = given.iter().filter(|entry| !sources.is_of_a_file(entry.origin) && !used.contains(entry.key.as_str()));
    faults.extend(without.map(|entry| {
        let fault = unknown_name(&entry.key, entry.origin, To::Parameter, used.iter().copied().collect());
        Fault { message: format!("nothing in the scenario asks for a parameter `{}`: it would change nothing", entry.key), ..fault }
    }));
}

/// The parameters that objects, the teaching or the models ask for.
fn used_parameters(scenario: &Node) -> BTreeSet<&str> {
    let mut used = BTreeSet::new();
    walk(scenario, &SCENARIO, &mut |key, node| match &key.kind {
        Kind::Quantity(_) | Kind::Reference(To::Parameter) => used.extend(node.as_text()),
        Kind::References(To::Parameter) => used.extend(node.items().iter().filter_map(Node::as_text)),
        Kind::Grid => used.extend(node.entries().iter().map(|entry| entry.key.as_str())),
        _ => {}
    });
    used
}
