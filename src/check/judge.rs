//! Answers a scenario's criteria.

use nalgebra::Vector3;

use super::windows::{compliance_windows, human_windows};
use super::{Criterion, CriterionKind, CriterionSpec};
use crate::simulation::{Experiment, RunOutcome, StepRecord};
use crate::world::{Object, ObjectKind};

/// Answers `specs` for the run `outcome` of `experiment`, in their order.
pub fn judge(outcome: &RunOutcome, experiment: &Experiment, specs: &[CriterionSpec]) -> Vec<Criterion> {
    specs.iter().map(|spec| answer(outcome, experiment, spec)).collect()
}

/// A measured value against its limit, before names are put to it.
struct Answer {
    passed: bool,
    value: f64,
    limit: f64,
    unit: &'static str,
    first_failed_time_s: Option<f64>,
}

impl Answer {
    fn at_most(value: f64, limit: f64, unit: &'static str) -> Self {
        Self { passed: value <= limit, value, limit, unit, first_failed_time_s: None }
    }

    fn at_least(value: f64, limit: f64, unit: &'static str) -> Self {
        Self { passed: value >= limit, value, limit, unit, first_failed_time_s: None }
    }

    fn first_failed(mut self, time_s: Option<f64>) -> Self {
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
        CriterionKind::NoContact { objects } => (no_contact(outcome, objects), true),
        CriterionKind::Clearance { objects, min_m } => (clearance(outcome, objects, *min_m), false),
        CriterionKind::GoalReached { max_m } => (goal_reached(outcome, *max_m), true),
        CriterionKind::HumanForce { max_n } => (human_force(steps, *max_n), true),
        CriterionKind::ComplianceWindow { ends_before } => (compliance_window(steps, experiment, ends_before), false),
        CriterionKind::GripperOverObject { object, max_m } => (gripper_over_object(steps, experiment, object, *max_m), true),
        CriterionKind::ReferenceUnmoved { max_m } => (reference_unmoved(steps, *max_m), true),
        CriterionKind::GripperUnmoved { max_m } => (gripper_unmoved(steps, *max_m), true),
    };
    let margin = if upper { answer.limit - answer.value } else { answer.value - answer.limit };
    Criterion {
        name: spec.name.clone(),
        expect: spec.expect,
        passed: answer.passed,
        value: answer.value,
        limit: answer.limit,
        margin,
        unit: answer.unit,
        first_failed_time_s: answer.first_failed_time_s,
    }
}

fn object_in_container(outcome: &RunOutcome, experiment: &Experiment, object: &str, container: &str, speed_max: f64) -> Answer {
    let place = |name: &str| outcome.final_objects.iter().find(|o| o.name == name);
    let spec = |name: &str| experiment.objects.iter().find(|o| o.name == name);
    let (Some(inside), Some(outside), Some(shape)) = (place(object), place(container), spec(container)) else {
        return Answer { passed: false, value: f64::NAN, limit: 0.0, unit: "m", first_failed_time_s: None };
    };
    let away = inside.position - outside.position;
    let (limit, rim) = container_size(shape);
    let value = away.xy().abs().max();
    let passed = value <= limit && (0.0..rim).contains(&away.z) && inside.speed_m_per_s <= speed_max;
    Answer { passed, value, limit, unit: "m", first_failed_time_s: None }
}

/// Half the inner width (m) and the height of the rim above the container's origin (m).
fn container_size(container: &Object) -> (f64, f64) {
    match &container.kind {
        ObjectKind::Basket { inner_size_m, wall_height_m, wall_thickness_m } => {
            (inner_size_m.min() / 2.0, wall_height_m + wall_thickness_m)
        }
        _ => (0.0, 0.0),
    }
}

/// Whether the part `name` belongs to one of the `objects`.
fn belongs(name: &str, objects: &[String]) -> bool {
    objects.iter().any(|object| name == object || name.strip_prefix(object.as_str()).is_some_and(|rest| rest.starts_with('.')))
}

fn no_contact(outcome: &RunOutcome, objects: &[String]) -> Answer {
    let touching = || outcome.collisions.iter().filter(|c| belongs(&c.b, objects) && !belongs(&c.a, objects));
    let first = touching().map(|c| c.first_time_s).fold(None, |first: Option<f64>, t| Some(first.map_or(t, |f| f.min(t))));
    Answer::at_most(touching().count() as f64, 0.0, "pairs").first_failed(first)
}

fn clearance(outcome: &RunOutcome, objects: &[String], min_m: f64) -> Answer {
    let nearest = outcome.clearances.iter().filter(|c| objects.contains(&c.b)).min_by(|a, b| a.min_distance_m.total_cmp(&b.min_distance_m));
    let value = nearest.map_or(f64::NAN, |c| c.min_distance_m);
    let failed = nearest.filter(|c| c.min_distance_m < min_m).map(|c| c.time_s);
    Answer::at_least(value, min_m, "m").first_failed(failed)
}

fn goal_reached(outcome: &RunOutcome, max_m: f64) -> Answer {
    let samples = outcome.plan.samples();
    let goal = (samples > 0).then(|| outcome.plan.values().row(samples - 1).into_owned());
    let value = match (goal, outcome.steps.last()) {
        (Some(goal), Some(last)) if goal.len() >= 3 => (Vector3::new(goal[0], goal[1], goal[2]) - last.tool.translation.vector).norm(),
        _ => f64::NAN,
    };
    Answer::at_most(value, max_m, "m")
}

fn human_force(steps: &[StepRecord], max_n: f64) -> Answer {
    let peak = steps.iter().map(|step| step.human.force.norm()).fold(0.0, f64::max);
    // The cap is a length of a vector: allow for its rounding.
    let failed = steps.iter().find(|step| step.human.force.norm() > max_n * (1.0 + 1e-12)).map(|step| step.time_s);
    Answer { passed: failed.is_none(), value: peak, limit: max_n, unit: "N", first_failed_time_s: failed }
}

/// The moment when the gripper is first told to close.
fn closing(steps: &[StepRecord]) -> Option<&StepRecord> {
    steps.windows(2).find(|pair| pair[0].gripper_command >= 0.5 && pair[1].gripper_command < 0.5).map(|pair| &pair[1])
}

fn compliance_window(steps: &[StepRecord], experiment: &Experiment, ends_before: &str) -> Answer {
    let (Some(closing), Some(gate_s)) = (closing(steps), passage(steps, experiment, ends_before)) else {
        return Answer::at_least(f64::NAN, 0.0, "s");
    };
    let windows = compliance_windows(steps);
    let Some(around) = windows.iter().find(|w| (w.start_s..=w.end_s).contains(&closing.time_s)) else {
        return Answer::at_least(f64::NAN, 0.0, "s");
    };
    // The last window that opens before the gate is reached must also close before it.
    let last = windows.iter().rev().find(|w| w.start_s <= gate_s).unwrap_or(around);
    let spare_s = (closing.time_s - around.start_s).min(around.end_s - closing.time_s).min(gate_s - last.end_s);
    Answer::at_least(spare_s, 0.0, "s").first_failed((last.end_s > gate_s).then_some(gate_s))
}

/// When the tool is first over the object while it travels along y (s).
fn passage(steps: &[StepRecord], experiment: &Experiment, object: &str) -> Option<f64> {
    let object = experiment.objects.iter().find(|o| o.name == object)?;
    let half = if let ObjectKind::UBlock { thickness_m, .. } = object.kind { thickness_m / 2.0 } else { 0.0 };
    let y = object.center(&experiment.parameters).y;
    steps.iter().find(|step| (step.tool.translation.y - y).abs() <= half).map(|step| step.time_s)
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
    let pushed = |step: &&StepRecord| step.human.force.norm() > 0.0;
    let value = steps.iter().filter(pushed).map(|step| step.coupling_displacement.norm()).fold(0.0, f64::max);
    let failed = steps.iter().filter(pushed).find(|step| step.coupling_displacement.norm() > max_m).map(|step| step.time_s);
    Answer::at_most(value, max_m, "m").first_failed(failed)
}

fn gripper_unmoved(steps: &[StepRecord], max_m: f64) -> Answer {
    let lag = |step: &StepRecord| step.tool.translation.vector - step.reference.translation.vector;
    let mut value: f64 = 0.0;
    let mut failed = None;
    for window in human_windows(steps) {
        let during: Vec<&StepRecord> = steps.iter().filter(|step| (window.start_s..=window.end_s).contains(&step.time_s)).collect();
        let before = during.first().map_or_else(Vector3::zeros, |step| lag(step));
        for step in during {
            let moved = (lag(step) - before).norm();
            value = value.max(moved);
            failed = failed.or((moved > max_m).then_some(step.time_s));
        }
    }
    Answer::at_most(value, max_m, "m").first_failed(failed)
}
