//! What a recording tells, chapter by chapter: all at once when the run is over, or one after the other while it happens.

use std::cell::OnceCell;

use rerun::{RecordingStream, ViewCoordinates};

use super::arrow::Arrow;
use super::axis_range::Ranges;
use super::camera::Camera;
use super::dashes::Dashes;
use super::entity_path::WORLD;
use super::force_figure::Told;
use super::path::Path;
use super::recorder::{Fault, Recorder};
use super::teaching_figure::Lessons;
use super::then::Scene;
use super::workplace::Workplace;
use super::{
    baseline, beside, contact_figure, events, force_figure, forcing_figure, guide, lanes, palette, paths, replay_figure, robot_figure,
    scene_figure, see_through, spread_figure, state_figure, task_states, teaching_figure,
};
use crate::robot::RobotModel;
use crate::simulation::{Beside, Experiment, Help, LessonRecord, RunOutcome};

/// The application that the viewer keeps the layout for.
pub(super) const APPLICATION: &str = "cpdmp";

/// One recording.
pub(super) struct Chapters<'a> {
    pub stream: RecordingStream,
    /// What has been told, for the axes of plots.
    pub ranges: Ranges,
    pub experiment: &'a Experiment,
    /// Where the tool does its work.
    pub work: Workplace,
    /// What it is looked at with, once that is known.
    pub camera: OnceCell<Camera>,
    /// How long the execution of the skill takes (s).
    pub duration_s: f64,
    /// What was executed beside the run.
    pub beside: &'a [Beside],
}

impl Chapters<'_> {
    /// How the demonstrations were taught.
    pub fn lessons(&self, robot: &RobotModel, lessons: &[LessonRecord]) -> Result<(), Fault> {
        let told = Lessons { lessons, number: 0, first: true, camera: self.camera(robot) };
        teaching_figure::log_lessons(&self.recorder(&[]), self.experiment, robot, &told)
    }

    /// How number `number` of them was taught; `earliest` is the first one of those that have been told.
    pub fn lesson(&self, robot: &RobotModel, (number, lesson): (usize, &LessonRecord), earliest: Option<usize>) -> Result<(), Fault> {
        let recorder = if earliest.is_some() { self.recorder(&[]).continues() } else { self.recorder(&[]) };
        let first = earliest.is_none_or(|earliest| number < earliest);
        let told = Lessons { lessons: std::slice::from_ref(lesson), number, first, camera: self.camera(robot) };
        teaching_figure::log_lessons(&recorder, self.experiment, robot, &told)
    }

    /// What is known before the execution: demonstrations, their replays, skill and plan.
    pub fn skill(&self, outcome: &RunOutcome) -> Result<(), Fault> {
        let (recorder, camera) = (self.recorder(&[]), self.camera(&outcome.robot));
        recorder.always(WORLD.path(), &ViewCoordinates::RIGHT_HAND_Z_UP())?;
        guide::log_guide(&recorder, self.experiment, outcome)?;
        replay_figure::log_replays(&recorder, &outcome.dataset, Arrow::seen_by(&camera))?;
        let dashes = self.dashes(outcome, &camera);
        paths::log_known(&recorder, outcome, (self.duration_s, &dashes))?;
        if self.compares() {
            baseline::log_baseline(&recorder, self.experiment, outcome, &dashes)?;
        }
        state_figure::log_states(&recorder, self.experiment, outcome, (self.duration_s, &camera))?;
        forcing_figure::log_forcing(&recorder, self.experiment, outcome, self.duration_s)
    }

    /// The steps of the execution from number `from` on.
    pub fn execution(&self, outcome: &RunOutcome, from: usize) -> Result<(), Fault> {
        // What changes from one step to the next needs both.
        let records = &outcome.steps[from.saturating_sub(1)..];
        let recorder = if from == 0 { self.recorder(records) } else { self.recorder(records).continues() };
        let camera = self.camera(&outcome.robot);
        robot_figure::log_robot(&recorder, &outcome.robot, records)?;
        let see_through = if from == 0 { self.see_through(&camera, &outcome.robot) } else { Vec::new() };
        scene_figure::log_objects(&recorder, self.experiment, records, &see_through)?;
        paths::log_executed(&recorder, records, &camera)?;
        state_figure::log_active(&recorder, self.experiment, outcome, records, (self.duration_s, &camera))?;
        force_figure::log_forces(&recorder, records, self.told(outcome), &camera)?;
        contact_figure::log_touches(&recorder, outcome, records)?;
        lanes::log_lanes(&recorder, records, &outcome.skill, &task_states::betas(self.experiment, &outcome.skill)?)?;
        spread_figure::log_spread(&recorder, &outcome.skill, records)?;
        events::log_events(&recorder, outcome, records.first().filter(|_| from > 0).map(|record| record.time_s))
    }

    /// What is known when it is over.
    pub fn end(&self, outcome: &RunOutcome) -> Result<(), Fault> {
        // The active state is named in the lowest line, where there are states.
        let below = usize::from(!self.drawn_betas(outcome)?.is_empty());
        contact_figure::log_contacts(&self.recorder(&[]), outcome, (&self.camera(&outcome.robot), below))?;
        if !self.beside.is_empty() {
            beside::log_forces(&self.recorder(&outcome.steps), &outcome.steps, &outcome.skill, (beside::RUN, palette::EXECUTED))?;
            beside::log_colors(&self.recorder(&[]), self.beside, outcome.skill.force.is_some())?;
        }
        beside::log_all(self.beside, &self.dashes(outcome, &self.camera(&outcome.robot)), |records| self.recorder(records))
    }

    /// How paths that may be in one place are told apart.
    fn dashes(&self, outcome: &RunOutcome, camera: &Camera) -> Dashes {
        let others = self.beside.len() + usize::from(self.compares());
        Dashes::along(&Path::new(&outcome.plan, outcome.plan.duration_s()), others, camera)
    }

    /// `beta` of each state that is drawn: none of a skill without states or without a place.
    pub(super) fn drawn_betas(&self, outcome: &RunOutcome) -> Result<Vec<f64>, Fault> {
        Ok(task_states::states(self.experiment, outcome, self.duration_s)?.iter().map(|state| state.beta).collect())
    }

    /// Which forces there are.
    pub(super) fn told(&self, outcome: &RunOutcome) -> Told {
        Told { expected: outcome.skill.force.is_some(), person: self.experiment.execution.help != Help::None }
    }

    /// Whether the baseline's plan is shown: where nothing was executed beside the run, which says more.
    pub(super) fn compares(&self) -> bool {
        self.beside.is_empty() && baseline::compares(self.experiment)
    }

    pub(super) fn recorder(&self, records: &[crate::simulation::StepRecord]) -> Recorder {
        Recorder::new((self.stream.clone(), self.ranges.clone()), records, self.experiment.physics.step_s, self.duration_s)
    }

    /// The work is somewhere else than it seemed.
    pub fn look_at(&mut self, work: Workplace) {
        self.work = work;
        self.camera = OnceCell::new();
    }

    /// The objects, by their index, that would hide much of the work from a camera.
    fn see_through(&self, camera: &Camera, robot: &RobotModel) -> Vec<usize> {
        let Experiment { objects, parameters, .. } = self.experiment;
        see_through::before(camera, &self.work, &Scene { objects, parameters, bodies: &robot.bodies })
    }

    /// The paths of a run should be seen, too, from where the work is looked at.
    pub fn looks_for(&mut self, outcome: &RunOutcome) {
        self.work = std::mem::take(&mut self.work).with_paths(outcome);
    }

    /// What the work is looked at with; to find it takes a while, so it is done once.
    pub(super) fn camera(&self, robot: &RobotModel) -> Camera {
        let Experiment { objects, parameters, .. } = self.experiment;
        *self.camera.get_or_init(|| Camera::on(&self.work, &Scene { objects, parameters, bodies: &robot.bodies }))
    }
}
