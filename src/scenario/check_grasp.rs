//! What a scene asks of the gripper that the engine does not do by default.

use super::checks::list;
use super::fault::{Code, Fault};
use super::tree::{Node, Value};

/// Solver iterations at which a gripper holds a flat or round side, measured with boxes of 0.05 to 1 kg; a ball needs one.
const ITERATIONS: f64 = 4.0;

/// Warns where the gripper closes on the way, and what it may close around is a box or a cylinder that one solver iteration lets slip.
pub(super) fn grasps(scenario: &Node, teaching: &Node, faults: &mut Vec<Fault>) {
    let gripper = |waypoint: &Node| waypoint.get("gripper").and_then(Node::as_number);
    let openings: Vec<f64> = list(teaching, "waypoint").iter().filter_map(gripper).collect();
    // A gripper that is closed from the start pushes; one that closes on the way, or starts open without a word, grasps.
    let begins_closed = list(teaching, "waypoint").first().and_then(gripper).is_some_and(|opening| opening < 0.5);
    let closes = !begins_closed && openings.iter().any(|opening| *opening < 0.5);
    let iterations = scenario.get("simulation").and_then(|table| table.get("solver_iterations")).and_then(Node::as_number);
    if !closes || iterations.is_some_and(|iterations| iterations >= ITERATIONS) {
        return;
    }
    for object in list(scenario, "object") {
        let kind = object.get("kind").and_then(Node::as_text).filter(|kind| ["box", "cylinder"].contains(kind));
        let fixed = object.get("fixed").is_some_and(|fixed| fixed.value == Value::Flag(true));
        if let (Some(kind), false, Some(name)) = (kind, fixed, object.get("name")) {
            let message = format!("the gripper closes in this scene, but so few solver iterations let a {kind} slip out of it");
            let fault = Fault::at(Code::Conflict, name.origin, message).expected("[simulation] solver_iterations = 4, or more");
            faults.push(fault.warning());
        }
    }
}
