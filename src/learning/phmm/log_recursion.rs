//! The forward and backward recursions in logarithms: right however unlikely the data and however far apart the states are.
//!
//! One shift per sample takes the exponentials of a whole row at once. Where the shifted sum comes near the smallest float, the sum is
//! taken again with its own shift, so that nothing is lost.

use nalgebra::DMatrix;

use super::forward_backward::{Edge, Expectation, Recursions};
use crate::math::{log_sum_exp, softmax_in_place};

/// A shifted sum below this may have lost terms to underflow (1e-308) that matter at double precision (1e-16): take it exactly.
const SMALLEST_SAFE_SUM: f64 = 1e-280;

impl Recursions {
    /// The recursions from log densities (T x N).
    pub(super) fn in_logarithms(&self, log_b: &[f64]) -> Expectation {
        let log_alpha = self.log_forward(log_b);
        let log_likelihood = log_alpha.chunks_exact(self.initial.len()).last().map_or(0.0, log_sum_exp);
        let (responsibilities, transitions) = self.log_backward(log_b, log_alpha);
        let spans = vec![0..self.initial.len(); responsibilities.len() / self.initial.len()];
        Expectation { log_likelihood, responsibilities, transitions, spans, log_scale: None }
    }

    /// `ln alpha` (T x N).
    fn log_forward(&self, log_b: &[f64]) -> Vec<f64> {
        let n = self.initial.len();
        let mut log_alpha = Vec::with_capacity(log_b.len());
        log_alpha.extend(self.initial.iter().zip(log_b).map(|(p, b)| p.ln() + b));
        let into = self.neighbours(|edge| (edge.to, edge.from));
        let mut shifted = vec![0.0; n];
        for row in log_b.chunks_exact(n).skip(1) {
            let before = log_alpha.len() - n;
            let shift = exponentials(&log_alpha[before..], &mut shifted);
            for (entries, b) in into.iter().zip(row) {
                let log_sum = log_weighted_sum(entries, &shifted, shift, &log_alpha[before..before + n]).0;
                log_alpha.push(log_sum + b);
            }
        }
        log_alpha
    }

    /// Turns `ln alpha` into `gamma` (T x N) and sums `xi` (N x N).
    fn log_backward(&self, log_b: &[f64], log_alpha: Vec<f64>) -> (Vec<f64>, DMatrix<f64>) {
        let n = self.initial.len();
        let mut gamma = log_alpha;
        let out_of = self.neighbours(|edge| (edge.from, edge.to));
        let mut transitions = DMatrix::zeros(n, n);
        let (mut log_beta, mut ahead, mut shifted, mut sums) = (vec![0.0; n], vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        let samples = gamma.len() / n;
        for t in (0..samples).rev() {
            let row = &mut gamma[t * n..(t + 1) * n];
            if t + 1 == samples {
                softmax_in_place(row);
                continue;
            }
            for (a, (b, beta)) in ahead.iter_mut().zip(log_b[(t + 1) * n..(t + 2) * n].iter().zip(&log_beta)) {
                *a = b + beta;
            }
            let shift = exponentials(&ahead, &mut shifted);
            for i in 0..n {
                (log_beta[i], sums[i]) = log_weighted_sum(&out_of[i], &shifted, shift, &ahead);
                row[i] += log_beta[i];
            }
            softmax_in_place(row);
            for i in (0..n).filter(|i| row[*i] > 0.0) {
                for (j, a) in &out_of[i] {
                    let safe = sums[i] > SMALLEST_SAFE_SUM;
                    let share = if safe { a * shifted[*j] / sums[i] } else { (a.ln() + ahead[*j] - log_beta[i]).exp() };
                    transitions[(i, *j)] += row[i] * share;
                }
            }
        }
        (gamma, transitions)
    }

    /// Per state, the states at the other end of its transitions with their probabilities; `ends` says which end is whose.
    fn neighbours(&self, ends: fn(&Edge) -> (usize, usize)) -> Vec<Vec<(usize, f64)>> {
        let mut lists = vec![Vec::new(); self.initial.len()];
        for edge in &self.edges {
            let (of, other) = ends(edge);
            lists[of].push((other, edge.probability));
        }
        lists
    }
}

/// `exp(x_i - max x)` into `shifted`; returns the shift (0 when all are `-inf`).
fn exponentials(log_values: &[f64], shifted: &mut [f64]) -> f64 {
    let largest = log_values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let shift = if largest == f64::NEG_INFINITY { 0.0 } else { largest };
    for (s, x) in shifted.iter_mut().zip(log_values) {
        *s = (x - shift).exp();
    }
    shift
}

/// `ln sum_i a_i exp(x_i)` over the listed entries, and the shifted sum it was read from.
fn log_weighted_sum(entries: &[(usize, f64)], shifted: &[f64], shift: f64, log_values: &[f64]) -> (f64, f64) {
    let sum: f64 = entries.iter().map(|(i, a)| a * shifted[*i]).sum();
    if sum > SMALLEST_SAFE_SUM {
        return (shift + sum.ln(), sum);
    }
    let largest = entries.iter().map(|(i, _)| log_values[*i]).fold(f64::NEG_INFINITY, f64::max);
    if largest == f64::NEG_INFINITY {
        return (largest, sum);
    }
    (largest + entries.iter().map(|(i, a)| a * (log_values[*i] - largest).exp()).sum::<f64>().ln(), sum)
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::super::emission::LogDensities;
    use super::super::scaled_recursion::LEAST_LOG_SCALE;
    use super::super::{Phmm, Sequence, expect};
    use super::*;
    use crate::math::{stream, uniform};

    /// Sums over every path of states.
    fn brute_force(initial: &DVector<f64>, transition: &DMatrix<f64>, log_b: &[f64]) -> Expectation {
        let n = initial.len();
        let samples = log_b.len() / n;
        let paths: Vec<Vec<usize>> = (0..n.pow(samples as u32)).map(|p| (0..samples).map(|t| p / n.pow(t as u32) % n).collect()).collect();
        let weight = |path: &Vec<usize>| {
            let moves: f64 = path.windows(2).map(|ij| transition[(ij[0], ij[1])].ln()).sum();
            initial[path[0]].ln() + moves + path.iter().enumerate().map(|(t, i)| log_b[t * n + i]).sum::<f64>()
        };
        let weights: Vec<f64> = paths.iter().map(weight).collect();
        let log_likelihood = log_sum_exp(&weights);
        let mut e = Expectation {
            log_likelihood,
            responsibilities: vec![0.0; log_b.len()],
            transitions: DMatrix::zeros(n, n),
            ..Expectation::default()
        };
        for (path, w) in paths.iter().zip(&weights) {
            let p = (w - log_likelihood).exp();
            path.iter().enumerate().for_each(|(t, i)| e.responsibilities[t * n + i] += p);
            path.windows(2).for_each(|ij| e.transitions[(ij[0], ij[1])] += p);
        }
        e
    }

    fn scaled(chain: &mut Recursions, least: f64, log_b: &[f64]) -> Option<Expectation> {
        let mut expectation = Expectation::default();
        let largest = log_b.chunks_exact(chain.initial.len()).map(|row| row.iter().copied().fold(f64::NEG_INFINITY, f64::max)).collect();
        chain.scaled(&mut LogDensities { values: log_b.to_vec(), largest }, least, &mut expectation).then_some(expectation)
    }

    fn assert_equal(a: &Expectation, b: &Expectation, what: &str) {
        let scale = b.log_likelihood.abs().max(1.0);
        assert!((a.log_likelihood - b.log_likelihood).abs() < 1e-12 * scale, "{what}: log-likelihood");
        let gamma = a.responsibilities.iter().zip(&b.responsibilities).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        let xi = (&a.transitions - &b.transitions).amax();
        assert!(gamma < 1e-12 * scale && xi < 1e-12 * scale, "{what}: gamma off by {gamma}, xi by {xi}");
    }

    /// Random chains with forbidden transitions; `spread` is how far apart log densities are.
    fn random_chain(seed: u64, spread: f64) -> (DVector<f64>, DMatrix<f64>, Vec<f64>) {
        let mut random = stream(seed, "chains", 0);
        let n = 3;
        let mut draw = |forbid: bool| if forbid { 0.0 } else { uniform(&mut random, 0.05, 1.0) };
        let mut transition = DMatrix::from_fn(n, n, |i, j| draw(seed.is_multiple_of(2) && (j < i || j > i + 1)));
        let mut initial = DVector::from_fn(n, |i, _| draw(seed.is_multiple_of(2) && i > 0));
        initial /= initial.sum();
        for mut row in transition.row_iter_mut() {
            row /= row.sum();
        }
        let log_b = (0..6 * n).map(|_| uniform(&mut random, -spread, 0.0)).collect();
        (initial, transition, log_b)
    }

    #[test]
    fn both_recursions_equal_the_sum_over_all_paths() {
        for seed in 0..40 {
            let (initial, transition, log_b) = random_chain(seed, 20.0);
            let (mut chain, truth) = (Recursions::of(&initial, &transition), brute_force(&initial, &transition, &log_b));
            assert_equal(&chain.in_logarithms(&log_b), &truth, "logarithms");
            let first = scaled(&mut chain, LEAST_LOG_SCALE, &log_b).unwrap();
            let log_scale = first.log_scale.unwrap();
            assert_equal(&first, &truth, "scaled");
            assert_equal(&scaled(&mut chain, log_scale - 1e-6, &log_b).unwrap(), &truth, "scaled with the highest threshold");
            assert!(scaled(&mut chain, log_scale + 1e-6, &log_b).is_none(), "a likelihood below the least one is refused");
        }
    }

    #[test]
    fn logarithms_survive_what_scaling_refuses() {
        for seed in 0..40 {
            let (initial, transition, log_b) = random_chain(seed, 5000.0);
            let (mut chain, truth) = (Recursions::of(&initial, &transition), brute_force(&initial, &transition, &log_b));
            assert_equal(&chain.in_logarithms(&log_b), &truth, "logarithms");
            if let Some(scaled) = scaled(&mut chain, LEAST_LOG_SCALE, &log_b) {
                assert_equal(&scaled, &truth, "scaled");
            }
        }
    }

    #[test]
    fn a_likelihood_below_the_foreseen_one_changes_nothing() {
        let model = Phmm {
            initial: DVector::from_vec(vec![0.9, 0.1]),
            transition: DMatrix::from_row_slice(2, 2, &[0.9, 0.1, 0.2, 0.8]),
            weights: vec![DMatrix::zeros(2, 0); 2],
            means: vec![DVector::zeros(2), DVector::from_element(2, 3.0)],
            covariances: vec![DMatrix::identity(2, 2); 2],
        };
        let mut random = stream(0, "values", 0);
        let values = (0..100).map(|_| uniform(&mut random, -1.0, 4.0)).collect();
        let sequence = Sequence { values, dimension: 2, theta: DVector::zeros(0) };
        let fresh = expect(&model, &sequence).unwrap();
        assert!(fresh.log_scale.unwrap() < -10.0, "the foreseen likelihood below is too high");
        let mut misled = Expectation { log_scale: Some(0.0), ..Expectation::default() };
        assert!(Recursions::of(&model.initial, &model.transition).expect(&model, &sequence, &mut misled));
        assert_eq!((misled.log_likelihood, misled.responsibilities), (fresh.log_likelihood, fresh.responsibilities));
    }
}
