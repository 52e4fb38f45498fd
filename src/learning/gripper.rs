//! The gripper's opening over the phase: closing and opening when the demonstrations did on average, at the speed they did.
//!
//! Averaging openings sample by sample would smear an edge over the spread of its times. Here every demonstration is first warped so
//! that its crossings of the half-way opening lie at the mean crossing times; then openings are averaged.

/// Openings at equally spaced time fractions.
#[derive(Debug, Clone, PartialEq)]
pub struct GripperProfile {
    /// Opening (0 closed, 1 open) at the time fractions `i / (n - 1)` (n >= 2).
    pub openings: Vec<f64>,
}

/// Points of the table: 14 ms of a movement of 28 s.
const POINTS: usize = 2001;
/// An opening moves less than this over a whole demonstration when the gripper is not used (-).
const LEAST_RANGE: f64 = 0.05;
/// A crossing counts once the opening has gone this far past half-way, as a fraction of its range (-).
const HYSTERESIS: f64 = 0.1;

impl GripperProfile {
    /// From openings (K of T_k) at equally spaced time fractions. Also says what could not be honoured.
    pub(super) fn fit(demonstrations: &[Vec<f64>]) -> (Self, Option<String>) {
        let crossings: Vec<Vec<f64>> = demonstrations.iter().map(|d| crossings(d)).collect();
        let count = most_common(crossings.iter().map(Vec::len));
        let used: Vec<usize> = (0..demonstrations.len()).filter(|k| crossings[*k].len() == count).collect();
        let mean = |c: usize| used.iter().map(|k| crossings[*k][c]).sum::<f64>() / used.len() as f64;
        let means: Vec<f64> = (0..count).map(mean).collect();
        let opening = |u: f64| {
            let of = |k: &usize| table(&demonstrations[*k], warped(u, &means, &crossings[*k]));
            used.iter().map(of).sum::<f64>() / used.len().max(1) as f64
        };
        let openings = (0..POINTS).map(|i| opening(i as f64 / (POINTS - 1) as f64)).collect();
        let left_out = demonstrations.len() - used.len();
        let warning = (left_out > 0).then(|| {
            format!("{left_out} demonstrations move the gripper another number of times than {count} and are left out of its profile")
        });
        (Self { openings }, warning)
    }

    /// The opening (0 closed, 1 open) at time fraction `u` (-; clamped to [0, 1]). No allocation.
    #[must_use]
    pub fn opening(&self, u: f64) -> f64 {
        table(&self.openings, u.clamp(0.0, 1.0))
    }
}

/// Time fractions at which the opening passes the middle of its range, once per closing or opening.
fn crossings(openings: &[f64]) -> Vec<f64> {
    let low = openings.iter().copied().fold(f64::INFINITY, f64::min);
    let high = openings.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if high - low < LEAST_RANGE {
        return Vec::new();
    }
    let (middle, margin) = (0.5 * (low + high), HYSTERESIS * (high - low));
    let last = (openings.len() - 1) as f64;
    let mut open = openings[0] > middle;
    let (mut found, mut candidate) = (Vec::new(), None);
    for (i, pair) in openings.windows(2).enumerate() {
        let (a, b) = (pair[0] - middle, pair[1] - middle);
        if (a > 0.0) != (b > 0.0) {
            candidate = Some((i as f64 + a / (a - b)) / last);
        }
        let passed = if open { b < -margin } else { b > margin };
        if passed {
            found.extend(candidate.take());
            open = !open;
        }
    }
    found
}

/// The time fraction of a demonstration that belongs to `u`, when `means[i]` belongs to `own[i]`, 0 to 0 and 1 to 1.
fn warped(u: f64, means: &[f64], own: &[f64]) -> f64 {
    let next = means.iter().position(|m| *m > u).unwrap_or(means.len());
    let at = |list: &[f64], i: usize| if i == 0 { 0.0 } else { list.get(i - 1).copied().unwrap_or(1.0) };
    let (from, to) = (at(means, next), at(means, next + 1));
    let fraction = if to > from { (u - from) / (to - from) } else { 0.0 };
    at(own, next) + fraction * (at(own, next + 1) - at(own, next))
}

/// Linear interpolation in equally spaced values over [0, 1].
fn table(values: &[f64], u: f64) -> f64 {
    let at = u * (values.len() - 1) as f64;
    let before = (at.floor() as usize).min(values.len() - 2);
    let fraction = at - before as f64;
    values[before] * (1.0 - fraction) + values[before + 1] * fraction
}

fn most_common(counts: impl Iterator<Item = usize> + Clone) -> usize {
    let votes = |n: usize| counts.clone().filter(|c| *c == n).count();
    counts.clone().max_by_key(|n| (votes(*n), std::cmp::Reverse(*n))).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn closes_at(u: f64) -> Vec<f64> {
        (0..1001).map(|t| 1.0 - 0.7 * ((f64::from(t) / 1000.0 - u) / 0.02 + 0.5).clamp(0.0, 1.0)).collect()
    }

    #[test]
    fn edges_are_averaged_in_time_and_stay_sharp() {
        let (profile, warning) = GripperProfile::fit(&[closes_at(0.4), closes_at(0.5), closes_at(0.6)]);
        assert!(warning.is_none());
        assert!((profile.opening(0.5) - 0.65).abs() < 1e-3, "half-way at the mean time");
        assert!(profile.opening(0.48) > 0.999 && profile.opening(0.52) < 0.301, "as sharp as taught");
        assert_eq!((profile.opening(-1.0), profile.opening(2.0)), (profile.openings[0], profile.openings[POINTS - 1]));
    }

    #[test]
    fn an_unused_gripper_and_an_odd_demonstration_are_no_trouble() {
        let (constant, _) = GripperProfile::fit(&[vec![1.0; 50], vec![0.99; 70]]);
        assert!((constant.opening(0.3) - 0.995).abs() < 1e-12);
        let (_, warning) = GripperProfile::fit(&[closes_at(0.4), closes_at(0.5), vec![1.0; 100]]);
        assert!(warning.unwrap().contains("1 demonstrations"));
    }
}
