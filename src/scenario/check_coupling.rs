//! The coupling against what it couples: the motion's columns, the arm's joints, the model's states.

use super::build_learning::is_automatic;
use super::checks::is_typed;
use super::fault::{Code, Fault};
use super::tree::Node;

/// Every fault between `[coupling]` and the rest of a filled scenario.
pub(super) fn coupling(scenario: &Node, faults: &mut Vec<Fault>) {
    let (Some(coupling), Some(learning)) = (scenario.get("coupling"), scenario.get("learning")) else { return };
    let joints = scenario.section("robot").get("rest_posture_rad").map_or(0, |posture| posture.items().len());
    if coupling.flag("enabled") {
        spaces(coupling, learning, joints, faults);
    }
    compliances(scenario, coupling, joints, faults);
    betas(coupling, learning, faults);
}

/// `K1 J^T K2` turns six numbers of a wrench into one number per motion column, or it turns nothing.
fn spaces(coupling: &Node, learning: &Node, joints: usize, faults: &mut Vec<Fault>) {
    let [Some(of_coupling), Some(of_motion)] = [coupling, learning].map(|table| table.get("space")) else { return };
    let (shapes, mend) = match (of_coupling.as_text(), of_motion.as_text()) {
        (Some("joint"), Some("task")) => {
            (format!("{joints} x 6, but the motion is 3 x 1 (x_m, y_m, z_m)"), "coupling.space = \"task\", or learning.space = \"joint\"")
        }
        (Some("task"), Some("joint")) => {
            (format!("3 x 3, but the motion is {joints} x 1 (q1_rad … q{joints}_rad)"), "coupling.space = \"joint\"")
        }
        _ => return,
    };
    let node = if is_typed(coupling, "space") { of_coupling } else { of_motion };
    faults.push(Fault::at(Code::WrongLength, node.origin, format!("K1 J^T K2 of the coupling (17) is {shapes}")).expected(mend));
}

/// One compliance for all, or one per column of a taught motion.
fn compliances(scenario: &Node, coupling: &Node, joints: usize, faults: &mut Vec<Fault>) {
    for (key, count, columns) in
        [("compliance_m_per_n", 3, "axes, or one each for x, y and z"), ("compliance_rad_per_nm", joints, "joints, or one each")]
    {
        if let (Some(_), Some(node)) = (scenario.get("teaching"), coupling.get(key))
            && ![1, count].contains(&node.items().len())
        {
            let fault = Fault::at(Code::WrongLength, node.origin, format!("`{key}` has {} entries", node.items().len()));
            faults.push(fault.expected(format!("one number for all {columns}")));
        }
    }
}

/// A `beta` for every state, when states are what decides.
fn betas(coupling: &Node, learning: &Node, faults: &mut Vec<Fault>) {
    let (Some(mode), Some(beta)) = (coupling.get("mode"), coupling.get("beta")) else { return };
    if mode.as_text() != Some("per_state") {
        // An empty list says nothing: a resolved scenario has one.
        if is_typed(coupling, "beta") && !beta.items().is_empty() {
            let message = format!("`coupling.beta` means nothing in the mode `{}`", mode.as_text().unwrap_or_default());
            faults.push(Fault::at(Code::Conflict, beta.origin, message).expected("mode = \"per_state\"").warning());
        }
        return;
    }
    for wrong in beta.items().iter().filter(|item| item.as_number().is_some_and(|b| ![-1.0, 0.0, 1.0].contains(&b))) {
        let message = format!("`coupling.beta` has {} among its entries", wrong.as_number().unwrap_or(f64::NAN));
        faults
            .push(Fault::at(Code::OutOfRange, wrong.origin, message).expected("-1 (complies), 0 (stiff) or 1 (meets the expected force)"));
    }
    let origin = if is_typed(coupling, "beta") { beta.origin } else { mode.origin };
    let refuse = |message: &str, expected: String| Fault::at(Code::Conflict, origin, message).expected(expected);
    let motion = learning.section("motion");
    if learning.text("shaping") == "lwr" {
        faults.push(refuse(
            "the baseline has no states that `coupling.beta` could be about",
            "another mode, or shaping = \"phmm\"".to_owned(),
        ));
    } else if is_automatic(learning, "motion", "states") || learning.text("states_criterion") != "given" {
        faults.push(refuse(
            "the demonstrations choose how many states `coupling.beta` is about",
            "a number as learning.motion.states".to_owned(),
        ));
    } else if let Some(states) = motion.get("states").and_then(Node::as_number).filter(|states| *states != beta.items().len() as f64) {
        let message = format!("`coupling.beta` has {} entries for {states} states", beta.items().len());
        faults.push(Fault::at(Code::WrongLength, origin, message).expected("one entry per state of learning.motion"));
    }
}
