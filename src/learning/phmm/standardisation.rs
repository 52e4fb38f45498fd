//! Unit-free coordinates for learning: every column and every parameter with mean 0 and standard deviation 1.
//!
//! Learning in millimetres or in metres then gives the same model, floors and priors mean the same everywhere, and normal matrices
//! are well conditioned. Models are handed out in the user's units again.

use nalgebra::{DMatrix, DVector};

use super::{Phmm, Sequence};

/// Spread of a column or parameter relative to its largest magnitude below which it counts as constant (-).
const CONSTANT: f64 = 1e-9;

/// The affine map from user units to standardised ones.
#[derive(Debug, Clone)]
pub(super) struct Standardisation {
    mean: DVector<f64>,
    scale: DVector<f64>,
    theta_mean: DVector<f64>,
    theta_scale: DVector<f64>,
}

impl Standardisation {
    /// From sequences of one dimension and one number of parameters, each of which counts by its standard deviation times its factor (none:
    /// 1).
    pub(super) fn of(sequences: &[Sequence], factors: &[f64]) -> Self {
        let (d, p) = (sequences[0].dimension, sequences[0].theta.len());
        let samples = |i: usize| sequences.iter().flat_map(move |s| s.values.iter().skip(i).step_by(d).copied());
        let thetas = |j: usize| sequences.iter().map(move |s| s.theta[j]);
        let columns: Vec<(f64, f64)> = (0..d).map(|i| mean_and_spread(samples(i))).collect();
        let parameters: Vec<(f64, f64)> = (0..p).map(|j| mean_and_spread(thetas(j))).collect();
        Self {
            mean: DVector::from_iterator(d, columns.iter().map(|c| c.0)),
            scale: DVector::from_iterator(d, columns.iter().map(|c| c.1)),
            theta_mean: DVector::from_iterator(p, parameters.iter().map(|c| c.0)),
            theta_scale: DVector::from_fn(p, |j, _| parameters[j].1 * factors.get(j).unwrap_or(&1.0)),
        }
    }

    pub(super) fn sequence(&self, sequence: &Sequence) -> Sequence {
        let d = sequence.dimension;
        let values = sequence.values.iter().enumerate().map(|(k, x)| (x - self.mean[k % d]) / self.scale[k % d]).collect();
        Sequence { values, dimension: d, theta: (&sequence.theta - &self.theta_mean).component_div(&self.theta_scale) }
    }

    /// A standardised model in user units: `x = m + S x'`, `theta' = (theta - n) / R`.
    pub(super) fn to_user(&self, model: &Phmm) -> Phmm {
        let mut user = model.clone();
        let scale = DMatrix::from_diagonal(&self.scale);
        for i in 0..model.states() {
            let mut weights = &scale * &model.weights[i];
            for (mut column, r) in weights.column_iter_mut().zip(self.theta_scale.iter()) {
                column /= *r;
            }
            user.means[i] = &self.mean + &scale * &model.means[i] - &weights * &self.theta_mean;
            user.weights[i] = weights;
            let covariance = &scale * &model.covariances[i] * &scale;
            user.covariances[i] = (&covariance + covariance.transpose()) * 0.5;
        }
        user
    }

    /// The inverse of [`Self::to_user`].
    pub(super) fn standardised(&self, model: &Phmm) -> Phmm {
        let mut standard = model.clone();
        let inverse = DMatrix::from_diagonal(&self.scale.map(|s| 1.0 / s));
        for i in 0..model.states() {
            standard.means[i] = &inverse * (model.mean_at(i, &self.theta_mean) - &self.mean);
            standard.weights[i] = &inverse * &model.weights[i] * DMatrix::from_diagonal(&self.theta_scale);
            standard.covariances[i] = &inverse * &model.covariances[i] * &inverse;
        }
        standard
    }

    /// What to add to a standardised log-likelihood of this many samples to get the one in user units.
    pub(super) fn log_likelihood_offset(&self, samples: usize) -> f64 {
        -(samples as f64) * self.scale.iter().map(|s| s.ln()).sum::<f64>()
    }
}

/// Mean and standard deviation; the first value and 1 when the values are constant, so that equal values become exactly zero.
pub(in crate::learning) fn mean_and_spread(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let n = values.clone().count().max(1) as f64;
    let mean = values.clone().sum::<f64>() / n;
    let spread = (values.clone().map(|x| (x - mean).powi(2)).sum::<f64>() / n).sqrt();
    let largest = values.clone().fold(0.0, |m: f64, x| m.max(x.abs()));
    if spread > CONSTANT * largest { (mean, spread) } else { (values.into_iter().next().unwrap_or(mean), 1.0) }
}
