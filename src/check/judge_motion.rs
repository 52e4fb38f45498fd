//! Judges a movement that was not simulated: what it touches, how near it comes, whether the joints can go that way.

use super::judge::{Answer, belongs, clearance_of, no_contact};
use super::judge_objects::no_collision;
use super::{Criterion, CriterionKind, CriterionSpec, Expectation};
use crate::simulation::{Experiment, MotionOutcome};
use crate::world::ContactEpisode;

/// Furthest that the tool may stay away from a pose that it is asked for (m): what the controller holds.
const REACH_M: f64 = 1e-3;
/// Furthest that it may be turned away from it (rad): so much moves a fingertip, 20 cm from the wrist, by a millimetre.
const REACH_RAD: f64 = 5e-3;

/// Whether the arm can go that way (joint limits, speeds, places and orientations), whether it touches anything that the scene does not allow, and all of
/// `specs` in their order. Geometry answers those about contacts and clearances; of the others it says why it does not judge them.
#[must_use]
pub fn judge_motion(outcome: &MotionOutcome, experiment: &Experiment, specs: &[CriterionSpec]) -> Vec<Criterion> {
    let own = |name: &str, answer: Answer, upper: bool| {
        let spec = CriterionSpec { name: name.to_owned(), kind: CriterionKind::NoCollision, expect: Expectation::Pass };
        answer.criterion(&spec, upper)
    };
    let held: Vec<ContactEpisode> = outcome.collisions.iter().filter(|contact| !is_shown(contact, specs)).cloned().collect();
    let mut criteria = vec![own("contacts_allowed", no_collision(&held), true)];
    let failed = |fails: bool, time_s: f64| fails.then_some(time_s);
    let (limit, speed) = (&outcome.limit, &outcome.speed);
    let limit = Answer::at_least(limit.value, 0.0, "rad").first_failed(failed(limit.value < 0.0, limit.time_s));
    let speed = Answer::at_most(speed.value, 1.0, "1").first_failed(failed(speed.value > 1.0, speed.time_s));
    criteria.push(own("joint_limits", limit, false));
    criteria.push(own("joint_speeds", speed, true));
    if let Some(reach) = outcome.reach {
        let answer = Answer::at_most(reach.position_error_m, REACH_M, "m");
        criteria.push(own("poses_reached", answer.first_failed(failed(reach.position_error_m > REACH_M, reach.position_time_s)), true));
        let answer = Answer::at_most(reach.orientation_error_rad, REACH_RAD, "rad");
        let turned = failed(reach.orientation_error_rad > REACH_RAD, reach.orientation_time_s);
        criteria.push(own("orientations_reached", answer.first_failed(turned), true));
    }
    criteria.extend(specs.iter().map(|spec| answered(outcome, experiment, spec)));
    criteria
}

/// Whether a criterion expects that very contact, or only reports it: then it is told, not held against the movement.
fn is_shown(contact: &ContactEpisode, specs: &[CriterionSpec]) -> bool {
    specs.iter().filter(|spec| spec.expect != Expectation::Pass).any(|spec| match &spec.kind {
        CriterionKind::NoCollision => true,
        CriterionKind::NoContact { objects } => belongs(&contact.a, objects) || belongs(&contact.b, objects),
        _ => false,
    })
}

/// All of `specs` without an answer, for that reason.
#[must_use]
pub fn not_judged(specs: &[CriterionSpec], reason: &'static str) -> Vec<Criterion> {
    specs.iter().map(|spec| unanswered(spec, reason)).collect()
}

fn unanswered(spec: &CriterionSpec, reason: &'static str) -> Criterion {
    let answer = Answer::at_most(f64::NAN, f64::NAN, "1").criterion(spec, true);
    Criterion { not_judged: Some(reason), ..answer }
}

fn answered(outcome: &MotionOutcome, experiment: &Experiment, spec: &CriterionSpec) -> Criterion {
    match &spec.kind {
        CriterionKind::NoContact { objects } => no_contact(&outcome.collisions, experiment, objects).criterion(spec, true),
        CriterionKind::NoCollision => no_collision(&outcome.collisions).criterion(spec, true),
        CriterionKind::Clearance { objects, links, min_m } => {
            clearance_of(&outcome.clearances, objects, links, *min_m).criterion(spec, false)
        }
        CriterionKind::ObjectInContainer { .. } | CriterionKind::ObjectAt { .. } | CriterionKind::DoorOpen { .. } => {
            unanswered(spec, "where objects end is told by a simulation, not by a movement of the arm")
        }
        CriterionKind::ArcFollowed { .. } | CriterionKind::HookKept { .. } => {
            unanswered(spec, "how a door and the arm move together is told by a simulation, not by a movement of the arm")
        }
        CriterionKind::ToolForce { .. } | CriterionKind::HumanForce { .. } | CriterionKind::ExpectedForce { .. } => {
            unanswered(spec, "a movement has no forces")
        }
        CriterionKind::GoalReached { .. } | CriterionKind::GripperOverObject { .. } | CriterionKind::ComplianceWindow { .. } => {
            unanswered(spec, "it asks what a skill commands, which a movement does not tell")
        }
        CriterionKind::ReferenceUnmoved { .. } | CriterionKind::GripperUnmoved { .. } => {
            unanswered(spec, "it asks about the pushes of a person, of which a movement tells nothing")
        }
        CriterionKind::PlanarClearance { .. } | CriterionKind::PlanarSidesPassed { .. } | CriterionKind::PlanarCollides { .. } => {
            unanswered(spec, "it asks about paths in a plane")
        }
    }
}
