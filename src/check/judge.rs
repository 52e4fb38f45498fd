//! Answers a scenario's criteria.

use super::door;
use super::judge_objects::{expected_force, no_collision, object_at};
use super::tool_force::tool_force;
use super::windows::{Window, compliance_windows, human_windows, windows};
use super::{Criterion, CriterionKind, CriterionSpec};
use crate::simulation::{Experiment, RunOutcome, StepRecord};
use crate::world::{Clearance, ContactEpisode, Object, ObjectKind};

/// Answers `specs` for the run `outcome` of `experiment`, in their order.
pub fn judge(outcome: &RunOutcome, experiment: &Experiment, specs: &[CriterionSpec]) -> Vec<Criterion> {
    specs.iter().map(|spec| answer(outcome, experiment, spec)).collect()
}

/// A measured value against its limit, before names are put to it.
pub(super) struct Answer {
    passed: bool,
    value: f64,
    limit: f64,
    unit: &'static str,
    first_failed_time_s: Option<f64>,
}

impl Answer {
    pub(super) fn at_most(value: f64, limit: f64, unit: &'static str) -> Self {
        Self { passed: value <= limit, value, limit, unit, first_failed_time_s: None }
    }

    pub(super) fn at_least(value: f64, limit: f64, unit: &'static str) -> Self {
        Self { passed: value >= limit, value, limit, unit, first_failed_time_s: None }
    }

    /// The answer to `spec`; `upper` tells whether the limit is the largest value allowed.
    pub(super) fn criterion(self, spec: &CriterionSpec, upper: bool) -> Criterion {
        Criterion {
            name: spec.name.clone(),
            expect: spec.expect,
            passed: self.passed,
            value: self.value,
            limit: self.limit,
            margin: if upper { self.limit - self.value } else { self.value - self.limit },
            unit: self.unit,
            first_failed_time_s: self.first_failed_time_s,
            not_judged: None,
        }
    }

    pub(super) fn first_failed(mut self, time_s: Option<f64>) -> Self {
        self.first_failed_time_s = time_s;
        self
    }
}

fn answer(outcome: &RunOutcome, experiment: &Experiment, spec: &CriterionSpec) -> Criterion {
    let steps = &outcome.steps;
    let (answer, upper) = match &spec.kind {
        CriterionKind::ObjectInContainer { object, container, speed_max_m_per_s } => {
            (object_in_container(outcome, experiment, object, container, *speed_max_m_per_s), true)
        }
        CriterionKind::NoContact { objects } => (no_contact(&outcome.collisions, experiment, objects), true),
        CriterionKind::DoorOpen { object, min_rad } => (door::open(outcome, experiment, object, *min_rad), false),
        CriterionKind::ArcFollowed { object, of, max_m } => (door::arc_followed(steps, experiment, object, *of, *max_m), true),
        CriterionKind::HookKept { object, max_m } => (door::hook_kept(steps, experiment, object, *max_m), true),
        CriterionKind::ToolForce { mean_over_s, max_n } => (tool_force(outcome, *mean_over_s, *max_n), true),
        CriterionKind::Clearance { objects, links, min_m } => (clearance_of(&outcome.clearances, objects, links, *min_m), false),
        // Asked of planar experiments only: of an arm there is nothing to measure.
        CriterionKind::PlanarClearance { min_m, .. } | CriterionKind::PlanarSidesPassed { min_m, .. } => {
            (Answer::at_least(f64::NAN, *min_m, "m"), false)
        }
        CriterionKind::PlanarCollides { .. } => (Answer::at_least(f64::NAN, 1.0, "settings"), false),
        CriterionKind::NoCollision => (no_collision(&outcome.collisions), true),
        CriterionKind::ExpectedForce { axis, from, max_n } => (expected_force(outcome, *axis, *from, *max_n), true),
        CriterionKind::ObjectAt { object, at, offset_m, max_m } => (object_at(outcome, object, at.as_deref(), *offset_m, *max_m), true),
        CriterionKind::GoalReached { max_m } => (goal_reached(outcome, *max_m), true),
        CriterionKind::HumanForce { max_n } => (human_force(outcome, *max_n), true),
        CriterionKind::ComplianceWindow { stiff_at } => (compliance_window(steps, experiment, stiff_at), false),
        CriterionKind::GripperOverObject { object, max_m } => (gripper_over_object(steps, experiment, object, *max_m), true),
        CriterionKind::ReferenceUnmoved { max_m } => (reference_unmoved(steps, *max_m), true),
        CriterionKind::GripperUnmoved { max_m } => (gripper_unmoved(steps, *max_m), true),
    };
    answer.criterion(spec, upper)
}

fn object_in_container(outcome: &RunOutcome, experiment: &Experiment, object: &str, container: &str, speed_max: f64) -> Answer {
    let place = |name: &str| outcome.final_objects.iter().find(|o| o.name == name);
    let spec = |name: &str| experiment.objects.iter().find(|o| o.name == name);
    let (Some(inside), Some(outside), Some(shape)) = (place(object), place(container), spec(container)) else {
        return Answer { passed: false, value: f64::NAN, limit: 0.0, unit: "m", first_failed_time_s: None };
    };
    let away = inside.position - outside.position;
    let (limit, rim) = container_size(shape);
    // Whoever sticks out at the top or rolls on is not inside, and as far from it as that, or as it goes on in a second.
    let out_m = (away.z - rim).max(-away.z).max(inside.speed_m_per_s - speed_max);
    let value = away.xy().abs().max();
    Answer::at_most(if out_m > 0.0 { value.max(limit + out_m) } else { value }, limit, "m")
}

/// Half the inner width (m) and the height of the rim above the container's origin (m).
fn container_size(container: &Object) -> (f64, f64) {
    match &container.kind {
        ObjectKind::Basket { inner_size_m, wall_height_m, wall_thickness_m, .. } => {
            (inner_size_m.min() / 2.0, wall_height_m + wall_thickness_m)
        }
        _ => (0.0, 0.0),
    }
}

/// Whether the part `name` belongs to one of the `objects`.
pub(super) fn belongs(name: &str, objects: &[String]) -> bool {
    objects.iter().any(|object| name == object || name.strip_prefix(object.as_str()).is_some_and(|rest| rest.starts_with('.')))
}

pub(super) fn no_contact(collisions: &[ContactEpisode], experiment: &Experiment, objects: &[String]) -> Answer {
    let touching = || collisions.iter().filter(|c| (belongs(&c.b, objects) || belongs(&c.a, objects)) && !standing(c, experiment));
    Answer::at_most(touching().count() as f64, 0.0, "pairs").first_failed(first_time(touching()))
}

/// The time of the first of some contacts (s).
pub(super) fn first_time<'a>(contacts: impl Iterator<Item = &'a ContactEpisode>) -> Option<f64> {
    contacts.map(|contact| contact.first_time_s).reduce(f64::min)
}

/// How deep a thing that stands on a table may be in it (m): more than the engine lets it sink, less than anything that is pushed in.
const STANDING_M: f64 = 0.005;

/// Whether the contact is nothing but an object standing on a table.
fn standing(contact: &ContactEpisode, experiment: &Experiment) -> bool {
    if contact.max_depth_m > STANDING_M {
        return false;
    }
    let table = |name: &str| experiment.objects.iter().any(|o| o.name == name && matches!(o.kind, ObjectKind::Table { .. }));
    let object = |name: &str| experiment.objects.iter().any(|o| o.name == name);
    (table(&contact.a) && object(&contact.b)) || (table(&contact.b) && object(&contact.a))
}

/// The smallest distance from the links (all when none is named) to the objects.
pub(super) fn clearance_of(clearances: &[Clearance], objects: &[String], links: &[String], min_m: f64) -> Answer {
    let asked = clearances.iter().filter(|c| objects.contains(&c.b) && (links.is_empty() || links.contains(&c.a)));
    let nearest = asked.filter(|c| c.min_distance_m.is_finite()).min_by(|a, b| a.min_distance_m.total_cmp(&b.min_distance_m));
    let value = nearest.map_or(f64::NAN, |c| c.min_distance_m);
    // When it was nearest is told with the distance; when it first came nearer than it may is not followed.
    Answer::at_least(value, min_m, "m")
}

fn goal_reached(outcome: &RunOutcome, max_m: f64) -> Answer {
    let value = outcome.steps.last().map_or(f64::NAN, |last| (outcome.goal - last.tool.translation.vector).norm());
    Answer::at_most(value, max_m, "m")
}

fn human_force(outcome: &RunOutcome, max_n: f64) -> Answer {
    // The cap is a length of a vector: allow for its rounding.
    let allowed = max_n * (1.0 + 1e-12);
    let failed = outcome.steps.iter().find(|step| step.human.force.norm() > allowed).map(|step| step.time_s);
    let value = outcome.human_peak_force_n;
    Answer { passed: value <= allowed, value, limit: max_n, unit: "N", first_failed_time_s: failed }
}

/// The moment when the gripper is first told to close.
fn closing(steps: &[StepRecord]) -> Option<&StepRecord> {
    steps.windows(2).find(|pair| pair[0].gripper_command >= 0.5 && pair[1].gripper_command < 0.5).map(|pair| &pair[1])
}

fn compliance_window(steps: &[StepRecord], experiment: &Experiment, stiff_at: &[String]) -> Answer {
    let (Some(closing), Some(last)) = (closing(steps), steps.last()) else {
        return Answer::at_least(f64::NAN, 0.0, "s");
    };
    let windows = compliance_windows(steps);
    let inside = |w: &Window| (closing.time_s - w.start_s).min(w.end_s - closing.time_s);
    let mut spare_s = windows.iter().map(inside).fold(-last.time_s, f64::max);
    let mut failed = (spare_s < 0.0).then_some(closing.time_s);
    let passages: Vec<Vec<Window>> = stiff_at.iter().map(|object| passages(steps, experiment, object)).collect();
    if passages.iter().any(Vec::is_empty) {
        // A hand that never came to one of the objects has not shown that it is stiff there.
        return Answer::at_least(f64::NAN, 0.0, "s");
    }
    for passage in passages.iter().flatten() {
        for window in &windows {
            let gap_s = (window.start_s - passage.end_s).max(passage.start_s - window.end_s);
            spare_s = spare_s.min(gap_s);
            failed = failed.or((gap_s < 0.0).then_some(window.start_s.max(passage.start_s)));
        }
    }
    Answer::at_least(spare_s, 0.0, "s").first_failed(failed)
}

/// Half the extent of a hand along its way (m): so far before and behind an object some of it is still over it.
const HALF_HAND_M: f64 = 0.04;

/// When the hand is over the object, at the object's place along y.
fn passages(steps: &[StepRecord], experiment: &Experiment, object: &str) -> Vec<Window> {
    let Some(object) = experiment.objects.iter().find(|o| o.name == object) else { return Vec::new() };
    let half = if let ObjectKind::UBlock { thickness_m, .. } = object.kind { thickness_m / 2.0 } else { 0.0 };
    let y = object.center(&experiment.parameters).y;
    windows(steps, |step| (step.tool.translation.y - y).abs() <= half + HALF_HAND_M)
}

fn gripper_over_object(steps: &[StepRecord], experiment: &Experiment, object: &str, max_m: f64) -> Answer {
    let index = experiment.objects.iter().position(|o| o.name == object);
    let value = match (closing(steps), index) {
        // Where it lay, so that knocking it into the gripper is no merit.
        (Some(step), Some(index)) => (steps[0].objects[index].translation.vector - step.tool.translation.vector).xy().norm(),
        _ => f64::NAN,
    };
    Answer::at_most(value, max_m, "m").first_failed(closing(steps).filter(|_| value > max_m).map(|step| step.time_s))
}

fn reference_unmoved(steps: &[StepRecord], max_m: f64) -> Answer {
    // What earlier help left behind fades by itself: a push moves the plan when it asks for a displacement, or makes the deviation grow.
    largest_in_pushes(steps, max_m, |step, before| step.coupling_displacement.norm().max(step.deviation.norm() - before.deviation.norm()))
}

fn gripper_unmoved(steps: &[StepRecord], max_m: f64) -> Answer {
    let lag = |step: &StepRecord| step.tool.translation.vector - step.reference.translation.vector;
    largest_in_pushes(steps, max_m, |step, before| (lag(step) - lag(before)).norm())
}

/// The largest of `moved`, which is told the step and the one at which its push began. Without a push there is no answer.
fn largest_in_pushes(steps: &[StepRecord], max_m: f64, moved: impl Fn(&StepRecord, &StepRecord) -> f64) -> Answer {
    let mut largest: Option<f64> = None;
    let mut failed = None;
    for window in human_windows(steps) {
        let during: Vec<&StepRecord> = steps.iter().filter(|step| (window.start_s..=window.end_s).contains(&step.time_s)).collect();
        for step in &during {
            let moved = moved(step, during[0]);
            largest = Some(largest.unwrap_or(0.0).max(moved));
            failed = failed.or((moved > max_m).then_some(step.time_s));
        }
    }
    Answer::at_most(largest.unwrap_or(f64::NAN), max_m, "m").first_failed(failed)
}
