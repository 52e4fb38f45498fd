//! The replays: what the arm felt when it repeated the demonstrations alone, one after the other, on a timeline of their own.

use nalgebra::Vector3;
use rerun::{Arrows3D, Scalars, StateChange, TextDocument, Transform3D};

use super::arrow::Arrow;
use super::convert;
use super::entity_path::{REPLAY_ARROW, REPLAY_FORCE, REPLAY_LANE, REPLAY_NAME, REPLAY_PATH, REPLAY_TIME};
use super::palette;
use super::paths::{AXES, COLUMNS, style};
use super::recorder::{Fault, Recorder};
use crate::demonstration::{Dataset, Trajectory};

/// Every so many samples are drawn.
const EVERY: usize = 5;
/// Time between two replays on the timeline (s).
const PAUSE_S: f64 = 1.0;
/// The columns that hold the force.
const FORCE_COLUMNS: [&str; 3] = ["fx_n", "fy_n", "fz_n"];

/// Logs the wrench of every demonstration along its path; nothing for demonstrations without a place and a force.
pub(super) fn log_replays(recorder: &Recorder, dataset: &Dataset, arrow: Arrow) -> Result<(), Fault> {
    let mut film = Film::default();
    dataset.demonstrations.iter().for_each(|demonstration| film.append(&demonstration.name, &demonstration.trajectory));
    if film.times_s.is_empty() {
        return Ok(());
    }
    let places = Transform3D::update_fields().with_many_translation(film.places.iter().map(convert::vector));
    recorder.on(REPLAY_TIME, REPLAY_PATH.path(), &film.times_s, places.columns_of_unit_batches()?)?;
    recorder.always(REPLAY_ARROW.path(), &arrow.look(palette::MEASURED))?;
    let arrows = Arrows3D::update_fields()
        .with_vectors(film.forces.iter().map(|force| convert::vector(&arrow.of(force))))
        .with_origins(film.places.iter().map(convert::vector));
    recorder.on(REPLAY_TIME, REPLAY_ARROW.path(), &film.times_s, arrows.columns_of_unit_batches()?)?;
    for (axis, name) in AXES.iter().enumerate() {
        let entity = REPLAY_FORCE.of(&[name]);
        recorder.always(entity.clone(), &style("measured", palette::MEASURED, 1.5))?;
        let (times_s, values) = film.over_replays(axis);
        recorder.on(REPLAY_TIME, entity, &times_s, Scalars::new(values).columns_of_unit_batches()?)?;
    }
    let (times, names): (Vec<f64>, Vec<&str>) = film.starts.iter().copied().unzip();
    let numbers = (1..=names.len()).map(|number| number.to_string());
    recorder.on(REPLAY_TIME, REPLAY_LANE.path(), &times, StateChange::new().with_state(numbers).columns_of_unit_batches()?)?;
    let names = TextDocument::update_fields().with_many_text(names);
    recorder.on(REPLAY_TIME, REPLAY_NAME.path(), &times, names.columns_of_unit_batches()?)
}

/// All replays on one timeline.
#[derive(Default)]
struct Film<'a> {
    times_s: Vec<f64>,
    places: Vec<Vector3<f64>>,
    forces: Vec<Vector3<f64>>,
    starts: Vec<(f64, &'a str)>,
}

impl<'a> Film<'a> {
    /// The force along an axis, and none after each replay: nothing leads from one to the next.
    fn over_replays(&self, axis: usize) -> (Vec<f64>, Vec<f64>) {
        let mut rows = (Vec::new(), Vec::new());
        for (i, (time_s, force)) in self.times_s.iter().zip(&self.forces).enumerate() {
            rows.0.push(*time_s);
            rows.1.push(force[axis]);
            let next = self.times_s.get(i + 1);
            if next.is_none_or(|next| self.starts.iter().any(|(start_s, _)| start_s == next)) {
                rows.0.push(time_s + PAUSE_S / 2.0);
                rows.1.push(f64::NAN);
            }
        }
        rows
    }

    fn append(&mut self, name: &'a str, trajectory: &Trajectory) {
        let vector = |names: [&str; 3], i: usize| -> Option<Vector3<f64>> {
            let [x, y, z] = names.map(|name| trajectory.column_index(name).map(|column| trajectory.values()[(i, column)]));
            Some(Vector3::new(x?, y?, z?))
        };
        let start_s = self.times_s.last().map_or(0.0, |last| last + PAUSE_S);
        let began = self.times_s.len();
        for i in (0..trajectory.samples()).step_by(EVERY) {
            let (Some(place), Some(force)) = (vector(COLUMNS, i), vector(FORCE_COLUMNS, i)) else { return };
            self.times_s.push(start_s + trajectory.times_s()[i] - trajectory.times_s()[0]);
            self.places.push(place);
            self.forces.push(force);
        }
        if self.times_s.len() > began {
            self.starts.push((start_s, name));
        }
    }
}
