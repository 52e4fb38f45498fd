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

/// Nobody leads the arm from one open door straight to another: what lies between them is carried along with neither.
pub(super) fn one_door_at_a_time(scenario: &Node, teaching: &Node, faults: &mut Vec<Fault>) {
    let open = |waypoint: &&Node| {
        let opening = waypoint.get("opening_rad")?;
        opening.as_number().filter(|angle| *angle != 0.0)?;
        Some((opening.origin, cabinet(scenario, waypoint)?.name()?.to_owned()))
    };
    for pair in list(teaching, "waypoint").windows(2) {
        if let (Some((_, from)), Some((origin, to))) = (open(&&pair[0]), open(&&pair[1]))
            && from != to
        {
            let fault = Fault::at(Code::Conflict, origin, format!("the way goes from an opening of `{from}` straight to one of `{to}`"));
            faults.push(fault.expected("a way-point without `opening_rad` between two doors"));
        }
    }
}

/// Cabinets stand square: their doors look at the robot.
pub(super) fn square_cabinets(scenario: &Node, faults: &mut Vec<Fault>) {
    for object in list(scenario, "object").iter().filter(|object| is_cabinet(object)) {
        if let Some(yaw) = object.get("yaw_rad").filter(|yaw| yaw.as_number() != Some(0.0)) {
            let fault = Fault::at(Code::Conflict, yaw.origin, "a cabinet that is turned");
            faults.push(fault.expected("no `yaw_rad`: the door of a cabinet looks along -x, towards the robot"));
        }
    }
}

fn is_cabinet(object: &Node) -> bool {
    object.get("kind").and_then(Node::as_text) == Some("cabinet")
}

/// The cabinet that a way-point lies at.
fn cabinet<'a>(scenario: &'a Node, waypoint: &Node) -> Option<&'a Node> {
    let name = waypoint.get("at").and_then(Node::as_text)?;
    let object = list(scenario, "object").iter().find(|object| object.name() == Some(name))?;
    is_cabinet(object).then_some(object)
}
