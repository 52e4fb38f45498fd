//! Way-points at the opening of a door: there is such a door, and it opens so far.

use super::checks::list;
use super::fault::{Code, Fault};
use super::measure::plain;
use super::tree::Node;

/// Every way-point with an opening lies at a cabinet whose door opens that far.
pub(super) fn openings(scenario: &Node, teaching: &Node, faults: &mut Vec<Fault>) {
    for waypoint in list(teaching, "waypoint") {
        let Some(opening) = waypoint.get("opening_rad") else { continue };
        let Some(angle) = opening.as_number() else { continue };
        let Some(door) = cabinet(scenario, waypoint) else {
            let fault = Fault::at(Code::Conflict, opening.origin, "this way-point has an opening, but lies at no door");
            faults.push(fault.expected("`at` to name an object of kind `cabinet`"));
            continue;
        };
        if let Some(limit) = door.get("opening_max_rad").and_then(Node::as_number).filter(|limit| angle > *limit) {
            let message =
                format!("this way-point is at an opening of {} rad, but the door opens no further than {}", plain(angle), plain(limit));
            let fault = Fault::at(Code::OutOfRange, opening.origin, message);
            faults.push(fault.expected(format!("at most {} rad, or a greater `opening_max_rad` of the cabinet", plain(limit))));
        }
    }
}

/// The cabinet that a way-point lies at.
fn cabinet<'a>(scenario: &'a Node, waypoint: &Node) -> Option<&'a Node> {
    let name = waypoint.get("at").and_then(Node::as_text)?;
    let object = list(scenario, "object").iter().find(|object| object.name() == Some(name))?;
    (object.get("kind").and_then(Node::as_text) == Some("cabinet")).then_some(object)
}
