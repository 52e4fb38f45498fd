//! The lessons: a person leads the arm, one demonstration after the other, on a timeline of their own.

use nalgebra::{Isometry3, Vector3};
use rerun::{Arrows3D, EntityPath, FillMode, LineStrips3D, Scalars, StateChange, TextDocument, Transform3D, ViewCoordinates};

use super::arrow::{Arrow, SMALLEST_N};
use super::camera::Camera;
use super::convert;
use super::entity_path::{
    TEACHING, TEACHING_BODY, TEACHING_BODY_SHAPE, TEACHING_FORCE, TEACHING_GRIPPER, TEACHING_LANE, TEACHING_MOTION, TEACHING_NAME,
    TEACHING_OBJECT, TEACHING_OBJECT_SHAPE, TEACHING_PATH, TEACHING_PERSON, TEACHING_TIME,
};
use super::force_figure::to_surface;
use super::palette;
use super::paths::{AXES, style};
use super::recorder::{Fault, Recorder, Since};
use super::robot_figure;
use super::scene_figure;
use crate::robot::RobotModel;
use crate::simulation::{Experiment, LessonLook, LessonRecord};
use crate::world::support_height_m;

/// Time between two lessons on the timeline (s).
const PAUSE_S: f64 = 1.0;

/// Some lessons of a run that are logged together, as a camera sees them.
pub(super) struct Lessons<'a> {
    pub lessons: &'a [LessonRecord],
    /// How many come before them.
    pub number: usize,
    /// Whether none that comes before them has been logged: from them on the robot is to be seen.
    pub first: bool,
    pub camera: Camera,
}

/// Logs lessons where they will stand when all are there, for the lessons of a run last equally long; nothing when the demonstrations were not
/// taught in this run.
pub(super) fn log_lessons(recorder: &Recorder, experiment: &Experiment, robot: &RobotModel, told: &Lessons<'_>) -> Result<(), Fault> {
    let Lessons { lessons, number, first, camera } = *told;
    let Some(length_s) = lessons.first().and_then(|lesson| lesson.looks.last()).map(|look| look.time_s) else { return Ok(()) };
    recorder.always(TEACHING.path(), &ViewCoordinates::RIGHT_HAND_Z_UP())?;
    let mut film = Film { number, start_s: number as f64 * (length_s + PAUSE_S), ..Film::default() };
    for lesson in lessons {
        let start_s = film.append(lesson);
        for object in &experiment.objects {
            let when = Since::On(TEACHING_TIME, start_s);
            scene_figure::log_shapes(recorder, when, (&TEACHING_OBJECT_SHAPE, FillMode::Solid), object, &lesson.parameters)?;
            let pose = object.pose(&lesson.parameters, support_height_m(&experiment.objects, object, &lesson.parameters));
            scene_figure::log_fixed(recorder, when, (&TEACHING_OBJECT, &TEACHING_OBJECT_SHAPE, FillMode::Solid), object, &pose)?;
        }
    }
    film.log_bodies(recorder, robot)?;
    if first {
        let when = Since::On(TEACHING_TIME, film.start_s);
        let seen = robot.bodies.iter().filter(|body| !body.visuals.is_empty());
        seen.into_iter().try_for_each(|body| robot_figure::log_shapes(recorder, when, &TEACHING_BODY_SHAPE, body))?;
    }
    for (index, object) in experiment.objects.iter().enumerate() {
        film.log_poses(recorder, TEACHING_OBJECT.of(&[&object.name]), |look| look.objects.get(index).copied())?;
    }
    film.log_path(recorder, &camera)?;
    film.log_person(recorder, Arrow::seen_by(&camera))?;
    film.log_plots(recorder)
}

/// All lessons on one timeline.
#[derive(Default)]
struct Film<'a> {
    /// How many lessons come before it, and when it starts (s).
    number: usize,
    start_s: f64,
    times_s: Vec<f64>,
    looks: Vec<&'a LessonLook>,
    /// Where each lesson starts among the looks, and its name.
    starts: Vec<(usize, &'a str)>,
}

impl<'a> Film<'a> {
    /// Adds a lesson; returns when it starts (s).
    fn append(&mut self, lesson: &'a LessonRecord) -> f64 {
        let start_s = self.times_s.last().map_or(self.start_s, |last| last + PAUSE_S);
        self.starts.push((self.looks.len(), &lesson.name));
        self.times_s.extend(lesson.looks.iter().map(|look| start_s + look.time_s));
        self.looks.extend(&lesson.looks);
        start_s
    }

    fn log_bodies(&self, recorder: &Recorder, robot: &RobotModel) -> Result<(), Fault> {
        for (index, body) in robot.bodies.iter().enumerate().filter(|(_, body)| !body.visuals.is_empty()) {
            self.log_poses(recorder, TEACHING_BODY.of(&[&body.name]), |look| look.bodies.get(index).copied())?;
        }
        Ok(())
    }

    /// Logs a pose when it differs from the one before.
    fn log_poses(
        &self,
        recorder: &Recorder,
        entity: EntityPath,
        pose: impl Fn(&LessonLook) -> Option<Isometry3<f64>>,
    ) -> Result<(), Fault> {
        let (mut times, mut poses): (Vec<f64>, Vec<Isometry3<f64>>) = (Vec::new(), Vec::new());
        for (time_s, look) in self.times_s.iter().zip(&self.looks) {
            let Some(pose) = pose(look).filter(|pose| poses.last() != Some(pose)) else { continue };
            times.push(*time_s);
            poses.push(pose);
        }
        let columns = Transform3D::update_fields()
            .with_many_translation(poses.iter().map(|pose| convert::vector(&pose.translation.vector)))
            .with_many_quaternion(poses.iter().map(|pose| convert::quaternion(&pose.rotation)));
        recorder.on(TEACHING_TIME, entity, &times, columns.columns_of_unit_batches()?)
    }

    /// The way of the tool, piece by piece; a lesson starts with a piece of no length.
    fn log_path(&self, recorder: &Recorder, camera: &Camera) -> Result<(), Fault> {
        let starts = |i: usize| self.starts.iter().any(|(start, _)| *start == i);
        let piece = |i: usize| {
            let before = if starts(i) { i } else { i - 1 };
            [convert::vector(&self.looks[before].tool), convert::vector(&self.looks[i].tool)]
        };
        let look = LineStrips3D::update_fields().with_colors([palette::TAUGHT_PATH]).with_radii([0.003 * camera.share as f32]);
        recorder.always(TEACHING_PATH.path(), &look)?;
        let pieces = LineStrips3D::update_fields().with_strips((0..self.looks.len()).map(piece));
        recorder.on(TEACHING_TIME, TEACHING_PATH.path(), &self.times_s, pieces.columns_of_unit_batches()?)
    }

    fn log_person(&self, recorder: &Recorder, arrow: Arrow) -> Result<(), Fault> {
        let visible = |force: &Vector3<f64>| force.norm() >= SMALLEST_N;
        let drawn = || self.looks.iter().map(|look| &look.human).filter(|human| visible(&human.force));
        let arrows = Arrows3D::update_fields()
            .with_vectors(drawn().map(|human| convert::vector(&arrow.of(&human.force))))
            .with_origins(drawn().map(|human| convert::vector(&(human.point + to_surface(&human.force)).coords)));
        let lengths: Vec<usize> = self.looks.iter().map(|look| usize::from(visible(&look.human.force))).collect();
        recorder.always(TEACHING_PERSON.path(), &arrow.look(palette::PERSON))?;
        recorder.on(TEACHING_TIME, TEACHING_PERSON.path(), &self.times_s, arrows.columns(lengths)?)
    }

    /// One value per moment, and none after each lesson: nothing leads from one lesson to the next.
    fn over_lessons(&self, value: &dyn Fn(&LessonLook) -> f64) -> (Vec<f64>, Vec<f64>) {
        let mut rows = (Vec::new(), Vec::new());
        for (i, look) in self.looks.iter().enumerate() {
            rows.0.push(self.times_s[i]);
            rows.1.push(value(look));
            let is_last = i + 1 == self.looks.len() || self.starts.iter().any(|(start, _)| *start == i + 1);
            if is_last {
                rows.0.push(self.times_s[i] + PAUSE_S / 2.0);
                rows.1.push(f64::NAN);
            }
        }
        rows
    }

    fn log_plots(&self, recorder: &Recorder) -> Result<(), Fault> {
        let plot = |entity: EntityPath, look, value: &dyn Fn(&LessonLook) -> f64| -> Result<(), Fault> {
            recorder.always(entity.clone(), &look)?;
            let (times_s, values) = self.over_lessons(value);
            recorder.on(TEACHING_TIME, entity, &times_s, Scalars::new(values).columns_of_unit_batches()?)
        };
        for (axis, name) in AXES.iter().enumerate() {
            plot(TEACHING_MOTION.of(&[name]), style(name, palette::TAUGHT, 2.0), &|look| look.tool[axis])?;
        }
        plot(TEACHING_FORCE.path(), style("force (N)", palette::PERSON, 1.5), &|look| look.human.force.norm())?;
        plot(TEACHING_GRIPPER.path(), style("commanded", palette::PLANNED, 1.5), &|look| look.gripper_command)?;
        let times: Vec<f64> = self.starts.iter().map(|(start, _)| self.times_s[*start]).collect();
        let numbers = (1..=self.starts.len()).map(|number| (self.number + number).to_string());
        recorder.on(TEACHING_TIME, TEACHING_LANE.path(), &times, StateChange::new().with_state(numbers).columns_of_unit_batches()?)?;
        let names = TextDocument::update_fields().with_many_text(self.starts.iter().map(|(_, name)| *name));
        recorder.on(TEACHING_TIME, TEACHING_NAME.path(), &times, names.columns_of_unit_batches()?)
    }
}
