//! The maximisation step of one state: its weights, mean and covariance from the groups of samples it is responsible for.
//!
//! The objective of state `i` with `n = sum_k n_ki` samples is, with the prior `W = 0` of strength `kappa`,
//!
//! ```text
//! Q_i = -n/2 ln |2 pi Sigma| - 1/2 sum_kt gamma e^T Sigma^-1 e - kappa/2 tr(Sigma^-1 W W^T),      e = x_kt - W theta_k - mean
//! ```
//!
//! With `C` the centred moments per sample, `W = C_x,theta (C_theta,theta + kappa/n I)^-1` maximises it for **every** `Sigma` when all
//! rows of `W` are free. When the phase row is held at zero, the other rows depend on how columns vary with the phase: regressing them
//! on `[theta, 1, s - mu_s]` maximises over `W` and `Sigma` together. `Sigma` is then the scatter `S + kappa/n W W^T`, its eigenvalues
//! raised to the floor: the exact maximum under that constraint. When the floor acts, `W` is taken for the present `Sigma` instead, so
//! that `Q_i` rises in either case (a conditional maximisation step).

use nalgebra::{Cholesky, DMatrix, DVector};

use super::statistics::Group;
use crate::math::{clamp_eigenvalues, symmetric_pseudo_inverse};

/// Standardised variance of a parameter direction inside a state below which its weights stay as they were (-).
const UNDETERMINED: f64 = 1e-10;

/// What holds weights and covariances back; all in standardised units.
#[derive(Debug, Clone, Copy)]
pub struct Penalty {
    /// `kappa`: strength of the prior `W = 0` (samples).
    pub ridge: f64,
    /// Smallest eigenvalue of a covariance (-).
    pub floor: f64,
    /// Whether weights may act on the phase row, row 0.
    pub weights_on_phase: bool,
    /// Whether weights are learned at all; otherwise they stay as they are.
    pub parametric: bool,
    /// Whether covariances stay as they are: weights and means then maximise `Q_i` for them.
    pub fixed_covariance: bool,
}

impl Penalty {
    /// `-kappa/2 tr(Sigma^-1 W W^T)`: what the prior adds to the log-likelihood for one state. `None` when `Sigma` is not SPD.
    #[must_use]
    pub fn log_prior(&self, weights: &DMatrix<f64>, covariance: &DMatrix<f64>) -> Option<f64> {
        if self.ridge == 0.0 || weights.ncols() == 0 {
            return Some(0.0);
        }
        let whitened = Cholesky::new(covariance.clone())?.l().solve_lower_triangular(weights)?;
        Some(-0.5 * self.ridge * whitened.norm_squared())
    }
}

/// Weights (d x p), mean (d) and covariance (d x d) that raise `Q_i`, from the present weights and covariance.
///
/// `groups[k]` belongs to `thetas[k]`. `None` when the state has no samples to speak of: then it stays as it is.
#[must_use]
pub fn maximise_state(
    groups: &[&Group],
    thetas: &[&DVector<f64>],
    present: (&DMatrix<f64>, &DMatrix<f64>),
    penalty: &Penalty,
) -> Option<(DMatrix<f64>, DVector<f64>, DMatrix<f64>)> {
    let moments = Moments::of(groups, thetas)?;
    let ridge = penalty.ridge / moments.count;
    if penalty.fixed_covariance {
        let weights = if penalty.parametric { moments.weights(present.0, Some(present.1), ridge, penalty) } else { present.0.clone() };
        let mean = &moments.mean - &weights * &moments.theta_mean;
        return Some((weights, mean, present.1.clone()));
    }
    let covariance_for = |w: &DMatrix<f64>| clamp_eigenvalues(&(moments.residual_covariance(w) + ridge * w * w.transpose()), penalty.floor);
    let mut weights = if penalty.parametric { moments.weights(present.0, None, ridge, penalty) } else { present.0.clone() };
    let (mut covariance, floored) = covariance_for(&weights);
    if floored && penalty.parametric && !penalty.weights_on_phase {
        weights = moments.weights(present.0, Some(present.1), ridge, penalty);
        covariance = covariance_for(&weights).0;
    }
    let mean = &moments.mean - &weights * &moments.theta_mean;
    Some((weights, mean, covariance))
}

/// First and second moments per sample of one state's data and parameters.
struct Moments {
    count: f64,
    mean: DVector<f64>,
    theta_mean: DVector<f64>,
    xx: DMatrix<f64>,
    x_theta: DMatrix<f64>,
    theta_theta: DMatrix<f64>,
}

impl Moments {
    /// Fewer expected samples than this are no evidence.
    const LEAST_COUNT: f64 = 1e-6;

    fn of(groups: &[&Group], thetas: &[&DVector<f64>]) -> Option<Self> {
        let count: f64 = groups.iter().map(|g| g.count).sum();
        if count < Self::LEAST_COUNT {
            return None;
        }
        let (d, p) = (groups[0].mean.len(), thetas[0].len());
        let (mut mean, mut theta_mean) = (DVector::zeros(d), DVector::zeros(p));
        for (group, theta) in groups.iter().zip(thetas) {
            mean += &group.mean * (group.count / count);
            theta_mean += *theta * (group.count / count);
        }
        let mut moments =
            Self { count, xx: DMatrix::zeros(d, d), x_theta: DMatrix::zeros(d, p), theta_theta: DMatrix::zeros(p, p), mean, theta_mean };
        for (group, theta) in groups.iter().zip(thetas) {
            let share = group.count / count;
            let (x, theta) = (&group.mean - &moments.mean, *theta - &moments.theta_mean);
            moments.xx += &group.scatter / count + share * &x * x.transpose();
            moments.x_theta += share * &x * theta.transpose();
            moments.theta_theta += share * &theta * theta.transpose();
        }
        Some(moments)
    }

    /// The weights for the ridge (per sample). With the phase row held at zero, its coupling to the other rows is regressed along, or
    /// read from a given covariance. In directions of `theta` that the data do not determine, the present weights stay.
    fn weights(&self, present: &DMatrix<f64>, covariance: Option<&DMatrix<f64>>, ridge: f64, penalty: &Penalty) -> DMatrix<f64> {
        let (mut x_theta, mut theta_theta) = (self.x_theta.clone(), self.theta_theta.clone());
        if !penalty.weights_on_phase {
            let phase_theta = self.x_theta.row(0).into_owned();
            let slope = match covariance {
                Some(c) => c.column(0) / c[(0, 0)],
                None => {
                    let variance = self.xx[(0, 0)];
                    let inverse = if variance > f64::MIN_POSITIVE { 1.0 / variance } else { 0.0 };
                    theta_theta -= phase_theta.transpose() * &phase_theta * inverse;
                    self.xx.column(0) * inverse
                }
            };
            x_theta -= slope * phase_theta;
            x_theta.row_mut(0).fill(0.0);
        }
        for j in 0..theta_theta.nrows() {
            theta_theta[(j, j)] += ridge;
        }
        let (inverse, kept, rank) = symmetric_pseudo_inverse(&theta_theta, UNDETERMINED);
        let determined = x_theta * inverse;
        if rank == kept.nrows() { determined } else { determined + present - present * kept }
    }

    /// Covariance of `x - W theta` (d x d), per sample.
    fn residual_covariance(&self, weights: &DMatrix<f64>) -> DMatrix<f64> {
        let cross = weights * self.x_theta.transpose();
        &self.xx - &cross - cross.transpose() + weights * &self.theta_theta * weights.transpose()
    }
}
