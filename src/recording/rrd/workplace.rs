//! Where the work is done: what a scene is looked at for.

use nalgebra::{Isometry3, Vector3};

use super::paths::COLUMNS;
use crate::demonstration::Trajectory;
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
    /// How far one of the ways that are shown goes, taught, planned or executed: along each axis the one that goes farthest (m).
    pub way: Vector3<f64>,
    pub moments: Vec<Moment>,
}

impl Workplace {
    /// Around some moments; at the origin without any.
    pub fn around(moments: Vec<Moment>) -> Self {
        let Some(first) = moments.first().map(|moment| moment.tool) else { return Self::default() };
        let (low, high) = moments.iter().fold((first, first), |(low, high), moment| (low.inf(&moment.tool), high.sup(&moment.tool)));
        let every = moments.len().div_ceil(MOMENTS);
        Self { middle: (low + high) / 2.0, size: high - low, way: high - low, moments: moments.into_iter().step_by(every).collect() }
    }

    /// The same with the ways of a run that were taught and planned: an arm that stays on its plan goes no way there where demonstrations
    /// disagree most.
    pub fn with_paths(self, outcome: &RunOutcome) -> Self {
        let taught = outcome.dataset.demonstrations.iter().map(|demonstration| &demonstration.trajectory);
        self.beside(taught.chain([&outcome.plan]))
    }

    fn beside<'a>(self, movements: impl IntoIterator<Item = &'a Trajectory>) -> Self {
        let way = movements.into_iter().filter_map(extent).fold(self.way, |way, other| way.sup(&other));
        Self { way, ..self }
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

/// How far a movement goes along each axis (m); none for one without a place.
fn extent(movement: &Trajectory) -> Option<Vector3<f64>> {
    let [x, y, z] = COLUMNS.map(|name| movement.column(name).map(|values| values.max() - values.min()));
    Some(Vector3::new(x?, y?, z?))
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;

    fn led(from: [f64; 3], to: [f64; 3]) -> Trajectory {
        let values = DMatrix::from_fn(2, 3, |row, column| [from, to][row][column]);
        Trajectory::new(vec![0.0, 1.0], COLUMNS.map(String::from).to_vec(), values).expect("a trajectory")
    }

    /// Contract: a coordinate moves if it does in the execution, in a lesson or in the plan; that lessons are beside each other is no movement.
    /// Where the work is done is where it was executed.
    #[test]
    fn what_the_arm_does_not_do_counts_where_it_was_taught() {
        let still = Vector3::new(0.6, 0.5, 0.1);
        let moments = [still, still + Vector3::new(0.0, -0.5, 0.0)].map(|tool| Moment { tool, objects: Vec::new() });
        let work = Workplace::around(moments.to_vec());
        let taught = [led([0.54, 0.5, 0.1], [0.6, 0.0, 0.1]), led([0.66, 0.5, 0.1], [0.6, 0.0, 0.1])];
        let shown = work.clone().beside([&led([0.6, 0.5, 0.3], [0.6, 0.0, 0.1])].into_iter().chain(&taught));
        assert!((shown.way - Vector3::new(0.06, 0.5, 0.2)).norm() < 1e-12, "{}", shown.way);
        assert_eq!((shown.middle, shown.size), (work.middle, work.size));
        // Without an execution they are all there is.
        let known = Workplace::default().beside(&taught);
        assert!((known.way - Vector3::new(0.06, 0.5, 0.0)).norm() < 1e-12, "{}", known.way);
    }
}
