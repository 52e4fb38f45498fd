//! Which state made which sample: the forward and backward recursions.
//!
//! ```text
//! alpha_t(j) = b_j(x_t) sum_i alpha_{t-1}(i) a_ij             beta_t(i) = sum_j a_ij b_j(x_{t+1}) beta_{t+1}(j)
//! gamma_t(i) = alpha_t(i) beta_t(i) / sum_j alpha_t(j) beta_t(j)
//! xi_t(i, j) = gamma_t(i) a_ij b_j(x_{t+1}) beta_{t+1}(j) / beta_t(i)
//! ```
//!
//! Densities come as logarithms, and the recursions exist twice. [`log_recursion`](super::log_recursion) keeps logarithms throughout and
//! is right for any data. The one here takes the largest density of each sample out (`b~ = b / max b <= 1`), normalises `alpha` at every
//! step, and needs no logarithm per state. Values below [`NOTHING`] become 0, and what is lost by that is bounded: a path through a state
//! with normalised `alpha_t(i) < 1e-290` contributes at most `1e-290 prod_{s<=t} c_s` to the likelihood `prod_s c_s`, because `b~ <= 1`
//! makes `beta~ <= 1`. So as long as the product of all `c_s` stays above [`SMALLEST_SCALED_LIKELIHOOD`], less than 1e-30 of the likelihood
//! is lost; where it does not, the logarithms take over.

use nalgebra::{DMatrix, DVector};

use super::emission::log_densities;
use super::{Phmm, Sequence};

/// Smaller scaled values are set to 0: arithmetic with almost-underflown numbers is many times slower.
const NOTHING: f64 = 1e-290;

/// `ln 1e-256`: see the module's text.
const SMALLEST_SCALED_LIKELIHOOD: f64 = -589.0;

/// The result of the expectation step for one sequence.
#[derive(Debug, Clone)]
pub struct Expectation {
    /// Log-likelihood of the sequence.
    pub log_likelihood: f64,
    /// `gamma`: probability of each state at each sample, row by row (T x N).
    pub responsibilities: Vec<f64>,
    /// `sum_t xi_t`: expected number of transitions (N x N).
    pub transitions: DMatrix<f64>,
}

/// Runs the expectation step for one sequence. `None` when a covariance is not positive definite.
#[must_use]
pub fn expect(model: &Phmm, sequence: &Sequence) -> Option<Expectation> {
    let log_b = log_densities(model, sequence)?;
    let chain = Chain::new(&model.initial, &model.transition);
    Some(chain.scaled(&log_b).unwrap_or_else(|| chain.in_logarithms(&log_b)))
}

/// The transitions that exist.
pub(super) struct Chain {
    pub(super) initial: Vec<f64>,
    /// Sorted by `from`, then by `to`.
    pub(super) edges: Vec<Edge>,
}

/// A transition that exists, and its probability.
#[derive(Clone, Copy)]
pub(super) struct Edge {
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) probability: f64,
}

impl Chain {
    pub(super) fn new(initial: &DVector<f64>, transition: &DMatrix<f64>) -> Self {
        let n = initial.len();
        let pairs = (0..n).flat_map(|from| (0..n).map(move |to| (from, to)));
        let edges = pairs.map(|(from, to)| Edge { from, to, probability: transition[(from, to)] });
        Self { initial: initial.iter().copied().collect(), edges: edges.filter(|e| e.probability > 0.0).collect() }
    }

    /// The recursions with scaling, from log densities (T x N); `None` when underflow could matter.
    pub(super) fn scaled(&self, log_b: &[f64]) -> Option<Expectation> {
        let n = self.initial.len();
        let (mut b, mut alpha) = (Vec::with_capacity(log_b.len()), Vec::with_capacity(log_b.len()));
        let mut c = Vec::with_capacity(log_b.len() / n);
        let (mut scaled_likelihood, mut shifts) = (0.0, 0.0);
        let mut arriving = self.initial.clone();
        for log_row in log_b.chunks_exact(n) {
            let row = alpha.len();
            shifts += push_shifted(log_row, &arriving, &mut b);
            alpha.extend(arriving.iter().zip(&b[row..]).map(|(a, b)| a * b));
            let total: f64 = alpha[row..].iter().sum();
            let scale = total.recip();
            alpha[row..].iter_mut().for_each(|a| *a = something(*a * scale));
            c.push(total);
            scaled_likelihood += total.ln();
            if scaled_likelihood.is_nan() || scaled_likelihood < SMALLEST_SCALED_LIKELIHOOD {
                return None;
            }
            arriving.fill(0.0);
            for edge in &self.edges {
                arriving[edge.to] += edge.probability * alpha[row + edge.from];
            }
        }
        let transitions = self.scaled_backward(&b, &c, &mut alpha);
        Some(Expectation { log_likelihood: scaled_likelihood + shifts, responsibilities: alpha, transitions })
    }

    /// Turns normalised `alpha` into `gamma` (T x N) and sums `xi` (N x N).
    fn scaled_backward(&self, b: &[f64], c: &[f64], alpha: &mut [f64]) -> DMatrix<f64> {
        let n = self.initial.len();
        let mut counts = vec![0.0; self.edges.len()];
        let (mut beta, mut ahead) = (vec![1.0; n], vec![0.0; n]);
        for t in (0..c.len().saturating_sub(1)).rev() {
            let scale = c[t + 1].recip();
            for (a, (b, beta)) in ahead.iter_mut().zip(b[(t + 1) * n..(t + 2) * n].iter().zip(&beta)) {
                *a = b * beta * scale;
            }
            let row = &mut alpha[t * n..(t + 1) * n];
            beta.fill(0.0);
            for (edge, count) in self.edges.iter().zip(&mut counts) {
                let onward = edge.probability * ahead[edge.to];
                beta[edge.from] += onward;
                *count += row[edge.from] * onward;
            }
            for (gamma, beta) in row.iter_mut().zip(&mut beta) {
                *beta = something(*beta);
                *gamma *= *beta;
            }
        }
        let mut transitions = DMatrix::zeros(n, n);
        for (edge, count) in self.edges.iter().zip(counts) {
            transitions[(edge.from, edge.to)] = count;
        }
        transitions
    }
}

/// The value, or 0 when it is [`NOTHING`].
fn something(value: f64) -> f64 {
    if value < NOTHING { 0.0 } else { value }
}

/// Appends `exp(x_i - max x)` of the states that can be there at all (`arriving > 0`), 0 for the others, and returns the shift. A state that
/// nothing arrives at has `alpha = 0` whatever its density, and most exponentials of a chain that is passed in order are saved. The maximum
/// is over all states, or what is lost would have no bound. A row of `-inf` becomes not-a-number, which ends the scaled recursion.
fn push_shifted(log_row: &[f64], arriving: &[f64], b: &mut Vec<f64>) -> f64 {
    /// `ln 1e-290`.
    const NOTHING: f64 = -667.7;
    let shift = log_row.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let relative = |(x, a): (&f64, &f64)| if *a == 0.0 || x - shift < NOTHING { 0.0 } else { (x - shift).exp() };
    b.extend(log_row.iter().zip(arriving).map(relative));
    shift
}
