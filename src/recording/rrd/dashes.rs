//! Dashes: paths in one place would hide each other, so each is thick where no other is.

use nalgebra::Vector3;
use rerun::{LineStrips3D, SerializedComponentColumn};

use super::camera::Camera;
use super::convert;
use super::paths::{Path, pieces};
use super::recorder::Fault;
use crate::simulation::StepRecord;

/// How long the part of a way is on which one path may be thick, and how much of it is (m), seen from far. The rest is the executed path's.
const SLOT_M: f64 = 0.05;
const DASH_M: f64 = 0.034;

/// Radii of dashes, of those of taught paths, which are many, and of what is between the dashes (m), seen from far.
const DASH_RADIUS_M: f64 = 0.0065;
const TAUGHT_RADIUS_M: f64 = 0.0045;
const BETWEEN_M: f64 = 0.0016;

/// A path is at most so much ahead of the plan or behind it, as a share of the time.
const AHEAD: f64 = 0.12;

/// Which part of the way is a path's own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Slot {
    /// What was planned.
    Planned,
    /// What was taught.
    Taught,
    /// What stands beside it, by number.
    Other(usize),
}

/// Where on the way along the plan which path is thick.
pub(super) struct Dashes {
    /// How thick lines are, as a share of how thick they are seen from far.
    share: f64,
    /// How many paths have a part of the way.
    slots: usize,
    /// The plan: shares of the time, places (m, world), and how far they are along it (m); nothing for one that does not lead through space.
    plan: Vec<(f64, Vector3<f64>, f64)>,
}

impl Dashes {
    /// For a plan beside which `others` stand, as a camera sees them.
    pub fn along(plan: &Path, others: usize, camera: &Camera) -> Self {
        let mut way_m = 0.0;
        let mut before = None;
        let mut told = |(share, place): (f64, Vector3<f64>)| {
            way_m += before.replace(place).map_or(0.0, |before| (place - before).norm());
            (share, place, way_m)
        };
        let plan = plan.places().unwrap_or_default().into_iter().map(&mut told).collect();
        Self { share: camera.share, slots: 2 + others, plan }
    }

    /// A path that is known as a whole, from its places (m, world) at shares of the time: a thin line with thick dashes.
    pub fn whole(&self, places: &[(f64, Vector3<f64>)], slot: Slot) -> LineStrips3D {
        let all = places.iter().map(|(_, place)| convert::vector(place)).collect();
        let mut strips: Vec<Vec<[f32; 3]>> = vec![all];
        let mut inside = false;
        for (share, place) in places {
            let thick = self.is_thick((*share, place), slot);
            if thick && !inside {
                strips.push(Vec::new());
            }
            inside = thick;
            strips.last_mut().filter(|_| thick).into_iter().for_each(|strip| strip.push(convert::vector(place)));
        }
        let radii: Vec<f32> = (0..strips.len()).map(|i| self.radius_m(slot, i > 0)).collect();
        LineStrips3D::new(strips).with_radii(radii)
    }

    /// A path that grows, piece by piece, each thick or thin.
    pub fn growing(&self, records: &[StepRecord], slot: Slot) -> Result<impl Iterator<Item = SerializedComponentColumn> + use<>, Fault> {
        let thick = |record: &StepRecord| self.is_thick((record.time_fraction, &record.tool.translation.vector), slot);
        let radii = records.iter().map(|record| self.radius_m(slot, thick(record)));
        Ok(LineStrips3D::update_fields().with_strips(pieces(records)).with_radii(radii).columns_of_unit_batches()?)
    }

    /// Radius (m) in a dash or between two.
    fn radius_m(&self, slot: Slot, thick: bool) -> f32 {
        let radius_m = match (thick, slot) {
            (false, _) => BETWEEN_M,
            (true, Slot::Taught) => TAUGHT_RADIUS_M,
            (true, _) => DASH_RADIUS_M,
        };
        (radius_m * self.share) as f32
    }

    /// Whether a path is thick at a place (m, world) that it reaches after a share of the time. How far that is along the way the plan tells: it
    /// is the same for all paths there, however they came.
    fn is_thick(&self, (time, place): (f64, &Vector3<f64>), slot: Slot) -> bool {
        let time = time.clamp(0.0, 1.0);
        let near = self.plan.iter().filter(|(planned, ..)| (planned - time).abs() <= AHEAD);
        let nearest = near.min_by(|(_, a, _), (_, b, _)| (a - place).norm().total_cmp(&(b - place).norm()));
        let number = match slot {
            Slot::Planned => 0,
            Slot::Taught => 1,
            Slot::Other(number) => 2 + number,
        };
        nearest.is_some_and(|(.., way_m)| {
            let within_m = way_m / self.share - number as f64 * SLOT_M;
            within_m.rem_euclid(self.slots as f64 * SLOT_M) < DASH_M
        })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::super::paths::COLUMNS;
    use super::*;
    use crate::demonstration::Trajectory;

    /// A way of 1 m along y in 1 s, and dashes on it.
    fn dashes(share: f64) -> Dashes {
        let times: Vec<f64> = (0..=1000).map(|i| f64::from(i) * 1e-3).collect();
        let values = DMatrix::from_fn(1001, 3, |row, column| if column == 1 { row as f64 * 1e-3 } else { 0.0 });
        let plan = Trajectory::new(times, COLUMNS.map(String::from).to_vec(), values).expect("a trajectory");
        let camera = Camera { eye: Vector3::x(), target: Vector3::zeros(), words: 1.0, share };
        Dashes::along(&Path::new(&plan, 1.0), 2, &camera)
    }

    const SLOTS: [Slot; 4] = [Slot::Planned, Slot::Taught, Slot::Other(0), Slot::Other(1)];

    /// Contract: wherever paths are in one place at most one of them is thick; each is somewhere, and somewhere none is, for the executed path.
    #[test]
    fn no_path_hides_another() {
        for share in [1.0, 0.3] {
            let dashes = dashes(share);
            let thick = |y: f64| SLOTS.map(|slot| dashes.is_thick((y, &Vector3::new(0.002, y, 0.0)), slot));
            let along: Vec<[bool; 4]> = (0..1000).map(|i| thick(f64::from(i) * 1e-3)).collect();
            assert!(along.iter().all(|thick| thick.iter().filter(|thick| **thick).count() <= 1));
            assert!((0..4).all(|slot| along.iter().any(|thick| thick[slot])) && along.contains(&[false; 4]));
        }
    }

    /// Contract: what is in one place a little later is thick at the same places.
    #[test]
    fn who_waits_keeps_to_the_dashes() {
        let dashes = dashes(1.0);
        for i in 0..90 {
            let place = Vector3::new(0.0, f64::from(i) * 1e-2, 0.0);
            for slot in SLOTS {
                assert_eq!(dashes.is_thick((place.y, &place), slot), dashes.is_thick((place.y + 0.1, &place), slot));
            }
        }
    }

    /// Contract: nothing of a path is left out.
    #[test]
    fn a_path_is_drawn_from_end_to_end() {
        let places: Vec<(f64, Vector3<f64>)> = (0..=50).map(|i| (f64::from(i) / 50.0, Vector3::y() * f64::from(i) / 50.0)).collect();
        let dashes = dashes(1.0);
        let drawn = dashes.whole(&places, Slot::Planned);
        let strips = drawn.strips.expect("strips").list_array().expect("a list").clone();
        assert!(strips.len() > 3, "{} strips", strips.len());
    }
}
