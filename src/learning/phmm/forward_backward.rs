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

use super::emission::LogDensities;
use super::{Phmm, Sequence};

/// Smaller scaled values are set to 0: arithmetic with almost-underflown numbers is many times slower.
const NOTHING: f64 = 1e-290;

/// `ln 1e-256`: see the module's text.
const SMALLEST_SCALED_LIKELIHOOD: f64 = -589.0;

/// The result of the expectation step for one sequence.
#[derive(Debug, Clone, Default)]
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
    let mut expectation = Expectation::default();
    Recursions::of(&model.initial, &model.transition).expect(model, sequence, &mut expectation).then_some(expectation)
}

/// The transitions that exist, and the memory that the recursions use again for every sequence and model.
#[derive(Default)]
pub(super) struct Recursions {
    pub(super) initial: Vec<f64>,
    /// Sorted by `from`, then by `to`.
    pub(super) edges: Vec<Edge>,
    outward: Outward,
    /// Expected number of times each outward edge is taken.
    counts: Vec<f64>,
    densities: LogDensities,
    /// `c_t` (T).
    scales: Vec<f64>,
    /// Which states something arrives at (T).
    spans: Vec<Span>,
}

/// A transition that exists, and its probability.
#[derive(Clone, Copy)]
pub(super) struct Edge {
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) probability: f64,
}

/// The edges by where they start: those of state `i` are `first[i]..first[i + 1]`, each with where it leads and its probability.
#[derive(Default)]
struct Outward {
    first: Vec<usize>,
    others: Vec<(usize, f64)>,
}

impl Outward {
    fn set(&mut self, states: usize, edges: &[Edge]) {
        self.first.clear();
        self.first.extend((0..=states).map(|state| edges.partition_point(|edge| edge.from < state)));
        self.others.clear();
        self.others.extend(edges.iter().map(|edge| (edge.to, edge.probability)));
    }

    fn of(&self, state: usize) -> Span {
        self.first[state]..self.first[state + 1]
    }
}

/// The states from the first to the last that are not 0; a model that is passed in order has few of them at any time.
type Span = std::ops::Range<usize>;

fn span(values: &[f64]) -> Span {
    let first = values.iter().position(|v| *v != 0.0).unwrap_or(0);
    first..values.iter().rposition(|v| *v != 0.0).map_or(first, |last| last + 1)
}

impl Recursions {
    pub(super) fn of(initial: &DVector<f64>, transition: &DMatrix<f64>) -> Self {
        let mut recursions = Self::default();
        recursions.set(initial, transition);
        recursions
    }

    /// Takes another model's transitions; the memory stays.
    pub(super) fn set(&mut self, initial: &DVector<f64>, transition: &DMatrix<f64>) {
        let n = initial.len();
        self.initial.clear();
        self.initial.extend(initial.iter());
        self.edges.clear();
        for from in 0..n {
            let to = (0..n).map(|to| Edge { from, to, probability: transition[(from, to)] });
            self.edges.extend(to.filter(|edge| edge.probability > 0.0));
        }
        self.outward.set(n, &self.edges);
    }

    /// As [`expect`], into an expectation whose memory is used again; whether every covariance is positive definite.
    pub(super) fn expect(&mut self, model: &Phmm, sequence: &Sequence, out: &mut Expectation) -> bool {
        let mut densities = std::mem::take(&mut self.densities);
        let definite = densities.set(model, sequence);
        if definite && !self.scaled(&mut densities, out) {
            // The scaled recursion has overwritten the logarithms that it refused.
            densities.set(model, sequence);
            *out = self.in_logarithms(&densities.values);
        }
        self.densities = densities;
        definite
    }

    /// The recursions with scaling; densities are overwritten by scaled ones. `false` when underflow could matter.
    pub(super) fn scaled(&mut self, densities: &mut LogDensities, out: &mut Expectation) -> bool {
        let n = self.initial.len();
        out.responsibilities.clear();
        out.responsibilities.resize(densities.values.len(), 0.0);
        self.scales.clear();
        self.spans.clear();
        let (mut scaled_likelihood, mut shifts) = (0.0, 0.0);
        let (mut arriving, mut states) = (self.initial.clone(), span(&self.initial));
        let rows = densities.values.chunks_exact_mut(n).zip(out.responsibilities.chunks_exact_mut(n));
        for ((b, alpha), shift) in rows.zip(&densities.largest) {
            shifts += shift;
            let mut total = 0.0;
            for ((b, alpha), arriving) in b[states.clone()].iter_mut().zip(&mut alpha[states.clone()]).zip(&arriving[states.clone()]) {
                *b = if *arriving == 0.0 { 0.0 } else { exponential(*b - shift) };
                *alpha = arriving * *b;
                total += *alpha;
            }
            let scale = total.recip();
            alpha[states.clone()].iter_mut().for_each(|a| *a = something(*a * scale));
            scaled_likelihood += total.ln();
            if scaled_likelihood.is_nan() || scaled_likelihood < SMALLEST_SCALED_LIKELIHOOD {
                return false;
            }
            self.scales.push(total);
            self.spans.push(states.clone());
            states = self.arrive(alpha, states, &mut arriving);
        }
        out.log_likelihood = scaled_likelihood + shifts;
        self.scaled_backward(&densities.values, out);
        true
    }

    /// `sum_i alpha_t(i) a_ij`, and the states at which it is not 0.
    fn arrive(&self, alpha: &[f64], states: Span, arriving: &mut [f64]) -> Span {
        arriving.fill(0.0);
        let (mut first, mut last) = (arriving.len(), 0);
        for state in states.filter(|state| alpha[*state] != 0.0) {
            for (to, probability) in &self.outward.others[self.outward.of(state)] {
                arriving[*to] += probability * alpha[state];
                (first, last) = (first.min(*to), last.max(*to + 1));
            }
        }
        first.min(last)..last
    }

    /// Turns normalised `alpha` into `gamma` (T x N) and sums `xi` (N x N).
    fn scaled_backward(&mut self, b: &[f64], out: &mut Expectation) {
        let n = self.initial.len();
        self.counts.clear();
        self.counts.resize(self.edges.len(), 0.0);
        let (mut beta, mut ahead) = (vec![1.0; n], vec![0.0; n]);
        for t in (0..self.scales.len().saturating_sub(1)).rev() {
            let scale = self.scales[t + 1].recip();
            ahead.fill(0.0);
            let next = self.spans[t + 1].clone();
            for (ahead, (b, beta)) in ahead[next.clone()].iter_mut().zip(b[(t + 1) * n..][next.clone()].iter().zip(&beta[next])) {
                *ahead = b * beta * scale;
            }
            let row = &mut out.responsibilities[t * n..(t + 1) * n];
            for state in self.spans[t].clone() {
                let (own, alpha) = (self.outward.of(state), row[state]);
                let mut sum = 0.0;
                for ((to, probability), count) in self.outward.others[own.clone()].iter().zip(&mut self.counts[own]) {
                    let onward = probability * ahead[*to];
                    sum += onward;
                    *count += alpha * onward;
                }
                beta[state] = something(sum);
                row[state] = alpha * beta[state];
            }
        }
        out.transitions = DMatrix::zeros(n, n);
        for (edge, count) in self.edges.iter().zip(&self.counts) {
            out.transitions[(edge.from, edge.to)] = *count;
        }
    }
}

/// The value, or 0 when it is [`NOTHING`].
fn something(value: f64) -> f64 {
    if value < NOTHING { 0.0 } else { value }
}

/// `exp x`, or 0 when it is [`NOTHING`]. Scaled by the largest density of **all** states, or what is lost would have no bound; taken for
/// states that can be there at all (`arriving > 0`) only, since the others have `alpha = 0` whatever their density: most exponentials of a
/// chain that is passed in order are saved. A row of `-inf` gives not-a-number, which ends the scaled recursion.
fn exponential(x: f64) -> f64 {
    /// `ln 1e-290`.
    const NOTHING: f64 = -667.7;
    if x < NOTHING { 0.0 } else { x.exp() }
}
