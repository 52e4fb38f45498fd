//! Which state made which sample: the forward and backward recursions.
//!
//! ```text
//! alpha_t(j) = b_j(x_t) sum_i alpha_{t-1}(i) a_ij             beta_t(i) = sum_j a_ij b_j(x_{t+1}) beta_{t+1}(j)
//! gamma_t(i) = alpha_t(i) beta_t(i) / sum_j alpha_t(j) beta_t(j)
//! xi_t(i, j) = gamma_t(i) a_ij b_j(x_{t+1}) beta_{t+1}(j) / beta_t(i)
//! ```
//!
//! Densities come as logarithms, and the recursions exist twice. [`log_recursion`](super::log_recursion) keeps logarithms throughout and
//! is right for any data. [`scaled_recursion`](super::scaled_recursion) needs no logarithm per state, and refuses where underflow could
//! matter.

use nalgebra::{DMatrix, DVector};

use super::emission::LogDensities;
use super::scaled_recursion::LEAST_LOG_SCALE;
use super::{Phmm, Sequence};

/// The result of the expectation step for one sequence.
#[derive(Debug, Clone, Default)]
pub struct Expectation {
    /// Log-likelihood of the sequence.
    pub log_likelihood: f64,
    /// `gamma`: probability of each state at each sample, row by row (T x N).
    pub(super) responsibilities: Vec<f64>,
    /// `sum_t xi_t`: expected number of transitions (N x N).
    pub transitions: DMatrix<f64>,
    /// Outside these states the responsibilities of a sample are 0 (T).
    pub(super) spans: Vec<Span>,
    /// `sum_t ln c_t`; `None` before the scaled recursion has succeeded.
    pub(super) log_scale: Option<f64>,
}

impl Expectation {
    /// `gamma`: probability of each state at each sample, row by row (T x N).
    #[must_use]
    pub fn responsibilities(&self) -> &[f64] {
        &self.responsibilities
    }
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
    pub(super) outward: Outward,
    /// Expected number of times each outward edge is taken.
    pub(super) counts: Vec<f64>,
    densities: LogDensities,
    /// `c_t` (T).
    pub(super) scales: Vec<f64>,
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
pub(super) struct Outward {
    first: Vec<usize>,
    pub(super) others: Vec<(usize, f64)>,
}

impl Outward {
    fn set(&mut self, states: usize, edges: &[Edge]) {
        self.first.clear();
        self.first.extend((0..=states).map(|state| edges.partition_point(|edge| edge.from < state)));
        self.others.clear();
        self.others.extend(edges.iter().map(|edge| (edge.to, edge.probability)));
    }

    pub(super) fn of(&self, state: usize) -> Span {
        self.first[state]..self.first[state + 1]
    }
}

/// The states from the first to the last that are not 0; a model that is passed in order has few of them at any time.
pub(super) type Span = std::ops::Range<usize>;

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
        let foreseen = out.log_scale.map(|before| 1.1 * before - 10.0).filter(|least| *least > LEAST_LOG_SCALE);
        // Each attempt overwrites the logarithms of densities.
        let mut definite = true;
        let done = foreseen.into_iter().chain([LEAST_LOG_SCALE]).any(|least| {
            definite = definite && densities.set(model, sequence);
            definite && self.scaled(&mut densities, least, out)
        });
        if definite && !done {
            densities.set(model, sequence);
            *out = self.in_logarithms(&densities.values);
        }
        self.densities = densities;
        definite
    }
}
