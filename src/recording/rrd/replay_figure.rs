//! The replays: what the arm felt when it repeated the demonstrations alone, one after the other, on a timeline of their own.

use nalgebra::Vector3;
use rerun::{Arrows3D, Scalars, StateChange, Transform3D};

use super::convert;
use super::entity_path::{REPLAY_ARROW, REPLAY_FORCE, REPLAY_LANE, REPLAY_PATH, REPLAY_TIME};
use super::force_figure::ARROW_M_PER_N;
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
pub(super) fn log_replays(recorder: &Recorder, dataset: &Dataset) -> Result<(), Fault> {
    let mut film = Film::default();
    dataset.demonstrations.iter().for_each(|demonstration| film.append(&demonstration.name, &demonstration.trajectory));
    if film.times_s.is_empty() {
        return Ok(());
    }
    let places = Transform3D::update_fields().with_many_translation(film.places.iter().map(convert::vector));
    recorder.on(REPLAY_TIME, REPLAY_PATH.path(), &film.times_s, places.columns_of_unit_batches()?)?;
    recorder.always(REPLAY_ARROW.path(), &Arrows3D::update_fields().with_colors([palette::MEASURED]).with_radii([0.008]))?;
    let arrows = Arrows3D::update_fields()
        .with_vectors(film.forces.iter().map(|force| convert::vector(&(force * ARROW_M_PER_N))))
        .with_origins(film.places.iter().map(convert::vector));
    recorder.on(REPLAY_TIME, REPLAY_ARROW.path(), &film.times_s, arrows.columns_of_unit_batches()?)?;
    for (axis, name) in AXES.iter().enumerate() {
        let entity = REPLAY_FORCE.of(&[name]);
        recorder.always(entity.clone(), &style("measured", palette::MEASURED, 1.5))?;
        let values = film.forces.iter().map(|force| force[axis]);
        recorder.on(REPLAY_TIME, entity, &film.times_s, Scalars::new(values).columns_of_unit_batches()?)?;
    }
    let numbered = film.starts.iter().enumerate().map(|(number, (time_s, name))| (*time_s, format!("{}: {name}", number + 1)));
    let (times, names): (Vec<f64>, Vec<String>) = numbered.unzip();
    recorder.on(REPLAY_TIME, REPLAY_LANE.path(), &times, StateChange::new().with_state(names).columns_of_unit_batches()?)
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
