//! Expectation maximisation of a mixture whose samples are seen from several frames.
//!
//! ```text
//! gamma_ti = pi_i prod_j N(x'_tj; mu_ij, Sigma_ij) / sum_k ...
//! pi_i = n_i / T,   mu_ij = sum_t gamma x' / n_i,   Sigma_ij = sum_t gamma (x' - mu)(x' - mu)^T / n_i,   n_i = sum_t gamma
//! ```
//!
//! A sample seen from all frames is one long vector whose covariance is block diagonal: the steps are those of a plain mixture, block by
//! block. The floor raises eigenvalues, which is the exact maximum under that constraint, so the objective never falls.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::TpGmm;
use super::problem::Problem;
use crate::learning::phmm::FitStatus;
use crate::math::{clamp_eigenvalues, softmax_in_place};

/// The objective may fall by this fraction of its scale through rounding.
const ROUNDING: f64 = 1e-9;
/// A component with fewer expected samples stays as it is.
const LEAST_COUNT: f64 = 1e-6;

/// One climb of the objective, in standardised units.
pub(super) struct Run {
    pub(super) model: TpGmm,
    pub(super) history: Vec<f64>,
    pub(super) status: FitStatus,
}

impl Problem<'_> {
    /// Expectation and maximisation until the objective stands still.
    pub(super) fn climb(&self, first: TpGmm) -> Run {
        let rounding = ROUNDING.max(8.0 * f64::EPSILON / self.settings.covariance_floor);
        let (mut model, mut history, mut status) = (first, Vec::new(), FitStatus::IterationLimit);
        let mut kept = model.clone();
        for iteration in 0..=self.settings.max_iterations {
            if !(self.may_go_on)() {
                break;
            }
            let Some((objective, gamma)) = self.expectation(&model).filter(|e| e.0.is_finite()) else {
                (model, status) = (kept, FitStatus::Degenerate);
                break;
            };
            let rise = objective - history.last().copied().unwrap_or(f64::NEG_INFINITY);
            if rise < -rounding * (objective.abs() + self.samples() as f64) {
                (model, status) = (kept, FitStatus::Fell);
                break;
            }
            history.push(objective);
            if self.settings.tolerance > 0.0 && rise < self.settings.tolerance * objective.abs() {
                status = FitStatus::Converged;
                break;
            }
            if iteration < self.settings.max_iterations {
                kept = model.clone();
                model = self.maximised(&gamma, model);
            }
        }
        Run { model, history, status }
    }

    /// Log-likelihood and responsibilities (N x T); `None` when a covariance is not positive definite.
    fn expectation(&self, model: &TpGmm) -> Option<(f64, DMatrix<f64>)> {
        let n = model.components();
        let mut gamma = DMatrix::from_fn(n, self.samples(), |i, _| model.priors[i].ln());
        for ((local, means), covariances) in self.local.iter().zip(&model.means).zip(&model.covariances) {
            for i in 0..n {
                let factor = Cholesky::new(covariances[i].clone())?.l();
                let half_log_determinant: f64 = factor.diagonal().iter().map(|l| l.ln()).sum();
                let normaliser = -0.5 * means[i].len() as f64 * std::f64::consts::TAU.ln() - half_log_determinant;
                let mut whitened = local.clone();
                whitened.column_iter_mut().for_each(|mut column| column -= &means[i]);
                factor.solve_lower_triangular_mut(&mut whitened);
                for (t, column) in whitened.column_iter().enumerate() {
                    gamma[(i, t)] += normaliser - 0.5 * column.norm_squared();
                }
            }
        }
        let log_likelihood = gamma.as_mut_slice().chunks_exact_mut(n).map(softmax_in_place).sum();
        Some((log_likelihood, gamma))
    }

    /// The maximum for these responsibilities (N x T).
    pub(super) fn maximised(&self, gamma: &DMatrix<f64>, present: TpGmm) -> TpGmm {
        let mut next = present;
        for i in 0..next.components() {
            let weights = gamma.row(i);
            let count = weights.sum();
            next.priors[i] = count / self.samples() as f64;
            if count < LEAST_COUNT {
                continue;
            }
            for (j, local) in self.local.iter().enumerate() {
                let mean: DVector<f64> = local * weights.transpose() / count;
                let mut centred = local.clone();
                for (mut column, g) in centred.column_iter_mut().zip(weights.iter()) {
                    column -= &mean;
                    column *= g.sqrt();
                }
                let scatter = &centred * centred.transpose() / count;
                next.covariances[j][i] = clamp_eigenvalues(&scatter, self.settings.covariance_floor).0;
                next.means[j][i] = mean;
            }
        }
        next
    }
}
