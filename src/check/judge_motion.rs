//! Judges a movement that was not simulated: what it touches, how near it comes, whether the joints can go that way.

use super::judge::{Answer, belongs, clearance_of, no_contact};
use super::judge_objects::no_collision;
use super::{Criterion, CriterionKind, CriterionSpec, Expectation};
use crate::simulation::{Experiment, MotionOutcome, Reach};
use crate::world::ContactEpisode;

/// Why nothing is said about contacts and clearances of a movement that leaves the limits by far.
const FAR: &str = "the joints go far beyond their limits, where the arm is not looked at";

/// Whether the arm can go that way (joint limits, speeds, places and orientations), whether it touches anything that the scene does not allow, and all of
/// `specs` in their order. Geometry answers those about contacts and clearances; of the others it says why it does not judge them.
#[must_use]
pub fn judge_motion(outcome: &MotionOutcome, experiment: &Experiment, specs: &[CriterionSpec]) -> Vec<Criterion> {
    let asked = |name: &str| CriterionSpec { name: name.to_owned(), kind: CriterionKind::NoCollision, expect: Expectation::Pass };
    let own = |name: &str, answer: Answer, upper: bool| answer.criterion(&asked(name), upper);
    let held: Vec<ContactEpisode> = outcome.collisions.iter().filter(|contact| !is_shown(contact, specs)).cloned().collect();
    let mut criteria = vec![match outcome.far {
        Some(_) => unanswered(&asked("contacts_allowed"), FAR),
        None => own("contacts_allowed", no_collision(&held), true),
    }];
    let (limit, speed) = (&outcome.limit, &outcome.speed);
    let limit = Answer::at_least(limit.value, 0.0, "rad").first_failed(limit.first_failed_s);
    let speed = Answer::at_most(speed.value, 1.0, "1").first_failed(speed.first_failed_s);
    criteria.push(own("joint_limits", limit, false));
    criteria.push(own("joint_speeds", speed, true));
    if let Some(reach) = outcome.reach {
        let answer = Answer::at_most(reach.position_error_m, Reach::POSITION_M, "m");
        criteria.push(own("poses_reached", answer.first_failed(reach.position_failed_s), true));
        let answer = Answer::at_most(reach.orientation_error_rad, Reach::ORIENTATION_RAD, "rad");
        criteria.push(own("orientations_reached", answer.first_failed(reach.orientation_failed_s), true));
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
        CriterionKind::NoContact { .. } | CriterionKind::NoCollision | CriterionKind::Clearance { .. } if outcome.far.is_some() => {
            unanswered(spec, FAR)
        }
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
