//! Where the work is done: what a scene is looked at for.

use nalgebra::{Isometry3, Point3, Vector3};

use super::paths::COLUMNS;
use crate::demonstration::Trajectory;
use crate::simulation::{LessonRecord, RunOutcome, StepRecord};

/// Moments that are kept, spread over the work, and places of each way.
const MOMENTS: usize = 8;
const PLACES: usize = 40;

/// So many places of all ways are looked for, at every moment and from every view: more would take long, and change little.
const LOOKED_FOR: usize = 160;

/// Where the tool is at some moment (m, world), and the poses of the objects and of the robot's bodies then, as far as they are known.
#[derive(Clone, Debug, Default)]
pub(super) struct Moment {
    pub tool: Vector3<f64>,
    pub objects: Vec<Isometry3<f64>>,
    pub bodies: Vec<Isometry3<f64>>,
}

/// The ways of the tool, and some moments of the work.
#[derive(Clone, Debug, Default)]
pub(super) struct Workplace {
    /// Size (m) of the box around the way of the tool.
    pub size: Vector3<f64>,
    /// How far one of the ways that are shown goes, taught, planned or executed: along each axis the one that goes farthest (m).
    pub way: Vector3<f64>,
    /// Places on the ways that are shown (m, world), first on that of the tool.
    pub places: Vec<Vector3<f64>>,
    /// Some moments of the work.
    pub moments: Vec<Moment>,
}

impl Workplace {
    /// Around some moments; at the origin without any.
    pub fn around(moments: Vec<Moment>) -> Self {
        let places: Vec<Vector3<f64>> = moments.iter().map(|moment| moment.tool).collect();
        let size = extent(&places).unwrap_or_default();
        Self { size, way: size, places: spread(places, PLACES).collect(), moments: spread(moments, MOMENTS).collect() }
    }

    /// The same with the ways of a run that were taught and planned, and that were executed beside it: an arm that stays on its plan goes no
    /// way there where demonstrations disagree most.
    pub fn with_paths(self, outcome: &RunOutcome) -> Self {
        let taught = outcome.dataset.demonstrations.iter().map(|demonstration| &demonstration.trajectory);
        let beside = outcome.beside.iter().map(|one| one.outcome.steps.iter().map(|step| step.tool.translation.vector).collect());
        let mut shown = self.beside(taught.chain([&outcome.plan]).filter_map(places));
        shown.places.extend(beside.flat_map(|places: Vec<_>| spread(places, PLACES)));
        shown
    }

    fn beside(mut self, ways: impl IntoIterator<Item = Vec<Vector3<f64>>>) -> Self {
        for way in ways {
            self.way = extent(&way).map_or(self.way, |extent| self.way.sup(&extent));
            self.places.extend(spread(way, PLACES));
        }
        self
    }

    /// Some of the places, evenly spread: those that are looked for from every view.
    pub fn looked_for(&self) -> Vec<Point3<f64>> {
        let every = self.places.len().div_ceil(LOOKED_FOR).max(1);
        self.places.iter().step_by(every).copied().map(Point3::from).collect()
    }

    /// Of the lessons.
    pub fn of_lessons(lessons: &[LessonRecord]) -> Self {
        let looks = lessons.iter().flat_map(|lesson| &lesson.looks);
        Self::around(looks.map(|look| Moment { tool: look.tool, objects: look.objects.clone(), bodies: look.bodies.clone() }).collect())
    }

    /// Of the plan: where the objects and the arm will be is not known.
    pub fn of_plan(outcome: &RunOutcome) -> Self {
        let moment = |tool| Moment { tool, objects: Vec::new(), bodies: Vec::new() };
        Self::around(places(&outcome.plan).into_iter().flatten().map(moment).collect())
    }

    /// Of the execution.
    pub fn of_steps(steps: &[StepRecord]) -> Self {
        let moment = |record: &StepRecord| Moment {
            tool: record.tool.translation.vector,
            objects: record.objects.clone(),
            bodies: record.bodies.clone(),
        };
        Self::around(steps.iter().map(moment).collect())
    }
}

/// At most so many of some things, evenly spread, with the first one.
fn spread<T>(things: Vec<T>, most: usize) -> impl Iterator<Item = T> {
    let every = things.len().div_ceil(most).max(1);
    things.into_iter().step_by(every)
}

/// Where a movement leads (m, world); none for one without a place.
fn places(movement: &Trajectory) -> Option<Vec<Vector3<f64>>> {
    let [Some(x), Some(y), Some(z)] = COLUMNS.map(|name| movement.column(name)) else { return None };
    Some((0..x.len()).map(|i| Vector3::new(x[i], y[i], z[i])).collect())
}

/// How far places are apart along each axis (m); none without any.
fn extent(places: &[Vector3<f64>]) -> Option<Vector3<f64>> {
    let first = *places.first()?;
    let (low, high) = places.iter().fold((first, first), |(low, high), place| (low.inf(place), high.sup(place)));
    Some(high - low)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Contract: a coordinate moves if it does in the execution, in a lesson or in the plan; that lessons are beside each other is no movement.
    /// What is shown is everywhere where the tool was or was led.
    #[test]
    fn what_the_arm_does_not_do_counts_where_it_was_taught() {
        let still = Vector3::new(0.6, 0.5, 0.1);
        let places = [still, still + Vector3::new(0.0, -0.5, 0.0)];
        let moments = places.map(|tool| Moment { tool, objects: Vec::new(), bodies: Vec::new() });
        let work = Workplace::around(moments.to_vec());
        let led = |from: [f64; 3], to: [f64; 3]| vec![Vector3::from(from), Vector3::from(to)];
        let taught = || [led([0.54, 0.5, 0.1], [0.6, 0.0, 0.1]), led([0.66, 0.5, 0.1], [0.6, 0.0, 0.1])];
        let shown = work.clone().beside([led([0.6, 0.5, 0.3], [0.6, 0.0, 0.1])].into_iter().chain(taught()));
        assert!((shown.way - Vector3::new(0.06, 0.5, 0.2)).norm() < 1e-12, "{}", shown.way);
        assert_eq!((shown.size, &shown.places[..2], shown.places.len()), (work.size, &places[..], 8));
        // Without an execution they are all there is.
        let known = Workplace::default().beside(taught());
        assert!((known.way - Vector3::new(0.06, 0.5, 0.0)).norm() < 1e-12, "{}", known.way);
    }
}
