//! Dashes: paths in one place would hide each other, so each is thick where no other is.

use nalgebra::Vector3;
use rerun::{LineStrips3D, SerializedComponentColumn};

use super::camera::Camera;
use super::convert;
use super::path::Path;
use super::paths::pieces;
use super::recorder::Fault;
use crate::simulation::StepRecord;

/// How long the part of a way is on which one path may be thick (m), seen from far, unless the way is too short for a part of each. So much of it is
/// thick. The rest is the executed path's, and so is every second part.
const SLOT_M: f64 = 0.052;
const DASH: f64 = 0.7;

/// Paths beside the executed one that are there in any case: the plan, what was taught.
const OWN: usize = 2;

/// Radii of dashes and of what is between them (m), seen from far.
const DASH_RADIUS_M: f64 = 0.0092;
const BETWEEN_M: f64 = 0.0014;

/// Taught paths are many: they have dashes only within such a distance of the plan (m), and are seen from end to end only beyond it, a little
/// thicker than what is between dashes (m, seen from far).
const APART_M: f64 = 0.012;
const TAUGHT_APART_M: f64 = 0.002;

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

/// How a path looks at some place.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Look {
    /// Thick, where others are not.
    Dash,
    /// Thin, between two dashes.
    Between,
    /// Not at all: others are there.
    Nothing,
}

/// Where on the way along the plan which path is thick.
pub(super) struct Dashes {
    /// How thick lines are, as a share of how thick they are seen from far.
    share: f64,
    /// How many parts of the way follow each other before they begin anew, and how long each is (m).
    slots: usize,
    slot_m: f64,
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
        let plan: Vec<_> = plan.places().unwrap_or_default().into_iter().map(&mut told).collect();
        let slots = 2 * (OWN + others);
        let slot_m = (SLOT_M * camera.share).min(way_m / slots as f64).max(f64::MIN_POSITIVE);
        Self { share: camera.share, slots, slot_m, plan }
    }

    /// A path that is known as a whole, from its places (m, world) at shares of the time: a thin line with thick dashes.
    pub fn whole(&self, places: &[(f64, Vector3<f64>)], slot: Slot) -> LineStrips3D {
        let looks: Vec<Look> = places.iter().map(|(share, place)| self.look((*share, place), slot)).collect();
        let mut strips: Vec<(Look, Vec<[f32; 3]>)> = Vec::new();
        for (i, look) in looks.iter().enumerate() {
            let here = convert::vector(&places[i].1);
            match strips.last_mut() {
                Some((last, strip)) if last == look => strip.push(here),
                // Nothing is missing between two that follow each other.
                _ => strips.push((*look, vec![convert::vector(&places[i.saturating_sub(1)].1), here])),
            }
        }
        strips.retain(|(look, _)| *look != Look::Nothing);
        let radii: Vec<f32> = strips.iter().map(|(look, _)| self.radius_m(slot, *look)).collect();
        LineStrips3D::new(strips.into_iter().map(|(_, strip)| strip)).with_radii(radii)
    }

    /// A path that grows, piece by piece, each thick or thin.
    pub fn growing(&self, records: &[StepRecord], slot: Slot) -> Result<impl Iterator<Item = SerializedComponentColumn> + use<>, Fault> {
        let look = |record: &StepRecord| self.look((record.time_fraction, &record.tool.translation.vector), slot);
        let radii = records.iter().map(|record| self.radius_m(slot, look(record)));
        Ok(LineStrips3D::update_fields().with_strips(pieces(records)).with_radii(radii).columns_of_unit_batches()?)
    }

    /// Radius (m) of what looks so.
    fn radius_m(&self, slot: Slot, look: Look) -> f32 {
        let radius_m = match (look, slot) {
            (Look::Dash, _) => DASH_RADIUS_M,
            (_, Slot::Taught) => TAUGHT_APART_M,
            _ => BETWEEN_M,
        };
        (radius_m * self.share) as f32
    }

    /// How a path looks at a place (m, world) that it reaches after a share of the time. How far that is along the way the plan tells: it is
    /// the same for all paths there, however they came.
    fn look(&self, (time, place): (f64, &Vector3<f64>), slot: Slot) -> Look {
        let time = time.clamp(0.0, 1.0);
        let near = self.plan.iter().filter(|(planned, ..)| (planned - time).abs() <= AHEAD);
        let apart = near.map(|(_, planned, way_m)| ((planned - place).norm(), *way_m));
        let Some((apart_m, way_m)) = apart.min_by(|(a, _), (b, _)| a.total_cmp(b)) else { return Look::Between };
        let number = match slot {
            Slot::Planned => 0,
            Slot::Taught => 1,
            Slot::Other(number) => OWN + number,
        };
        let within = way_m / self.slot_m - (2 * number) as f64;
        let has_dash = within.rem_euclid(self.slots as f64) < DASH;
        match (slot, has_dash, apart_m < APART_M * self.share) {
            (Slot::Taught, _, false) => Look::Between,
            (_, true, _) => Look::Dash,
            (Slot::Taught, false, true) => Look::Nothing,
            (_, false, _) => Look::Between,
        }
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
        on_way(1.0, share)
    }

    /// The same on a way of so many metres.
    fn on_way(way_m: f64, share: f64) -> Dashes {
        let times: Vec<f64> = (0..=1000).map(|i| f64::from(i) * 1e-3).collect();
        let values = DMatrix::from_fn(1001, 3, |row, column| if column == 1 { way_m * row as f64 * 1e-3 } else { 0.0 });
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
            let thick = |y: f64| SLOTS.map(|slot| dashes.look((y, &Vector3::new(0.002, y, 0.0)), slot) == Look::Dash);
            let along: Vec<[bool; 4]> = (0..1000).map(|i| thick(f64::from(i) * 1e-3)).collect();
            assert!(along.iter().all(|thick| thick.iter().filter(|thick| **thick).count() <= 1));
            assert!((0..4).all(|slot| along.iter().any(|thick| thick[slot])));
            let free = along.iter().filter(|thick| **thick == [false; 4]).count();
            assert!(free > 550, "more than half of the way is the executed path's: {free}");
        }
    }

    /// Contract: however short the way is, each path has a dash on it.
    #[test]
    fn a_short_way_has_a_dash_of_each() {
        for way_m in [0.3, 0.05, 0.001] {
            let dashes = on_way(way_m, 1.0);
            let has_one = |slot: Slot| {
                (0..1000).map(|i| f64::from(i) * 1e-3).any(|t| dashes.look((t, &Vector3::new(0.0, way_m * t, 0.0)), slot) == Look::Dash)
            };
            assert!(SLOTS.into_iter().all(has_one), "{way_m} m");
        }
        assert_ne!(on_way(0.0, 1.0).look((0.5, &Vector3::zeros()), Slot::Planned), Look::Nothing);
    }

    /// Contract: what is in one place a little later is thick at the same places.
    #[test]
    fn who_waits_keeps_to_the_dashes() {
        let dashes = dashes(1.0);
        for i in 0..90 {
            let place = Vector3::new(0.0, f64::from(i) * 1e-2, 0.0);
            for slot in SLOTS {
                assert_eq!(dashes.look((place.y, &place), slot), dashes.look((place.y + 0.1, &place), slot));
            }
        }
    }

    /// Contract: nothing of a path is left out, but of taught ones what lies on the plan.
    #[test]
    fn a_path_is_drawn_from_end_to_end() {
        let dashes = dashes(1.0);
        let looks = |slot: Slot, x: f64| -> Vec<Look> {
            (0..1000).map(|i| f64::from(i) * 1e-3).map(|y| dashes.look((y, &Vector3::new(x, y, 0.0)), slot)).collect()
        };
        for slot in SLOTS {
            assert!(!looks(slot, 0.05).contains(&Look::Nothing));
            assert_eq!(looks(slot, 0.001).contains(&Look::Nothing), slot == Slot::Taught);
        }
    }
}
