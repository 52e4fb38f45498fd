//! The mixture, and what it makes of new frames.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::Frame;
use crate::learning::{Gmr, LearningError};
use crate::math::Gaussian;

/// A mixture of `N` components over the phase input and `d` columns, as `P` frames see them.
#[derive(Debug, Clone, PartialEq)]
pub struct TpGmm {
    /// `pi_i` (N).
    pub priors: DVector<f64>,
    /// `mu_ij`: by frame, then by component (P of N of 1 + d).
    pub means: Vec<Vec<DVector<f64>>>,
    /// `Sigma_ij`: by frame, then by component (P of N of 1 + d square, SPD).
    pub covariances: Vec<Vec<DMatrix<f64>>>,
}

impl TpGmm {
    /// Number of components (N).
    #[must_use]
    pub fn components(&self) -> usize {
        self.priors.len()
    }

    /// The product of Gaussians for new frames (P): one per component, over the phase input and the columns in coordinates of the task.
    ///
    /// `Sigma_i = (sum_j S_ij^-1)^-1`, `mu_i = Sigma_i sum_j S_ij^-1 m_ij`, for frame `j`'s Gaussian `N(m_ij, S_ij)`.
    ///
    /// # Errors
    /// When the number or dimension of the frames is not that of the demonstrations, or a covariance is not positive definite.
    pub fn product(&self, frames: &[Frame]) -> Result<Vec<Gaussian>, LearningError> {
        let d = self.means.first().and_then(|means| means.first()).map_or(0, DVector::len);
        if frames.len() != self.means.len() || frames.iter().any(|frame| frame.dimension() + 1 != d) {
            let expected = format!("{} frames over {} columns", self.means.len(), d.saturating_sub(1));
            return Err(LearningError::Request(format!("{} frames are given, but the mixture was learned with {expected}", frames.len())));
        }
        (0..self.components()).map(|i| self.product_of(i, frames)).collect()
    }

    /// The regression over the phase input for new frames (P).
    ///
    /// # Errors
    /// As [`Self::product`].
    pub fn regression(&self, frames: &[Frame]) -> Result<Gmr, LearningError> {
        let components = self.product(frames)?;
        let means: Vec<DVector<f64>> = components.iter().map(|g| g.mean().clone()).collect();
        let covariances: Vec<DMatrix<f64>> = components.iter().map(|g| g.covariance().clone()).collect();
        Gmr::new(&means, &covariances, 1)
    }

    /// The movement for new frames (P) at these phase inputs (T): one row per input (T x d).
    ///
    /// # Errors
    /// As [`Self::product`].
    pub fn reproduce(&self, frames: &[Frame], inputs: &[f64]) -> Result<DMatrix<f64>, LearningError> {
        let gmr = self.regression(frames)?;
        let rows: Vec<_> = inputs.iter().map(|u| gmr.mean(&[*u]).transpose()).collect();
        Ok(if rows.is_empty() { DMatrix::zeros(0, gmr.outputs()) } else { DMatrix::from_rows(&rows) })
    }

    fn product_of(&self, component: usize, frames: &[Frame]) -> Result<Gaussian, LearningError> {
        let not_definite = || LearningError::Model(format!("component {component}: a covariance is not positive definite"));
        let d = self.means[0][component].len();
        let (mut precision, mut weighted) = (DMatrix::zeros(d, d), DVector::zeros(d));
        for (frame, (means, covariances)) in frames.iter().zip(self.means.iter().zip(&self.covariances)) {
            let (mean, covariance) = frame.global(&means[component], &covariances[component]);
            let inverse = Cholesky::new((&covariance + covariance.transpose()) * 0.5).ok_or_else(not_definite)?.inverse();
            weighted += &inverse * mean;
            precision += inverse;
        }
        let factor = Cholesky::new(precision).ok_or_else(not_definite)?;
        Ok(Gaussian::new(factor.solve(&weighted), factor.inverse())?)
    }
}
