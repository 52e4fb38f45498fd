//! Answers about objects: what touched them, where they ended, and which force moving them took.

use nalgebra::Vector3;

use super::CountsFrom;
use super::judge::{Answer, first_time};
use crate::simulation::{RunOutcome, StepRecord};
use crate::world::ContactEpisode;

/// See [`CriterionKind::NoCollision`](super::CriterionKind::NoCollision).
pub(super) fn no_collision(collisions: &[ContactEpisode]) -> Answer {
    let touching = || collisions.iter().filter(|contact| !contact.allowed);
    Answer::at_most(touching().count() as f64, 0.0, "pairs").first_failed(first_time(touching()))
}

/// See [`CriterionKind::ExpectedForce`](super::CriterionKind::ExpectedForce). The skill's own time ends with the phase; what follows is not part of what it expects.
pub(super) fn expected_force(outcome: &RunOutcome, axis: usize, from: CountsFrom, max_n: f64) -> Answer {
    let counts = |step: &StepRecord| from == CountsFrom::Start || step.tool_impulse != Vector3::zeros();
    let first = outcome.steps.iter().position(counts).unwrap_or(outcome.steps.len());
    let during = || outcome.steps[first..].iter().filter(|step| step.time_fraction < 1.0);
    let squared = |step: &StepRecord| (step.wrench[axis] - step.expected_force[axis]).powi(2);
    let rms = match outcome.skill.force {
        Some(_) => (during().map(squared).sum::<f64>() / during().count() as f64).sqrt(),
        None => f64::NAN,
    };
    Answer::at_most(rms, max_n, "N")
}

/// See [`CriterionKind::ObjectAt`](super::CriterionKind::ObjectAt).
pub(super) fn object_at(outcome: &RunOutcome, object: &str, at: Option<&str>, offset_m: [f64; 3], max_m: f64) -> Answer {
    let place = |name: &str| outcome.final_objects.iter().find(|o| o.name == name).map(|o| o.position.coords);
    let origin = at.map_or(Some(Vector3::zeros()), place);
    let distance = place(object).zip(origin).map_or(f64::NAN, |(object, origin)| (object - origin - Vector3::from(offset_m)).norm());
    Answer::at_most(distance, max_m, "m")
}
