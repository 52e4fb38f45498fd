//! The model and the data it is learned from.

use nalgebra::{Cholesky, DMatrix, DVector};

use crate::learning::{FeatureMap, LearningError};

/// One observed sequence, with the parameters it was observed under.
#[derive(Debug, Clone, PartialEq)]
pub struct Sequence {
    /// Samples, row by row (T x d): the phase input first, then the columns.
    pub values: Vec<f64>,
    /// Variables per sample (d).
    pub dimension: usize,
    /// Task parameters, or features of them (p), constant over the sequence.
    pub theta: DVector<f64>,
}

impl Sequence {
    /// The same samples, with features of the parameters in their place.
    #[must_use]
    pub fn seen_through(self, features: &FeatureMap) -> Self {
        Self { theta: features.at(&self.theta), ..self }
    }

    /// Number of samples (T).
    #[must_use]
    pub fn samples(&self) -> usize {
        self.values.len() / self.dimension.max(1)
    }

    /// Sample `t` (d).
    #[must_use]
    pub fn sample(&self, t: usize) -> &[f64] {
        &self.values[t * self.dimension..(t + 1) * self.dimension]
    }
}

/// A hidden Markov model of `N` states over `d` variables whose means depend linearly on `p` parameters (12). `p` may be 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Phmm {
    /// Probability of each state at the start (N).
    pub initial: DVector<f64>,
    /// Probability of going from the row's state to the column's (N x N).
    pub transition: DMatrix<f64>,
    /// `W_i` (N of d x p): how the mean moves with the parameters.
    pub weights: Vec<DMatrix<f64>>,
    /// `mean_i` (N of d): the mean at `theta = 0`.
    pub means: Vec<DVector<f64>>,
    /// `Sigma_i` (N of d x d, SPD).
    pub covariances: Vec<DMatrix<f64>>,
}

impl Phmm {
    /// Number of states (N).
    #[must_use]
    pub fn states(&self) -> usize {
        self.means.len()
    }

    /// Number of variables (d), the phase input included.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.means.first().map_or(0, DVector::len)
    }

    /// Number of parameters (p).
    #[must_use]
    pub fn parameters(&self) -> usize {
        self.weights.first().map_or(0, DMatrix::ncols)
    }

    /// `mu_i(theta) = W_i theta + mean_i` (d), for `theta` (p).
    #[must_use]
    pub fn mean_at(&self, state: usize, theta: &DVector<f64>) -> DVector<f64> {
        &self.means[state] + &self.weights[state] * theta
    }

    /// Checks shapes, finite entries, probabilities that sum to one, and positive definite covariances.
    ///
    /// # Errors
    /// The first thing that is wrong, with the state it belongs to.
    pub fn check(&self) -> Result<(), LearningError> {
        let (n, d, p) = (self.states(), self.dimension(), self.parameters());
        let wrong = |what: String| Err(LearningError::Model(what));
        if n == 0 || d < 2 {
            return wrong(format!("{n} states over {d} variables; at least 1 state over the phase and one column"));
        }
        if self.initial.len() != n || self.transition.shape() != (n, n) || self.weights.len() != n || self.covariances.len() != n {
            return wrong(format!("initial, transition, weights, means and covariances disagree about the number of states ({n})"));
        }
        let rows = std::iter::once(self.initial.clone()).chain(self.transition.row_iter().map(|row| row.transpose()));
        for (i, row) in rows.enumerate() {
            let sum: f64 = row.iter().sum();
            if row.iter().any(|a| !(0.0..=1.0 + 1e-9).contains(a)) || (sum - 1.0).abs() > 1e-6 {
                let name = if i == 0 { "initial".to_owned() } else { format!("transition row {}", i - 1) };
                return wrong(format!("{name} is not a probability distribution (sum {sum})"));
            }
        }
        for i in 0..n {
            if self.means[i].len() != d || self.weights[i].shape() != (d, p) || self.covariances[i].shape() != (d, d) {
                return wrong(format!("state {i}: mean, weights or covariance do not have {d} rows and {p} parameters"));
            }
            let numbers = self.means[i].iter().chain(self.weights[i].iter()).chain(self.covariances[i].iter());
            if numbers.copied().any(|x| !x.is_finite()) {
                return wrong(format!("state {i}: a number is not finite"));
            }
            let c = &self.covariances[i];
            if (c - c.transpose()).amax() > 1e-9 * c.amax() || Cholesky::new(c.clone()).is_none() {
                return wrong(format!("state {i}: the covariance is not symmetric positive definite"));
            }
        }
        Ok(())
    }
}
