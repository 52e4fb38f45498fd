//! Quantities that depend linearly on the parameters, such as the start and the goal of a movement.

use nalgebra::{DMatrix, DVector};

use super::LearningError;
use super::parameters::mean_and_deviations;
use crate::math::solve_weighted;

/// `y(theta) = weights theta + mean`.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearMap {
    /// (d x p).
    pub weights: DMatrix<f64>,
    /// The value at `theta = 0` (d).
    pub mean: DVector<f64>,
}

impl LinearMap {
    /// The least-squares map through one value (d) per parameter vector (p); parameters without effect or spread get no weight.
    ///
    /// # Errors
    /// When the numbers of values and parameter vectors disagree or there are none.
    pub fn fit(thetas: &[DVector<f64>], values: &[DVector<f64>]) -> Result<Self, LearningError> {
        if thetas.is_empty() {
            return Err(LearningError::Data("no demonstration".to_owned()));
        }
        let (mean_theta, regressors) = mean_and_deviations(&thetas.iter().collect::<Vec<_>>());
        let mean_value = values.iter().sum::<DVector<f64>>() / values.len() as f64;
        let targets = DMatrix::from_fn(values.len(), mean_value.len(), |i, j| values[i][j] - mean_value[j]);
        let weights = solve_weighted(&regressors, &targets, &DVector::from_element(thetas.len(), 1.0))?.solution.transpose();
        Ok(Self { mean: mean_value - &weights * mean_theta, weights })
    }

    /// The same value for all parameters (p of them).
    #[must_use]
    pub fn constant(value: DVector<f64>, parameters: usize) -> Self {
        Self { weights: DMatrix::zeros(value.len(), parameters), mean: value }
    }

    /// The value (d) at `theta` (p).
    #[must_use]
    pub fn at(&self, theta: &DVector<f64>) -> DVector<f64> {
        &self.mean + &self.weights * theta
    }
}
