//! What no single key can tell: names that refer to something, times that rise, settings that agree with each other.

use super::check_coupling::coupling;
use super::check_doors::{handles_on_doors, one_door_at_a_time, openings, square_cabinets};
use super::check_grasp::grasps;
use super::check_learning::ends_of_no_baseline;
use super::check_names::{names_beside, references, unique_names};
use super::check_planar::planar;
use super::check_taught::{grid, parameters_are_taught};
use super::check_times::{pushes, waypoints, windows_of_means};
use super::fault::{Code, Fault};
use super::measure::plain;
use super::tree::{Node, Value};

/// Every fault between the keys of a filled scenario.
pub(super) fn check(scenario: &Node) -> Vec<Fault> {
    let mut faults = Vec::new();
    unique_names(scenario, "object", &mut faults);
    unique_names(scenario, "criterion", &mut faults);
    unique_names(scenario, "allowed_contact", &mut faults);
    unique_names(scenario, "beside", &mut faults);
    names_beside(scenario, &mut faults);
    references(scenario, &mut faults);
    nothing_asked(scenario, &mut faults);
    about_nothing(scenario, &mut faults);
    contacts_of_one(scenario, &mut faults);
    square_cabinets(scenario, &mut faults);
    handles_on_doors(scenario, &mut faults);
    planar(scenario, &mut faults);
    if is_typed(scenario, "planar") {
        return faults;
    }
    source_of_demonstrations(scenario, &mut faults);
    if let Some(teaching) = scenario.get("teaching") {
        grid(scenario, teaching, &mut faults);
        parameters_are_taught(scenario, teaching, &mut faults);
        waypoints(teaching, &mut faults);
        openings(scenario, teaching, &mut faults);
        grasps(scenario, teaching, &mut faults);
        one_door_at_a_time(scenario, teaching, &mut faults);
    }
    joints(scenario, &mut faults);
    scenario.get("learning").into_iter().for_each(|learning| ends_of_no_baseline(learning, &mut faults));
    coupling(scenario, &mut faults);
    rates(scenario, &mut faults);
    windows_of_means(scenario, &mut faults);
    pushes(scenario, &mut faults);
    faults
}

/// Warns where no criterion can fail.
fn nothing_asked(scenario: &Node, faults: &mut Vec<Fault>) {
    let asks = |criterion: &Node| criterion.get("expect").and_then(Node::as_text) != Some("report");
    if !list(scenario, "criterion").iter().any(asks) {
        let message = "without a criterion this passes, whatever touches and wherever the movement ends";
        faults
            .push(Fault::at(Code::NothingAsked, scenario.origin, message).expected("a [[criterion]] that is not only reported").warning());
    }
}

/// A criterion about no object holds whatever happens.
fn about_nothing(scenario: &Node, faults: &mut Vec<Fault>) {
    for node in list(scenario, "criterion").iter().filter_map(|criterion| criterion.get("objects")) {
        if node.items().is_empty() && matches!(node.value, Value::List(_)) {
            let fault = Fault::at(Code::WrongLength, node.origin, "this criterion is about no object: it could not fail");
            faults.push(fault.expected("the name of an object, or of several"));
        }
    }
}

/// Nothing touches itself: such a contact would allow nothing.
fn contacts_of_one(scenario: &Node, faults: &mut Vec<Fault>) {
    for table in list(scenario, "allowed_contact") {
        if let (Some(a), Some(b)) = (table.get("a"), table.get("b"))
            && a.as_text().is_some()
            && a.as_text() == b.as_text()
        {
            let fault = Fault::at(Code::Conflict, b.origin, "both ends of this contact are the same part: it would allow nothing");
            faults.push(fault.expected("two parts"));
        }
    }
}

/// The items of a list of the scenario.
pub(super) fn list<'a>(scenario: &'a Node, key: &str) -> &'a [Node] {
    scenario.get(key).map_or(&[], Node::items)
}

fn source_of_demonstrations(scenario: &Node, faults: &mut Vec<Fault>) {
    match (scenario.get("demonstrations"), scenario.get("teaching")) {
        (Some(dataset), Some(_)) => {
            let fault = Fault::at(Code::Conflict, dataset.origin, "both `demonstrations` and [teaching] are given");
            faults.push(fault.expected("one of them: a recorded dataset, or a virtual human who teaches"));
        }
        (None, None) if ["demonstrations", "teaching"].iter().all(|key| !is_typed(scenario, key)) => {
            let fault = Fault::at(Code::MissingKey, scenario.origin, "nothing says where the demonstrations come from");
            faults.push(fault.expected("[teaching], or demonstrations = \"PATH\""));
        }
        _ => {}
    }
}

/// Whether the key was typed at all, even if its value is of no use: what stands for an absent one has its table's origin.
pub(super) fn is_typed(table: &Node, key: &str) -> bool {
    table.entry(key).is_some_and(|entry| entry.node.origin != table.origin)
}

/// One number per joint, in every list of joints.
fn joints(scenario: &Node, faults: &mut Vec<Fault>) {
    let Some(robot) = scenario.get("robot") else { return };
    let Some(rest) = robot.get("rest_posture_rad") else { return };
    let joints = rest.items().len();
    let impedance = |key: &str| robot.get("impedance").and_then(|impedance| impedance.get(key)).cloned();
    let lists = [
        ("idle_posture_rad", robot.get("idle_posture_rad").cloned()),
        ("stiffness_nm_per_rad", impedance("stiffness_nm_per_rad")),
        ("damping_nms_per_rad", impedance("damping_nms_per_rad")),
    ];
    for (key, node) in lists.iter().filter_map(|(key, node)| Some((key, node.as_ref()?))).filter(|(_, node)| node.items().len() != joints) {
        if *key == "idle_posture_rad" && node.items().is_empty() {
            continue;
        }
        let message = format!("`{key}` has {} entries, but `rest_posture_rad` has {joints}", node.items().len());
        faults.push(Fault::at(Code::WrongLength, node.origin, message).expected("one number per joint of the arm in each of them"));
    }
}

/// Nothing can be sampled faster than it is simulated.
fn rates(scenario: &Node, faults: &mut Vec<Fault>) {
    let simulation = scenario.get("simulation");
    let Some(step) = simulation.and_then(|table| table.get("step_s")).and_then(Node::as_number) else { return };
    let sampled =
        [simulation.and_then(|table| table.get("log_rate_hz")), scenario.get("teaching").and_then(|table| table.get("record_rate_hz"))];
    for node in sampled.into_iter().flatten() {
        if let Some(rate) = node.as_number().filter(|rate| rate * step > 1.0 + 1e-9) {
            let message = format!("{} samples per second are more than the engine's steps of {} s give", plain(rate), plain(step));
            faults.push(Fault::at(Code::OutOfRange, node.origin, message).expected(format!("at most {} Hz", plain(1.0 / step))));
        }
    }
}
