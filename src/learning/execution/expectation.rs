//! What the models of a skill expect along the movement, beside its mean path: the wrench, and how far people vary.

use nalgebra::{DMatrix, DVector};

use crate::learning::cpdmp::Predictive;
use crate::learning::{LearningError, Skill};

impl Skill {
    /// The wrench `F_des(theta_f, s)` at time fractions `u` (T; clamped to [0, 1]): T x w, in the order of the force model's columns.
    ///
    /// # Errors
    /// When the skill has no force model, or parameters are missing or unknown.
    pub fn expected_wrench(&self, theta_f: &[(String, f64)], u: &[f64]) -> Result<DMatrix<f64>, LearningError> {
        let Some(force) = &self.force else {
            return Err(LearningError::Request("the skill has no force model: no wrench is expected".to_owned()));
        };
        let gmr = force.regression_at(&force.parameters.resolve(theta_f)?)?;
        let at = |u: &f64| gmr.mean(&[force.phase_input.at(u.clamp(0.0, 1.0), self.motion.alpha)]);
        Ok(rows(force.columns.len(), u.iter().map(at)))
    }

    /// Standard deviation of every motion column (unit of the column) at time fractions `u` (T; clamped to [0, 1]), for parameters `theta`
    /// (p): T x d. It is that of the forcing term (15), which moves the spring's equilibrium one to one: the spread of slow deviations that
    /// demonstrations show, and what is not known for want of demonstrations, which grows outside of what they cover.
    ///
    /// # Errors
    /// When the skill is the baseline, which has no covariance, or does not hold the evidence it was learned from.
    pub fn deviation(&self, theta: &DVector<f64>, u: &[f64]) -> Result<DMatrix<f64>, LearningError> {
        let Some(expected) = self.motion.predictives(theta, u)? else {
            let why = "no covariance is known: the skill is the baseline, or does not hold the evidence it was learned from";
            return Err(LearningError::Request(why.to_owned()));
        };
        let deviations = |at: &Predictive| at.covariance().diagonal().map(|variance| variance.max(0.0).sqrt());
        Ok(rows(self.motion.columns.len(), expected.iter().map(deviations)))
    }
}

fn rows(columns: usize, rows: impl ExactSizeIterator<Item = DVector<f64>>) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(rows.len(), columns);
    for (mut target, row) in matrix.row_iter_mut().zip(rows) {
        target.copy_from(&row.transpose());
    }
    matrix
}
