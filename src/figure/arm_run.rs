//! What the figures of an arm's run are drawn from.

use nalgebra::{DVector, Point3};

use crate::demonstration::{Dataset, Trajectory};
use crate::learning::{ExecutionSettings, LearningError, LearningSettings, Skill, TaskSpaceState, generate, task_space_states};
use crate::palette::Rgb;
use crate::palette::meaning::{COMPLIES, MINIMISES, STIFF};
use crate::simulation::{StepRecord, skill_duration_s};
use crate::world::{Object, Parameters};

use super::arc::Arc;
use super::mark::Mark;

/// Samples of a taught or planned movement that are drawn.
const DRAWN_SAMPLES: usize = 400;

/// Widths of lines (pt): what was executed lies on what stands beside it, and that on the plan, and each is seen.
pub(super) const PLANNED_PT: f64 = 2.9;
pub(super) const OTHERS_PT: f64 = 2.1;
pub(super) const EXECUTED_PT: f64 = 1.4;

/// Plans that are nowhere further apart (m) are drawn once.
const SAME_PLAN_M: f64 = 1e-3;

/// Ellipses are drawn at this many standard deviations: 95 % of a Gaussian in one dimension.
pub(super) const DEVIATIONS: f64 = 2.0;

/// A run of an arm: what was executed, and the skill that it comes from. A run that was just carried out and one that was stored give the
/// same figures.
pub struct ArmRun<'a> {
    /// What the figures are called.
    pub(super) name: String,
    /// The execution.
    pub(super) steps: &'a [StepRecord],
    /// The skill.
    pub(super) skill: &'a Skill,
    /// What it was learned from.
    pub(super) dataset: &'a Dataset,
    /// How it was learned.
    pub(super) learning: &'a LearningSettings,
    /// What it was asked.
    pub(super) question: ExecutionSettings,
    /// How long it took (s).
    pub(super) duration_s: f64,
    /// What it planned.
    plan: Trajectory,
    /// Its states in the setting, which comply as the coupling says; none for the baseline.
    pub(super) states: Vec<TaskSpaceState>,
    /// What was executed beside it, each with its name and colour.
    pub(super) beside: Vec<(&'a str, Rgb, &'a [StepRecord])>,
    /// Ways on which doors of the scene lead their handles in use.
    pub(super) arcs: Vec<Arc>,
}

/// A movement along one axis: times (s) and values.
pub(super) type Curve = Vec<[f64; 2]>;

/// When (s), and where the tool is to be (m, world).
pub(super) type Moment = (f64, Point3<f64>);

impl<'a> ArmRun<'a> {
    /// The run called `name` with these records, of a skill that was learned from `dataset` and asked `question`.
    ///
    /// # Errors
    /// When the skill cannot answer the question.
    pub fn new(
        name: String,
        steps: &'a [StepRecord],
        (skill, dataset, learning): (&'a Skill, &'a Dataset, &'a LearningSettings),
        question: ExecutionSettings,
    ) -> Result<Self, LearningError> {
        let asked_s = question.duration_s.unwrap_or(skill.motion.duration_s);
        let plan = generate(skill, &question, asked_s / DRAWN_SAMPLES as f64, 1.0)?;
        let states = coupled(task_space_states(skill, &question)?, &question)?;
        let duration_s = skill_duration_s(steps).unwrap_or_else(|| plan.duration_s());
        Ok(Self { name, steps, skill, dataset, learning, question, duration_s, plan, states, beside: Vec::new(), arcs: Vec::new() })
    }

    /// The same in a scene of `objects`, of which a figure shows where its doors lead.
    #[must_use]
    pub fn in_scene(mut self, objects: &[Object], parameters: &Parameters) -> Self {
        self.arcs = objects.iter().filter_map(|object| Arc::of(object, objects, parameters)).collect();
        self
    }

    /// The same beside other executions, each with its name and colour.
    #[must_use]
    pub fn beside(self, others: Vec<(&'a str, Rgb, &'a [StepRecord])>) -> Self {
        Self { beside: others, ..self }
    }

    /// What stands beside the run as lines of a width (pt): `points` of its records, in its colour, under its name; none where those are none.
    pub(super) fn others(&self, width_pt: f64, points: impl Fn(&[StepRecord]) -> Option<Curve>) -> impl Iterator<Item = Mark> {
        let line = move |(name, color, steps): &(&str, Rgb, &[StepRecord])| Some(Mark::line(name, *color, width_pt, points(steps)?));
        self.beside.iter().filter_map(line)
    }

    /// The plans of what stands beside the run, each with its name and colour, at the times (s) and places (m, world) of its records; none of one
    /// that plans as the run does.
    pub(super) fn other_plans(&self) -> impl Iterator<Item = (String, Rgb, Vec<Moment>)> {
        let own = plan_of(self.steps);
        self.beside.iter().filter_map(move |(name, color, steps)| {
            let plan = plan_of(steps);
            let same = |(own, other): (&Moment, &Moment)| (own.1 - other.1).norm() < SAME_PLAN_M;
            (!own.iter().zip(&plan).all(same)).then(|| (format!("{name}, planned"), *color, plan))
        })
    }

    /// The plan along a column; nothing when the skill does not move it.
    pub(super) fn planned(&self, column: &str) -> Option<Curve> {
        self.curve(&self.plan, column)
    }

    /// Every demonstration along a column, its duration stretched to that of the execution.
    pub(super) fn taught(&self, column: &str) -> Vec<Curve> {
        self.dataset.demonstrations.iter().filter_map(|demonstration| self.curve(&demonstration.trajectory, column)).collect()
    }

    fn curve(&self, movement: &Trajectory, column: &str) -> Option<Curve> {
        let values: DVector<f64> = movement.column(column)?;
        let (times, last) = (movement.times_s(), movement.samples() - 1);
        let stretch = self.duration_s / movement.duration_s();
        let every = (movement.samples() / DRAWN_SAMPLES).max(1);
        let kept = (0..last).step_by(every).chain([last]);
        Some(kept.map(|i| [(times[i] - times[0]) * stretch, values[i]]).collect())
    }

    /// A value of every record over time.
    pub(super) fn executed(&self, value: impl Fn(&StepRecord) -> f64) -> Curve {
        over_time(self.steps, value)
    }
}

/// Where a plan has the tool: where the controller wants it, without what forces have moved that (s; m, world).
fn plan_of(steps: &[StepRecord]) -> Vec<Moment> {
    steps.iter().map(|step| (step.time_s, Point3::from(step.reference.translation.vector - step.deviation))).collect()
}

/// A value of every record over time.
pub(super) fn over_time(steps: &[StepRecord], value: impl Fn(&StepRecord) -> f64) -> Curve {
    steps.iter().map(|step| [step.time_s, value(step)]).collect()
}

/// The states with the `beta` with which the run couples them.
fn coupled(mut states: Vec<TaskSpaceState>, question: &ExecutionSettings) -> Result<Vec<TaskSpaceState>, LearningError> {
    let learned: Vec<f64> = states.iter().map(|state| state.beta).collect();
    let betas = question.coupling.beta(&learned)?;
    states.iter_mut().zip(betas).for_each(|(state, beta)| state.beta = beta);
    Ok(states)
}

/// The colour of a state, and what the legend calls it.
pub(super) fn kind_of(beta: f64) -> (Rgb, &'static str) {
    match beta {
        beta if beta < 0.0 => (COMPLIES, "state that complies"),
        beta if beta > 0.0 => (MINIMISES, "state that minimises the force error"),
        _ => (STIFF, "stiff state"),
    }
}
