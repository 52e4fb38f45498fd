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
        let mut total = 0.0;
        for i in 0..self.centres.len() {
            let psi = self.psi(i, s);
            total += psi;
            for (f, w) in forcing.iter_mut().zip(self.weights.row(i).iter()) {
                *f += psi * w;
            }
        }
        let scale = if total > 0.0 { s / total } else { 0.0 };
        forcing.iter_mut().for_each(|f| *f *= scale);
    }

    /// `s psi_i / sum_j psi_j` (m).
    fn activations(&self, s: f64) -> DVector<f64> {
        let psi = DVector::from_fn(self.centres.len(), |i, _| self.psi(i, s));
        let total = psi.sum();
        if total > 0.0 { psi * (s / total) } else { psi }
    }

    fn psi(&self, i: usize, s: f64) -> f64 {
        (-self.widths[i] * (s - self.centres[i]).powi(2)).exp()
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
}
