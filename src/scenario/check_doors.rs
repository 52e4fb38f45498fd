//! Doors: way-points at an opening lie at a door that opens so far, cabinets stand square, handles are on their doors.

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

/// Every handle of a cabinet's row is on its door.
pub(super) fn handles_on_doors(scenario: &Node, faults: &mut Vec<Fault>) {
    for object in list(scenario, "object").iter().filter(|object| is_cabinet(object)) {
        faults.extend(row_beyond_door(object));
        faults.extend(bar_beyond_door(object));
    }
}

/// The row of handles, from the hinge.
fn row_beyond_door(cabinet: &Node) -> Option<Fault> {
    let number = |key: &str| cabinet.get(key).and_then(Node::as_number);
    let (first, spacing, handles) = (number("first_handle_m")?, number("handle_spacing_m")?, number("handles")?);
    let (width, radius) = (*cabinet.get("door_size_m")?.as_numbers().first()?, number("handle_radius_m")?);
    let (nearest, furthest) = (radius, width - radius);
    if !(nearest - ROUNDING_M..=furthest + ROUNDING_M).contains(&first) {
        let message = format!("the first handle is {} m from the hinge, off the door, which is {} m wide", plain(first), plain(width));
        let fault = Fault::at(Code::Conflict, cabinet.get("first_handle_m")?.origin, message);
        return Some(fault.expected(format!("{} m … {} m, or a wider door (`door_size_m`)", plain(nearest), plain(furthest))));
    }
    let last = first + (handles - 1.0) * spacing;
    (last > furthest + ROUNDING_M).then(|| {
        let message =
            format!("handle {handles} of the row is {} m from the hinge, off the door, which is {} m wide", plain(last), plain(width));
        let most = (furthest - first) / (handles - 1.0);
        let expected =
            format!("at most {} m between {handles} handles, or fewer `handles`, or a wider door (`door_size_m`)", rounded_down(most));
        Fault::at(Code::Conflict, cabinet.entry("handle_spacing_m").map_or(cabinet.origin, |entry| entry.node.origin), message)
            .expected(expected)
    })
}

/// The bar of a handle, which stands upright in the middle of the door's height.
fn bar_beyond_door(cabinet: &Node) -> Option<Fault> {
    let number = |key: &str| cabinet.get(key).and_then(Node::as_number);
    let (length, radius) = (number("handle_length_m")?, number("handle_radius_m")?);
    let height = *cabinet.get("door_size_m")?.as_numbers().get(1)?;
    let most = height - 2.0 * radius;
    (length > most + ROUNDING_M).then(|| {
        let message = format!("a handle of {} m with round ends of {} m is longer than the door is high", plain(length), plain(radius));
        let origin = cabinet.entry("handle_length_m").map_or(cabinet.origin, |entry| entry.node.origin);
        Fault::at(Code::Conflict, origin, message).expected(format!("at most {} m, or a higher door (`door_size_m`)", rounded_down(most)))
    })
}

/// Lengths that differ by less are one (m): sums of decimal numbers are not exact.
const ROUNDING_M: f64 = 1e-9;

/// A limit (m) as a number that keeps it, to a tenth of a millimetre.
fn rounded_down(limit_m: f64) -> String {
    plain((limit_m.max(0.0) * 1e4 + 1e-6).floor() / 1e4)
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
