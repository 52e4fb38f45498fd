//! Writes a recording from beginning to end.

use std::path::Path;

use nalgebra::Vector3;
use rerun::{RecordingStreamBuilder, ViewCoordinates};

use super::entity_path::WORLD;
use super::recorder::{Fault, Recorder, has_footer};
use super::{
    blueprint_property, contact_figure, events, force_figure, forcing_figure, guide, lanes, layout, paths, replay_figure, robot_figure,
    scene_figure, spread_figure, state_figure, teaching_figure,
};
use crate::recording::RecordingError;
use crate::robot::{RobotModel, Shape};
use crate::simulation::{Experiment, RunOutcome, skill_duration_s};

/// The application that the viewer keeps the layout for.
const APPLICATION: &str = "cpdmp";

/// Writes the recording of a run to `path` (`.rrd`): its data, and the layout that it opens with.
///
/// # Errors
/// When the file cannot be created or written to its end.
pub fn write_recording(path: &Path, experiment: &Experiment, outcome: &RunOutcome) -> Result<(), RecordingError> {
    write(path, experiment, outcome).map_err(|source| RecordingError::Rerun { path: path.to_owned(), source })?;
    match has_footer(path) {
        Ok(true) => Ok(()),
        Ok(false) => Err(RecordingError::Incomplete { path: path.to_owned() }),
        Err(source) => Err(RecordingError::Io { path: path.to_owned(), source }),
    }
}

fn write(path: &Path, experiment: &Experiment, outcome: &RunOutcome) -> Result<(), Fault> {
    let name = format!("{}, seed {}", experiment.name, experiment.seed);
    // Equal identities are shown as one recording: runs that differ must not share one.
    let identity = format!("{}-{}-{:016x}", experiment.name, experiment.seed, outcome.state_hash);
    let stream = RecordingStreamBuilder::new(APPLICATION).recording_id(identity).save(path)?;
    if !stream.is_enabled() {
        return Err("rerun is switched off by the environment variable RERUN; unset it, or do without a recording".into());
    }
    stream.send_recording_name(name)?;
    let middle = middle(outcome);
    let (blueprint, properties) = layout::layout(middle, floor_m(&outcome.robot), !outcome.lessons.is_empty())?;
    blueprint_property::send(&stream, APPLICATION, &blueprint, &properties)?;

    let duration_s = skill_duration_s(&outcome.steps).unwrap_or_else(|| outcome.plan.duration_s());
    let recorder = Recorder::new(stream, &outcome.steps, experiment.physics.step_s, duration_s);
    recorder.always(WORLD.path(), &ViewCoordinates::RIGHT_HAND_Z_UP())?;
    robot_figure::log_robot(&recorder, &outcome.robot, &outcome.steps)?;
    scene_figure::log_objects(&recorder, experiment, &outcome.steps)?;
    paths::log_paths(&recorder, outcome, duration_s)?;
    state_figure::log_states(&recorder, experiment, outcome, duration_s, middle)?;
    force_figure::log_forces(&recorder, &outcome.steps, outcome.skill.force.is_some())?;
    lanes::log_lanes(&recorder, &outcome.steps, outcome.skill.motion.states() > 0)?;
    forcing_figure::log_forcing(&recorder, experiment, outcome, duration_s)?;
    spread_figure::log_spread(&recorder, outcome)?;
    contact_figure::log_contacts(&recorder, outcome)?;
    teaching_figure::log_lessons(&recorder, experiment, outcome)?;
    replay_figure::log_replays(&recorder, &outcome.dataset)?;
    events::log_events(&recorder, outcome)?;
    guide::log_guide(&recorder, experiment, outcome)?;
    recorder.finish()
}

/// The middle of the way of the tool (m).
fn middle(outcome: &RunOutcome) -> Vector3<f64> {
    let places = || outcome.steps.iter().map(|record| record.tool.translation.vector);
    let Some(first) = places().next() else { return Vector3::zeros() };
    let (low, high) = places().fold((first, first), |(low, high), place| (low.inf(&place), high.sup(&place)));
    (low + high) / 2.0
}

/// Height of the floor: the lowest point of the robot's fixed body (m), at most the height of its base.
fn floor_m(robot: &RobotModel) -> f64 {
    let reach = |shape: &Shape| match shape {
        Shape::Box { half_extents } => half_extents.z,
        Shape::Sphere { radius } => *radius,
        Shape::Cylinder { half_length, .. } => *half_length,
        Shape::Mesh { vertices, .. } => vertices.iter().map(|vertex| -vertex[2]).fold(0.0, f64::max),
    };
    let fixed = robot.bodies.first().map_or(&[][..], |body| &body.visuals);
    fixed.iter().map(|visual| visual.body_from_geometry.translation.z - reach(&visual.shape)).fold(0.0, f64::min)
}
