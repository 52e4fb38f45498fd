//! Where the work is done: what a scene is looked at for.

use nalgebra::{Isometry3, Vector3};

use super::paths::COLUMNS;
use crate::simulation::{LessonRecord, RunOutcome, StepRecord};

/// Moments that are kept, spread over the work.
const MOMENTS: usize = 8;

/// Where the tool is at some moment (m, world), and the poses of the objects then, as far as they are known.
#[derive(Clone, Debug)]
pub(super) struct Moment {
    pub tool: Vector3<f64>,
    pub objects: Vec<Isometry3<f64>>,
}

/// The box around the way of the tool, and some moments of the work.
#[derive(Clone, Debug, Default)]
pub(super) struct Workplace {
    /// Middle of the box (m, world).
    pub middle: Vector3<f64>,
    /// Its size (m).
    pub size: Vector3<f64>,
    pub moments: Vec<Moment>,
}

impl Workplace {
    /// Around some moments; at the origin without any.
    pub fn around(moments: Vec<Moment>) -> Self {
        let Some(first) = moments.first().map(|moment| moment.tool) else { return Self::default() };
        let (low, high) = moments.iter().fold((first, first), |(low, high), moment| (low.inf(&moment.tool), high.sup(&moment.tool)));
        let every = moments.len().div_ceil(MOMENTS);
        Self { middle: (low + high) / 2.0, size: high - low, moments: moments.into_iter().step_by(every).collect() }
    }

    /// Of the lessons.
    pub fn of_lessons(lessons: &[LessonRecord]) -> Self {
        let looks = lessons.iter().flat_map(|lesson| &lesson.looks);
        Self::around(looks.map(|look| Moment { tool: look.tool, objects: look.objects.clone() }).collect())
    }

    /// Of the plan: where the objects will be is not known.
    pub fn of_plan(outcome: &RunOutcome) -> Self {
        let [Some(x), Some(y), Some(z)] = COLUMNS.map(|name| outcome.plan.column(name)) else { return Self::default() };
        let moment = |i: usize| Moment { tool: Vector3::new(x[i], y[i], z[i]), objects: Vec::new() };
        Self::around((0..x.len()).map(moment).collect())
    }

    /// Of the execution.
    pub fn of_steps(steps: &[StepRecord]) -> Self {
        let moment = |record: &StepRecord| Moment { tool: record.tool.translation.vector, objects: record.objects.clone() };
        Self::around(steps.iter().map(moment).collect())
    }
}
