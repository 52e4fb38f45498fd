//! What happens to a pair of shapes between two moments at which it is known.
//!
//! The bound. Let no point of one shape move by more than a length L relative to the other, along its path and both shapes' motions added.
//! Then their distance (negative inside) changes by at most L, so between two moments with the distances d0 and d1 it is nowhere less than
//! (d0 + d1 - L) / 2. An interval in which that bound leaves nothing to find is done; another one is halved, until L is below
//! [`RESOLUTION_M`]. So two parts that are together thicker than that cannot pass through each other unseen, however far apart the moments
//! are, and no distance is found too large by more than [`tolerance_m`]. (Conservative advancement: Mirtich, 1996; here by halving.)

use super::gap::Gap;

/// How finely a passage is looked at (m): a twentieth of a millimetre, less than any part is thick or placed exactly.
pub const RESOLUTION_M: f64 = 5e-5;

/// Up to this distance the resolution holds for distances too (m).
pub const NEAR_M: f64 = 0.05;

/// By how much a distance may be told too large (m): the resolution when it is near, a fiftieth of it when it is far and nobody minds.
pub(super) fn tolerance_m(distance_m: f64) -> f64 {
    // What is not known yet is at no distance.
    if distance_m <= NEAR_M || distance_m.is_infinite() { RESOLUTION_M } else { distance_m / 50.0 }
}

/// A moment of the passage.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment {
    /// Fraction of the interval, 0 … 1.
    pub fraction: f64,
    /// How the pair is then.
    pub gap: Gap,
}

/// The least that a distance can be between two moments, while the pair moves by `travel_m` (m).
pub(super) fn least_between(d0_m: f64, d1_m: f64, travel_m: f64) -> f64 {
    0.5 * (d0_m + d1_m - travel_m)
}

/// The search of one interval.
pub(super) struct Passage<G> {
    /// The pair at a fraction of the interval; `None` when it cannot be told.
    pub gap_at: G,
    /// Bound on the motion during the whole interval (m).
    pub travel_m: f64,
    /// Distances that are not below this one are of no interest, unless the shapes touch (m).
    pub floor_m: f64,
    /// The nearest, or deepest, moment below the floor.
    pub least: Option<Moment>,
    /// First and last fraction at which they touch.
    pub touch: Option<(f64, f64)>,
}

impl<G: Fn(f64) -> Option<Gap>> Passage<G> {
    /// Searches the interval whose ends are known.
    pub(super) fn search(&mut self, start: Gap, end: Gap) {
        let (start, end) = (Moment { fraction: 0.0, gap: start }, Moment { fraction: 1.0, gap: end });
        self.note(start);
        self.note(end);
        self.halve(start, end);
    }

    /// Looks at the end of the interval alone.
    pub(super) fn arrive(&mut self, end: Gap) {
        self.note(Moment { fraction: 1.0, gap: end });
    }

    fn halve(&mut self, start: Moment, end: Moment) {
        let travel_m = self.travel_m * (end.fraction - start.fraction);
        let (d0, d1) = (start.gap.distance_m, end.gap.distance_m);
        let least = least_between(d0, d1, travel_m);
        let may_begin_or_end = least <= 0.0 && (d0 > 0.0 || d1 > 0.0);
        if !may_begin_or_end && least >= self.floor_m - tolerance_m(self.floor_m) {
            return;
        }
        if travel_m <= RESOLUTION_M {
            self.note_crossing(start, end);
            return;
        }
        let fraction = 0.5 * (start.fraction + end.fraction);
        let Some(gap) = (self.gap_at)(fraction) else { return };
        let middle = Moment { fraction, gap };
        self.note(middle);
        self.halve(start, middle);
        self.halve(middle, end);
    }

    fn note(&mut self, moment: Moment) {
        if moment.gap.distance_m < self.floor_m {
            self.floor_m = moment.gap.distance_m;
            self.least = Some(moment);
        }
        if moment.gap.distance_m <= 0.0 {
            self.note_touch(moment.fraction);
        }
    }

    /// Between a moment apart and a moment inside, the touch begins or ends where a straight line says so.
    fn note_crossing(&mut self, start: Moment, end: Moment) {
        let (d0, d1) = (start.gap.distance_m, end.gap.distance_m);
        if (d0 > 0.0) != (d1 > 0.0) {
            self.note_touch(start.fraction + (end.fraction - start.fraction) * d0 / (d0 - d1));
        }
    }

    fn note_touch(&mut self, fraction: f64) {
        let (first, last) = self.touch.unwrap_or((fraction, fraction));
        self.touch = Some((first.min(fraction), last.max(fraction)));
    }
}

#[cfg(test)]
mod tests {
    use rapier3d_f64::prelude::Vector;

    use super::*;

    fn search(distance: impl Fn(f64) -> f64, travel_m: f64) -> Passage<impl Fn(f64) -> Option<Gap>> {
        let gap_at = move |t: f64| Some(Gap { distance_m: distance(t), point_a: Vector::ZERO, point_b: Vector::ZERO });
        let (start, end) = (gap_at(0.0).expect("known"), gap_at(1.0).expect("known"));
        let mut passage = Passage { gap_at, travel_m, floor_m: f64::INFINITY, least: None, touch: None };
        passage.search(start, end);
        passage
    }

    /// Contract: a sheet that is crossed in a hundredth of the interval is found, with its times and its depth.
    #[test]
    fn what_is_crossed_between_two_moments_is_found() {
        // A point moves 0.2 m through a sheet of 0.5 mm whose middle is at 0.07 m.
        let passage = search(|t| (0.2 * t - 0.07).abs() - 0.25e-3, 0.2);
        let (first, last) = passage.touch.expect("it touches");
        assert!((first - (0.07 - 0.25e-3) / 0.2).abs() < 1e-6 && (last - (0.07 + 0.25e-3) / 0.2).abs() < 1e-6, "{first} {last}");
        let least = passage.least.expect("a least one").gap.distance_m;
        assert!((least + 0.25e-3).abs() <= RESOLUTION_M, "{least}");
    }

    /// Contract: among curves whose slope keeps the bound, no least distance is missed by more than the resolution (brute force).
    #[test]
    fn no_distance_is_found_too_large() {
        for k in 0..200 {
            let (a, b, c) = (0.01 * f64::from(k % 7), 0.003 * f64::from(k % 11), 5.0 + f64::from(k % 13));
            let distance = move |t: f64| 0.02 + a * (t - 0.5) + b * (c * t).sin();
            let found = search(distance, a + b * c).least.expect("a least one").gap.distance_m;
            let truth = (0..=200_000).map(|i| distance(f64::from(i) / 2e5)).fold(f64::INFINITY, f64::min);
            assert!(found >= truth - 1e-6 && found <= truth + tolerance_m(found), "{found} {truth}");
        }
    }
}
