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
    /// The largest normal force since that record (N); NaN of a touch that the engine did not see because it began and ended within a step.
    pub force_n: f64,
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

    /// Two parts touch, with a normal force (N) if the engine tells it.
    pub fn note(&mut self, episode: usize, gap: &Gap, force_n: f64) {
        if self.every_steps == 0 {
            return;
        }
        let mut touch = TouchPoint { episode, distance_m: gap.distance_m, point: convert::point_back(gap.middle()), force_n };
        let Some(known) = self.points.iter_mut().find(|known| known.episode == episode) else {
            self.points.push(touch);
            return;
        };
        touch.force_n = touch.force_n.max(known.force_n);
        if touch.distance_m < known.distance_m {
            *known = touch;
        }
        known.force_n = touch.force_n;
    }
}

#[cfg(test)]
mod tests {
    use rapier3d_f64::prelude::Vector;

    use super::*;

    /// Contract: a record tells of each pair the deepest touch and the largest force since the record before, however short they were.
    #[test]
    fn a_record_sees_the_deepest_touch_since_the_one_before() {
        let mut recent = RecentTouches { every_steps: 10, ..RecentTouches::default() };
        let at = |distance_m: f64| Gap { distance_m, point_a: Vector::new(distance_m, 0.0, 0.0), point_b: Vector::new(0.0, 0.0, 0.0) };
        for step in 1..=20 {
            recent.begin(step);
            match step {
                3 => recent.note(0, &at(-0.001), f64::NAN),
                4 => recent.note(0, &at(-0.004), 2.0),
                5 => recent.note(0, &at(-0.002), 3.0),
                14 => recent.note(1, &at(-0.003), 1.0),
                _ => {}
            }
            let told = |touch: &TouchPoint| (touch.episode, touch.distance_m, touch.point.x, touch.force_n);
            let seen: Vec<(usize, f64, f64, f64)> = recent.points.iter().map(told).collect();
            match step {
                10 => assert_eq!(seen, [(0, -0.004, -0.002, 3.0)]),
                11 => assert!(seen.is_empty(), "{seen:?}"),
                20 => assert_eq!(seen, [(1, -0.003, -0.0015, 1.0)]),
                _ => {}
            }
        }
    }
}
