//! The expectation step: what every visited state says about the parameters.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::estimate::Problem;
use crate::learning::phmm::{Sequence, expect};
use crate::learning::{Gmr, LearningError};

/// Fewer expected samples in a state are no observation of it.
const LEAST_COUNT: f64 = 0.5;
/// A deviation from the demonstrations lasts about this many states.
const STATES_PER_DEVIATION: f64 = 2.0;

/// One state's observation: its mean residual, how that moves with the features, and its precision.
pub(super) struct Visit {
    pub(super) residual: DVector<f64>,
    pub(super) slope: DMatrix<f64>,
    pub(super) precision: DMatrix<f64>,
}

impl Problem<'_> {
    /// The expectation step: what every visited state says at `theta`, and the log-likelihood.
    pub(super) fn visits(&self, theta: &DVector<f64>) -> Result<(Vec<Visit>, f64), LearningError> {
        let (n, d) = (self.phmm.states(), self.motion.columns.len());
        let phi = self.motion.parameters.features.at(theta);
        let goal = self.motion.goal.at(&phi);
        let mut values = Vec::with_capacity(self.part.inputs.len() * (d + 1));
        for ((input, s), target) in self.part.inputs.iter().zip(&self.part.phases).zip(&self.part.targets) {
            values.push(*input);
            values.extend(target.iter().zip(goal.iter()).map(|(a, g)| a + (s - 1.0) * g));
        }
        let sequence = Sequence { values, dimension: d + 1, theta: phi };
        let degenerate = || LearningError::Model("a covariance is not positive definite".to_owned());
        let expectation = expect(self.phmm, &sequence).filter(|e| e.log_likelihood.is_finite()).ok_or_else(degenerate)?;
        let gmr = Gmr::new(&self.phmm.means, &self.phmm.covariances, 1)?;
        let mut visits = Vec::new();
        for i in 0..n {
            let (mut count, mut mean, mut phase) = (0.0, DVector::zeros(d + 1), 0.0);
            for t in 0..sequence.samples() {
                let g = expectation.responsibilities()[t * n + i];
                count += g;
                phase += g * self.part.phases[t];
                for (m, x) in mean.iter_mut().zip(sequence.sample(t)) {
                    *m += g * x;
                }
            }
            if count >= LEAST_COUNT {
                visits.push(self.visit(i, count, &(mean / count), phase / count, &sequence.theta, &gmr).ok_or_else(degenerate)?);
            }
        }
        Ok((visits, expectation.log_likelihood))
    }

    fn visit(&self, state: usize, count: f64, mean: &DVector<f64>, phase: f64, phi: &DVector<f64>, gmr: &Gmr) -> Option<Visit> {
        let d = mean.len() - 1;
        let off = mean - self.phmm.mean_at(state, phi);
        let weights = &self.phmm.weights[state];
        let gain = gmr.gain(state);
        let slope = &self.motion.goal.weights * (phase - 1.0) - weights.rows(1, d) + gain * weights.rows(0, 1);
        let (doubt, correction) = self.motion.evidence.get(state).map_or((0.0, 1.0), |e| {
            let m = e.demonstrations;
            (e.ratio(phi), m / (m - 1.0 - phi.len() as f64).max(1.0))
        });
        let between = self.skill.compliance.between.get(state)?;
        let partial = off[0] * off[0] / self.phmm.covariances[state][(0, 0)];
        let repeated = between * (STATES_PER_DEVIATION * correction * (1.0 + doubt));
        let variance = repeated + gmr.conditional_covariance(state) * (1.0 / count + partial);
        let residual = off.rows(1, d) - gain * off.rows(0, 1);
        Some(Visit { residual: residual.column(0).into_owned(), slope, precision: Cholesky::new(variance)?.inverse() })
    }
}
