//! What is taught against what is asked for: the grid of the lessons, and the setting in which the skill is executed.

use super::check_names::{known_names, unknown_name};
use super::fault::{Code, Fault};
use super::key::To;
use super::measure::plain;
use super::tree::Node;

/// Most demonstrations that one scenario may teach.
pub(super) const MAX_DEMONSTRATIONS: usize = 1000;

/// What the grid of the lessons varies.
pub(super) fn grid(scenario: &Node, teaching: &Node, faults: &mut Vec<Fault>) {
    let entries = teaching.get("grid").map_or(&[][..], Node::entries);
    let known = known_names(scenario, To::Parameter);
    for entry in entries.iter().filter(|entry| !known.contains(&entry.key.as_str())) {
        faults.push(unknown_name(&entry.key, entry.origin, To::Parameter, known.clone()));
    }
    let demonstrations = entries.iter().map(|entry| entry.node.items().len()).fold(1, usize::saturating_mul);
    if let (true, Some(node)) = (demonstrations > MAX_DEMONSTRATIONS, teaching.get("grid")) {
        let fault = Fault::at(Code::OutOfRange, node.origin, format!("this grid makes {demonstrations} demonstrations"));
        faults.push(fault.expected(format!("at most {MAX_DEMONSTRATIONS}")));
    }
}

/// A model can only learn what a parameter does from lessons that vary it, and says less the farther away it is asked.
pub(super) fn parameters_are_taught(scenario: &Node, teaching: &Node, faults: &mut Vec<Fault>) {
    let Some(learning) = scenario.get("learning") else { return };
    for told in ["theta_m", "theta_f"].iter().filter_map(|key| learning.get(key)).flat_map(Node::items) {
        let Some(name) = told.as_text() else { continue };
        let Some(asked) = scenario.get("parameters").and_then(|parameters| parameters.get(name)) else { continue };
        let taught = teaching.get("grid").and_then(|grid| grid.get(name)).map_or(Vec::new(), Node::as_numbers);
        let (low, high) = taught.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &value| (low.min(value), high.max(value)));
        if low >= high || taught.is_empty() {
            let message = format!("`{name}` is the same in all demonstrations: nothing can be learned about it");
            faults.push(Fault::at(Code::Untaught, told.origin, message).expected("a parameter that the grid varies").warning());
        } else if let Some(value) = asked.as_number().filter(|value| !(low..=high).contains(value)) {
            let message = format!("`{name}` is {}, but it was taught from {} to {} only", plain(value), plain(low), plain(high));
            faults.push(Fault::at(Code::Untaught, asked.origin, message).help("the skill extrapolates").warning());
        }
    }
}
