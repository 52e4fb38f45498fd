//! What touched since a run was last looked at: steps are recorded less often than they are made, and a touch may be shorter.

use nalgebra::Point3;

use super::convert;
use super::gap::Gap;

/// Where a pair of parts touched between two records of a run: where it was deepest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TouchPoint {
    /// Number of the pair's [`ContactEpisode`](super::ContactEpisode) among those of the run.
    pub episode: usize,
    /// The distance of the parts (m), negative inside.
    pub distance_m: f64,
    /// The middle of the two deepest points (m, world).
    pub point: Point3<f64>,
}

/// The touches since the last record; one of a pair.
#[derive(Clone, Debug, Default)]
pub(super) struct RecentTouches {
    /// Steps from one record to the next; 0 keeps nothing.
    pub every_steps: u64,
    pub points: Vec<TouchPoint>,
}

impl RecentTouches {
    /// A step begins, after which `step` have been made. The first after a record forgets what that record has seen.
    pub fn begin(&mut self, step: u64) {
        if self.every_steps > 0 && (step - 1).is_multiple_of(self.every_steps) {
            self.points.clear();
        }
    }

    /// Two parts touch.
    pub fn note(&mut self, episode: usize, gap: &Gap) {
        if self.every_steps == 0 {
            return;
        }
        let touch = TouchPoint { episode, distance_m: gap.distance_m, point: convert::point_back(gap.middle()) };
        match self.points.iter_mut().find(|known| known.episode == episode) {
            Some(known) if known.distance_m <= touch.distance_m => {}
            Some(known) => *known = touch,
            None => self.points.push(touch),
        }
    }
}

#[cfg(test)]
mod tests {
    use rapier3d_f64::prelude::Vector;

    use super::*;

    /// Contract: a record tells of each pair the deepest touch since the record before, however short it was.
    #[test]
    fn a_record_sees_the_deepest_touch_since_the_one_before() {
        let mut recent = RecentTouches { every_steps: 10, ..RecentTouches::default() };
        let at = |distance_m: f64| Gap { distance_m, point_a: Vector::new(distance_m, 0.0, 0.0), point_b: Vector::new(0.0, 0.0, 0.0) };
        for step in 1..=20 {
            recent.begin(step);
            match step {
                3 => recent.note(0, &at(-0.001)),
                4 => recent.note(0, &at(-0.004)),
                5 => recent.note(0, &at(-0.002)),
                14 => recent.note(1, &at(-0.003)),
                _ => {}
            }
            let seen: Vec<(usize, f64, f64)> = recent.points.iter().map(|touch| (touch.episode, touch.distance_m, touch.point.x)).collect();
            match step {
                10 => assert_eq!(seen, [(0, -0.004, -0.002)]),
                11 => assert!(seen.is_empty(), "{seen:?}"),
                20 => assert_eq!(seen, [(1, -0.003, -0.0015)]),
                _ => {}
            }
        }
    }
}
