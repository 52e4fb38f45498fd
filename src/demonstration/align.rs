//! Demonstrations brought to one timing: one smooth, strictly rising warp per demonstration, for all its columns together.
//!
//! ```text
//! DTW of each demonstration k against the medoid  ->  slopes of the path  ->  averaged over a window  ->  h_k(u) = integral of the slope
//! m(u) = mean_k h_k(u)                                 time fraction w of demonstration k becomes m(h_k^-1(w))
//! ```
//!
//! Only time stamps change: no sample is touched, so motion, orientation, wrench and gripper stay together. Averaging a slope that lies in
//! [1/3, 3] keeps it there, so warps rise strictly; composing with `m` keeps the mean timing, and both ends stay where they are.

use nalgebra::DMatrix;

use super::align_features::{POINTS, features};
use super::{Dataset, Demonstration, DemonstrationError, Trajectory};

/// Half-width of the window over which slopes are averaged, three times over, as a fraction of the movement (-).
const SMOOTHING: f64 = 0.05;
/// Cost of a warp by the whole movement, in squared standard deviations (-): keeps still phases from being warped at will.
const STRAIGHTNESS: f64 = 4.0;

/// Demonstrations with one timing.
#[derive(Debug, Clone, PartialEq)]
pub struct Aligned {
    /// The dataset with new time stamps; durations are kept.
    pub dataset: Dataset,
    /// Index of the demonstration that the others were compared with: the one with the least cost to all.
    pub reference: usize,
    /// The largest shift in time of each demonstration (s).
    pub shifts_s: Vec<f64>,
}

impl Dataset {
    /// All demonstrations with one timing, by their motion columns. A single demonstration stays as it is.
    ///
    /// # Errors
    /// When a motion column is missing.
    pub fn aligned(&self) -> Result<Aligned, DemonstrationError> {
        let features = features(self)?;
        let costs = |k: usize| features.iter().map(|other| warp(&features[k], other).0).sum::<f64>();
        let totals: Vec<f64> = (0..features.len()).map(costs).collect();
        let reference = (0..totals.len()).min_by(|a, b| totals[*a].total_cmp(&totals[*b])).unwrap_or(0);
        let warps: Vec<Vec<f64>> = features.iter().map(|f| warp(&features[reference], f).1).collect();
        let mean: Vec<f64> = (0..POINTS).map(|i| warps.iter().map(|h| h[i]).sum::<f64>() / warps.len() as f64).collect();
        let mut aligned = Aligned { dataset: self.clone(), reference, shifts_s: Vec::new() };
        for (demonstration, h) in aligned.dataset.demonstrations.iter_mut().zip(&warps) {
            aligned.shifts_s.push(retime(demonstration, |w| table(&mean, inverse(h, w))));
        }
        Ok(aligned)
    }
}

/// Steps of a path (reference, demonstration): slopes 1, 1/2, 1/3, 2, 3.
const STEPS: [(usize, usize); 5] = [(1, 1), (2, 1), (3, 1), (1, 2), (1, 3)];

/// The cheapest path of `b` along `a` and its smoothed form: at each grid point of `a` the time fraction of `b` (points).
fn warp(a: &DMatrix<f64>, b: &DMatrix<f64>) -> (f64, Vec<f64>) {
    let n = POINTS;
    let local = |i: usize, j: usize| {
        let off = (i as f64 - j as f64) / (n - 1) as f64;
        (a.row(i) - b.row(j)).norm_squared() + STRAIGHTNESS * off * off
    };
    let costs = DMatrix::from_fn(n, n, local);
    let mut totals = DMatrix::from_element(n, n, f64::INFINITY);
    let mut from = DMatrix::from_element(n, n, 0usize);
    totals[(0, 0)] = 0.0;
    for i in 1..n {
        for j in 1..n {
            for (choice, (di, dj)) in STEPS.iter().enumerate().filter(|(_, (di, dj))| *di <= i && *dj <= j) {
                // Weighted by the length of the step, so that no slope is cheaper than another.
                let total = totals[(i - di, j - dj)] + 0.5 * (di + dj) as f64 * costs[(i, j)];
                if total < totals[(i, j)] {
                    (totals[(i, j)], from[(i, j)]) = (total, choice);
                }
            }
        }
    }
    let mut slopes = vec![1.0; n - 1];
    let (mut i, mut j) = (n - 1, n - 1);
    while i > 0 {
        let (di, dj) = STEPS[from[(i, j)]];
        slopes[i - di..i].fill(dj as f64 / di as f64);
        (i, j) = (i - di, j - dj);
    }
    (totals[(n - 1, n - 1)], integrated(&smoothed(slopes)))
}

/// Averaged three times over a window: nearly a Gaussian, and twice differentiable.
fn smoothed(mut slopes: Vec<f64>) -> Vec<f64> {
    let half = (SMOOTHING * POINTS as f64).round() as usize;
    for _ in 0..3 {
        let at = |i: usize| {
            let (from, to) = (i.saturating_sub(half), (i + half + 1).min(slopes.len()));
            slopes[from..to].iter().sum::<f64>() / (to - from) as f64
        };
        slopes = (0..slopes.len()).map(at).collect();
    }
    slopes
}

/// The integral of slopes, from 0 to 1.
fn integrated(slopes: &[f64]) -> Vec<f64> {
    let total: f64 = slopes.iter().sum();
    let mut sum = 0.0;
    let mut values = vec![0.0];
    values.extend(slopes.iter().map(|slope| {
        sum += slope;
        sum / total
    }));
    values
}

/// Cubic interpolation (Catmull and Rom) in values at equally spaced points of [0, 1].
fn table(values: &[f64], u: f64) -> f64 {
    let last = values.len() - 1;
    let at = u.clamp(0.0, 1.0) * last as f64;
    let i = (at as usize).min(last - 1);
    let r = at - i as f64;
    let slope = |k: usize| match k {
        0 => values[1] - values[0],
        k if k == last => values[last] - values[last - 1],
        k => 0.5 * (values[k + 1] - values[k - 1]),
    };
    let (a, b) = (values[i], values[i + 1]);
    let (r2, r3) = (r * r, r * r * r);
    a * (2.0 * r3 - 3.0 * r2 + 1.0) + slope(i) * (r3 - 2.0 * r2 + r) + b * (3.0 * r2 - 2.0 * r3) + slope(i + 1) * (r3 - r2)
}

/// Where a rising table has the value `w`, by bisection.
fn inverse(values: &[f64], w: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if table(values, middle) < w { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Gives every sample the time fraction `to(its own)`; the ends are kept. The largest shift (s).
fn retime(demonstration: &mut Demonstration, to: impl Fn(f64) -> f64) -> f64 {
    let trajectory = &demonstration.trajectory;
    let (start, duration, n) = (trajectory.times_s()[0], trajectory.duration_s(), trajectory.samples());
    let mut times = trajectory.times_s().to_vec();
    for time in &mut times[1..n - 1] {
        *time = start + duration * to((*time - start) / duration);
    }
    // Samples closer together than rounding would otherwise coincide.
    let rises = times.windows(2).all(|t| t[1] > t[0]);
    let shift = times.iter().zip(trajectory.times_s()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    if !rises {
        return 0.0;
    }
    demonstration.trajectory = Trajectory::unchecked(times, trajectory.columns().to_vec(), trajectory.values().clone());
    shift
}

#[cfg(test)]
mod tests {
    use super::super::ParameterSource;
    use super::*;

    /// The same path, walked with different timing: `u^power` of a curve in the plane.
    fn walked(power: f64, duration: f64) -> Demonstration {
        let values = DMatrix::from_fn(201, 3, |t, j| {
            let u = (t as f64 / 200.0).powf(power);
            [u, (4.0 * u).sin(), u][j]
        });
        let times = (0..201).map(|t| duration * t as f64 / 200.0).collect();
        let trajectory = Trajectory::new(times, ["x_m", "y_m", "gripper"].map(str::to_owned).to_vec(), values).unwrap();
        Demonstration { name: format!("power_{power}"), trajectory, theta_m: Vec::new(), theta_f: Vec::new() }
    }

    fn dataset(demonstrations: Vec<Demonstration>) -> Dataset {
        let motion = ["x_m", "y_m"].map(str::to_owned).to_vec();
        Dataset { motion, wrench: Vec::new(), parameter_source: ParameterSource::Given, demonstrations }
    }

    /// Largest distance between two demonstrations at equal time fractions.
    fn distance(data: &Dataset) -> f64 {
        let grids: Vec<_> =
            data.demonstrations.iter().map(|d| d.trajectory.resampled(100.0 / d.trajectory.duration_s()).unwrap()).collect();
        let off = grids[0].select(&data.motion).unwrap() - grids[1].select(&data.motion).unwrap();
        off.row_iter().map(|row| row.norm()).fold(0.0, f64::max)
    }

    #[test]
    fn different_timings_of_one_path_are_undone_and_samples_stay_untouched() {
        let before = dataset(vec![walked(0.8, 2.0), walked(1.3, 3.0)]);
        let aligned = before.aligned().unwrap();
        assert!(distance(&aligned.dataset) < 0.3 * distance(&before), "{} of {}", distance(&aligned.dataset), distance(&before));
        assert!(aligned.shifts_s.iter().all(|s| *s > 0.02 && *s < 0.6), "{:?}", aligned.shifts_s);
        for (a, b) in aligned.dataset.demonstrations.iter().zip(&before.demonstrations) {
            assert_eq!(a.trajectory.values(), b.trajectory.values());
            assert_eq!(a.trajectory.duration_s(), b.trajectory.duration_s());
            assert!(a.trajectory.times_s().windows(2).all(|t| t[1] > t[0]));
        }
    }

    #[test]
    fn equal_timings_are_left_alone() {
        let aligned = dataset(vec![walked(1.0, 2.0), walked(1.0, 5.0), walked(1.0, 1.0)]).aligned().unwrap();
        assert!(aligned.shifts_s.iter().all(|s| *s < 1e-9), "{:?}", aligned.shifts_s);
        assert!(dataset(vec![walked(1.0, 2.0)]).aligned().unwrap().shifts_s[0] < 1e-9);
    }

    /// Contract: what is beside a straight path is noise, and says nothing about time.
    #[test]
    fn equal_timings_of_straight_paths_are_left_alone() {
        let reach = |k: usize| {
            let mut one = walked(1.0, 2.0);
            let noise = |t: usize, j: usize| 5e-4 * ((t * 37 + j * 11 + k * 101) as f64).sin();
            let s = |t: usize| (t as f64 / 200.0).powi(2) * (3.0 - t as f64 / 100.0);
            let values = DMatrix::from_fn(201, 3, |t, j| {
                [(0.5 + 0.1 * k as f64) * s(t), 0.2 * s(t), 0.5][j] + if j < 2 { noise(t, j) } else { 0.0 }
            });
            one.trajectory = Trajectory::new(one.trajectory.times_s().to_vec(), one.trajectory.columns().to_vec(), values).unwrap();
            one
        };
        for motion in [&["x_m", "y_m"][..], &["x_m"]] {
            let mut straight = dataset((0..5).map(reach).collect());
            straight.motion = motion.iter().map(|name| (*name).to_owned()).collect();
            let aligned = straight.aligned().unwrap();
            assert!(aligned.shifts_s.iter().all(|s| *s < 0.03), "{motion:?}: {:?}", aligned.shifts_s);
        }
    }

    /// Contract: another start, or another size, of one path in one timing is no other timing, though the places are others.
    #[test]
    fn equal_timings_of_moved_and_scaled_paths_are_left_alone() {
        let moved = |k: usize| {
            let mut one = walked(1.0, 2.0);
            let (size, shift) = (1.0 + 0.2 * k as f64, [0.3 * k as f64, -0.2 * (k * k) as f64, 0.0]);
            let scale = if k < 3 { 1.0 } else { size };
            let noise = |t: usize, j: usize| 5e-4 * ((t * 37 + j * 11 + k * 101) as f64).sin();
            let values =
                DMatrix::from_fn(201, 3, |t, j| scale * one.trajectory.values()[(t, j)] + shift[j] + if j < 2 { noise(t, j) } else { 0.0 });
            let values = DMatrix::from_fn(201, 3, |t, j| if j == 2 { values[(t, j)].clamp(0.0, 1.0) } else { values[(t, j)] });
            one.trajectory = Trajectory::new(one.trajectory.times_s().to_vec(), one.trajectory.columns().to_vec(), values).unwrap();
            one
        };
        let aligned = dataset((0..5).map(moved).collect()).aligned().unwrap();
        assert!(aligned.shifts_s.iter().all(|s| *s < 0.02), "{:?}", aligned.shifts_s);
    }
}
