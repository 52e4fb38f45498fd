//! How far to trust the forcing term: the spread demonstrations show, and what is not known for want of demonstrations.
//!
//! ```text
//! aleatoric(u) = covariance of the regression at u                      what a further demonstration at a shown theta would scatter
//! epistemic(u) = sum_i h_i(u) C_i r_i(theta)                            C_i: state's covariance given the phase
//! r_i(theta)   = Omega^T Lambda_i^-1 Omega                              posterior of Z_i, see phmm::evidence
//! ratio        = mean over u of sum_i h_i(u) r_i(theta)
//! ```
//!
//! Bumps (rbf) vanish away from the demonstrations, and the posterior of their weights with them. What is not known there is taken to grow
//! as for a straight line through demonstrations spread evenly over their range: by `12 e^2 / m_i`, with the extrapolation `e` in widths of
//! the range and the number `m_i` of demonstrations behind a state.
//!
//! `Sigma_i (1 + r_i)` is the predictive covariance of one state; both parts weigh the states as the regression does.

use nalgebra::{DMatrix, DVector};

use super::{MotionModel, Shaping};
use crate::learning::{FeatureMap, Gmr, LearningError};

/// Points of the movement that the ratio is averaged over.
const POINTS: usize = 101;

/// Extrapolation from which on it counts no further, so that a parameter that never varied stays finite (-).
const FARTHEST: f64 = 1e6;

/// The forcing term at one parameter and one time fraction.
#[derive(Debug, Clone, PartialEq)]
pub struct Predictive {
    /// What is expected (d; unit of the columns), before the gate.
    pub mean: DVector<f64>,
    /// Scatter that demonstrations show (d x d; squared unit of the columns).
    pub aleatoric: DMatrix<f64>,
    /// Uncertainty of the mean for want of demonstrations (d x d); grows outside the demonstrated parameters.
    pub epistemic: DMatrix<f64>,
}

impl Predictive {
    /// Covariance of a demonstration that was not seen: both parts (d x d).
    #[must_use]
    pub fn covariance(&self) -> DMatrix<f64> {
        &self.aleatoric + &self.epistemic
    }
}

impl MotionModel {
    /// What is expected of the forcing term at `theta` (p) and a time fraction (clamped to [0, 1]). `None` for the baseline, and when
    /// the skill does not hold the evidence.
    ///
    /// # Errors
    /// When the model's covariances are not positive definite.
    pub fn predictive(&self, theta: &DVector<f64>, fraction: f64) -> Result<Option<Predictive>, LearningError> {
        Ok(self.predictives(theta, &[fraction])?.and_then(|mut all| all.pop()))
    }

    /// The same at several time fractions (T), in their order.
    ///
    /// # Errors
    /// As [`Self::predictive`].
    pub fn predictives(&self, theta: &DVector<f64>, fractions: &[f64]) -> Result<Option<Vec<Predictive>>, LearningError> {
        let Some((gmr, ratios)) = self.regression_and_ratios(theta)? else { return Ok(None) };
        let at = |fraction: &f64| predictive(&gmr, &ratios, self.phase_input.at(fraction.clamp(0.0, 1.0), self.alpha));
        Ok(Some(fractions.iter().map(at).collect()))
    }

    /// The extrapolation ratio at `theta` (p): variance of the mean for want of demonstrations over the variance demonstrations show,
    /// averaged over the movement (-). About `(1 + q) / K` inside `K` demonstrations with `q` features; it grows with the square of the
    /// distance outside for linear features and bumps, and does not depend on the unit of any parameter. Above 1 the movement is more
    /// guessed than learned. `None` as for [`Self::predictive`].
    ///
    /// # Errors
    /// When the model's covariances are not positive definite.
    pub fn extrapolation_ratio(&self, theta: &DVector<f64>) -> Result<Option<f64>, LearningError> {
        let Some((gmr, ratios)) = self.regression_and_ratios(theta)? else { return Ok(None) };
        let mut weights = vec![0.0; gmr.components()];
        let mut sum = 0.0;
        for k in 0..POINTS {
            gmr.weights(&[self.phase_input.at(k as f64 / (POINTS - 1) as f64, self.alpha)], &mut weights);
            sum += weights.iter().zip(&ratios).map(|(h, r)| h * r).sum::<f64>();
        }
        Ok(Some(sum / POINTS as f64))
    }

    fn regression_and_ratios(&self, theta: &DVector<f64>) -> Result<Option<(Gmr, Vec<f64>)>, LearningError> {
        let Shaping::Phmm(phmm) = &self.shaping else { return Ok(None) };
        if self.evidence.is_empty() {
            return Ok(None);
        }
        let phi = self.parameters.features.at(theta);
        let means: Vec<DVector<f64>> = (0..phmm.states()).map(|i| phmm.mean_at(i, &phi)).collect();
        let beyond = self.beyond_the_bumps(theta);
        let ratios = self.evidence.iter().map(|e| e.ratio(&phi) + beyond / e.demonstrations).collect();
        Ok(Some((Gmr::new(&means, &phmm.covariances, 1)?, ratios)))
    }

    /// `12 e^2` where the features are bumps (-): 12 is the square of a range over the variance of values spread evenly over it.
    fn beyond_the_bumps(&self, theta: &DVector<f64>) -> f64 {
        match self.parameters.features {
            FeatureMap::Rbf { .. } => 12.0 * self.parameters.extrapolation(theta).min(FARTHEST).powi(2),
            FeatureMap::Linear | FeatureMap::Quadratic(_) => 0.0,
        }
    }
}

/// What is expected at a phase input, from the regression and every state's `r_i`.
fn predictive(gmr: &Gmr, ratios: &[f64], input: f64) -> Predictive {
    let x = [input];
    let mut weights = vec![0.0; gmr.components()];
    gmr.weights(&x, &mut weights);
    let mut epistemic = DMatrix::zeros(gmr.outputs(), gmr.outputs());
    for (i, (h, r)) in weights.iter().zip(ratios).enumerate() {
        epistemic += gmr.conditional_covariance(i) * (h * r);
    }
    Predictive { mean: gmr.mean(&x), aleatoric: gmr.covariance(&x), epistemic }
}
