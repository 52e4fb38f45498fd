//! Locally weighted regression of the forcing term (5)-(10): the paper's baseline, blind to parameters.
//!
//! ```text
//! f(s) = s sum_i w_i psi_i(s) / sum_i psi_i(s)        psi_i(s) = exp(-h_i (s - c_i)^2)
//! c_i logarithmic in (0, 1],  h_i = m / c_i^2,  w by least squares over all samples of all demonstrations
//! ```

use nalgebra::{DMatrix, DVector};

use crate::math::MathError;
use crate::math::solve_weighted;

/// A forcing term of one or more degrees of freedom over the phase.
#[derive(Debug, Clone, PartialEq)]
pub struct Lwr {
    /// `c_i` (m), falling from 1.
    pub centres: DVector<f64>,
    /// `h_i` (m).
    pub widths: DVector<f64>,
    /// `w_i` of every degree of freedom (m x d; unit of the column).
    pub weights: DMatrix<f64>,
}

impl Lwr {
    /// Fits `basis` functions (> 0) to forcing targets (T x d) at phases `s` (T), with centres from 1 down to `exp(-alpha)`.
    ///
    /// # Errors
    /// When the numbers of rows disagree.
    pub fn fit(phases: &[f64], targets: &DMatrix<f64>, basis: usize, alpha: f64) -> Result<Self, MathError> {
        let last = basis.saturating_sub(1).max(1) as f64;
        let centres = DVector::from_fn(basis, |i, _| (-alpha * i as f64 / last).exp());
        let widths = centres.map(|c| basis as f64 / (c * c));
        let mut lwr = Self { weights: DMatrix::zeros(basis, targets.ncols()), centres, widths };
        let mut regressors = DMatrix::zeros(phases.len(), basis);
        for (t, s) in phases.iter().enumerate() {
            let row = lwr.activations(*s);
            regressors.row_mut(t).copy_from(&row.transpose());
        }
        lwr.weights = solve_weighted(&regressors, targets, &DVector::from_element(phases.len(), 1.0))?.solution;
        Ok(lwr)
    }

    /// `f(s)` of every degree of freedom, added into `forcing` (d) after it is set to zero. No allocation.
    pub fn forcing(&self, s: f64, forcing: &mut [f64]) {
        forcing.fill(0.0);
        let (mut total, largest) = (0.0, self.largest_exponent(s));
        for i in 0..self.centres.len() {
            let psi = (self.exponent(i, s) - largest).exp();
            total += psi;
            for (f, w) in forcing.iter_mut().zip(self.weights.row(i).iter()) {
                *f += psi * w;
            }
        }
        forcing.iter_mut().for_each(|f| *f *= s / total);
    }

    /// `s psi_i / sum_j psi_j` (m).
    fn activations(&self, s: f64) -> DVector<f64> {
        let largest = self.largest_exponent(s);
        let psi = DVector::from_fn(self.centres.len(), |i, _| (self.exponent(i, s) - largest).exp());
        let total = psi.sum();
        psi * (s / total)
    }

    /// `ln psi_i(s)`.
    fn exponent(&self, i: usize, s: f64) -> f64 {
        -self.widths[i] * (s - self.centres[i]).powi(2)
    }

    /// The largest `ln psi_i(s)`: taken out of the ratio, it keeps many narrow functions from vanishing all at once (their `h_i` reach
    /// 1e7), which would be 0/0 between and beyond the centres.
    fn largest_exponent(&self, s: f64) -> f64 {
        (0..self.centres.len()).map(|i| self.exponent(i, s)).fold(f64::NEG_INFINITY, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smooth_forcing_is_reproduced_and_fades_with_the_phase() {
        let alpha = 100f64.ln();
        let phases: Vec<f64> = (0..400).map(|t| (-alpha * f64::from(t) / 399.0).exp()).collect();
        let truth = |s: f64| s * (6.0 * s.ln()).sin();
        let targets = DMatrix::from_iterator(400, 1, phases.iter().map(|s| truth(*s)));
        let lwr = Lwr::fit(&phases, &targets, 100, alpha).unwrap();
        let mut f = [0.0];
        for s in &phases {
            lwr.forcing(*s, &mut f);
            assert!((f[0] - truth(*s)).abs() < 5e-3, "{} at {s}", f[0]);
        }
        lwr.forcing(1e-9, &mut f);
        assert!(f[0].abs() < 1e-6);
    }

    /// The regression (5)-(10) written down once more, solved by the singular values of nalgebra: at (9), `w` minimises the squared error
    /// over all samples of all demonstrations; with fewer samples than functions the smallest such `w`.
    #[test]
    fn weights_are_those_of_an_independent_dense_solution() {
        let alpha = 100f64.ln();
        for (samples, basis) in [(300, 10), (300, 100), (60, 250), (40, 100), (1, 3), (5, 1)] {
            let s = |t: usize| (-alpha * t as f64 / (samples.max(2) - 1) as f64).exp();
            let targets = DMatrix::from_fn(samples, 2, |t, j| s(t) * ((3.0 + j as f64) * s(t).ln()).sin() + 0.1);
            let phases: Vec<f64> = (0..samples).map(s).collect();
            let lwr = Lwr::fit(&phases, &targets, basis, alpha).unwrap();
            let (c, m) = (|i: usize| 10f64.powf(-2.0 * i as f64 / (basis.max(2) - 1) as f64), basis as f64);
            let exponent = |s: f64, i: usize| -(m / c(i).powi(2)) * (s - c(i)).powi(2);
            let row = |s: f64| {
                let top = (0..basis).map(|i| exponent(s, i)).fold(f64::MIN, f64::max);
                let psi = DVector::from_fn(basis, |i, _| (exponent(s, i) - top).exp());
                &psi * (s / psi.sum())
            };
            let design = DMatrix::from_fn(samples, basis, |t, i| row(s(t))[i]);
            let dense = design.clone().svd(true, true).solve(&targets, 1e-12).unwrap();
            let (own, other) = ((&design * &lwr.weights - &targets).norm(), (&design * dense - &targets).norm());
            assert!(own <= other + 1e-7, "{samples} samples, {basis} functions: residual {own}, dense {other}");
            let mut f = [0.0; 2];
            for u in [0.0, 0.31, 0.77, 1.0, 1.4, 100.0] {
                lwr.forcing((-alpha * u).exp(), &mut f);
                let direct = row((-alpha * u).exp()).transpose() * &lwr.weights;
                assert!(f.iter().all(|f| f.is_finite()));
                assert!((f[0] - direct[0]).abs() < 1e-9 * (1.0 + lwr.weights.amax()), "u = {u}");
            }
        }
    }
}
