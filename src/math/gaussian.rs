//! The multivariate normal distribution, through the Cholesky factor of its covariance.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::{MathError, eigenvalue_range};

/// A normal distribution `N(mean, covariance)` over `d` variables.
#[derive(Debug, Clone)]
pub struct Gaussian {
    mean: DVector<f64>,
    covariance: DMatrix<f64>,
    factor: Cholesky<f64, Dyn>,
    log_normaliser: f64,
}

impl Gaussian {
    /// From a mean (d) and a covariance (d x d, SPD).
    ///
    /// # Errors
    /// When the shapes disagree or the covariance is not positive definite.
    pub fn new(mean: DVector<f64>, covariance: DMatrix<f64>) -> Result<Self, MathError> {
        let d = mean.len();
        for found in [covariance.nrows(), covariance.ncols()] {
            if found != d {
                return Err(MathError::Shape { what: "rows and columns of the covariance", expected: d, found });
            }
        }
        let symmetric = (&covariance + covariance.transpose()) * 0.5;
        let Some(factor) = Cholesky::new(symmetric.clone()) else {
            return Err(MathError::NotPositiveDefinite { size: d, smallest: eigenvalue_range(&symmetric)[0] });
        };
        let half_log_determinant: f64 = (0..d).map(|i| factor.l_dirty()[(i, i)].ln()).sum();
        let log_normaliser = -0.5 * d as f64 * std::f64::consts::TAU.ln() - half_log_determinant;
        Ok(Self { mean, covariance: symmetric, factor, log_normaliser })
    }

    /// The mean (d).
    #[must_use]
    pub fn mean(&self) -> &DVector<f64> {
        &self.mean
    }

    /// The covariance (d x d).
    #[must_use]
    pub fn covariance(&self) -> &DMatrix<f64> {
        &self.covariance
    }

    /// `ln N(x; mean, covariance)`: `-(d ln 2 pi + ln |C| + |L^-1 (x - mean)|^2) / 2`.
    #[must_use]
    pub fn log_density(&self, x: &DVector<f64>) -> f64 {
        let whitened = self.factor.l_dirty().solve_lower_triangular_unchecked(&(x - &self.mean));
        self.log_normaliser - 0.5 * whitened.norm_squared()
    }

    /// The distribution of the variables `kept` on their own, in that order.
    ///
    /// # Errors
    /// When `kept` names a variable that does not exist or names one twice.
    pub fn marginal(&self, kept: &[usize]) -> Result<Self, MathError> {
        self.check_indices(kept)?;
        Self::new(self.mean.select_rows(kept), self.block(kept, kept))
    }

    /// The distribution of all other variables (in their order) once the variables `given` have the values `x`:
    /// `mean_y + C_yx C_xx^-1 (x - mean_x)` and `C_yy - C_yx C_xx^-1 C_xy`.
    ///
    /// # Errors
    /// When `given` names a variable that does not exist or names one twice, or `x` has another length.
    pub fn conditional(&self, given: &[usize], x: &DVector<f64>) -> Result<Self, MathError> {
        self.check_indices(given)?;
        if x.len() != given.len() {
            return Err(MathError::Shape { what: "values of the given variables", expected: given.len(), found: x.len() });
        }
        let rest: Vec<usize> = (0..self.mean.len()).filter(|i| !given.contains(i)).collect();
        let input = self.marginal(given)?;
        let gain = input.factor.solve(&self.block(given, &rest)).transpose();
        let mean = self.mean.select_rows(&rest) + &gain * (x - &input.mean);
        Self::new(mean, self.block(&rest, &rest) - &gain * self.block(given, &rest))
    }

    fn block(&self, rows: &[usize], columns: &[usize]) -> DMatrix<f64> {
        self.covariance.select_rows(rows).select_columns(columns)
    }

    fn check_indices(&self, indices: &[usize]) -> Result<(), MathError> {
        let d = self.mean.len();
        let faulty = indices.iter().enumerate().find(|(i, v)| **v >= d || indices[..*i].contains(v));
        match faulty {
            Some((_, found)) => Err(MathError::Shape { what: "distinct variables below", expected: d, found: *found }),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example() -> Gaussian {
        let c = DMatrix::from_row_slice(3, 3, &[2.0, 0.4, -0.3, 0.4, 1.0, 0.2, -0.3, 0.2, 0.5]);
        Gaussian::new(DVector::from_vec(vec![1.0, -1.0, 0.5]), c).unwrap()
    }

    #[test]
    fn joint_density_is_marginal_times_conditional() {
        let g = example();
        let x = DVector::from_vec(vec![0.3, -0.2, 1.1]);
        let given = x.select_rows(&[2]);
        let product =
            g.marginal(&[2]).unwrap().log_density(&given) + g.conditional(&[2], &given).unwrap().log_density(&x.select_rows(&[0, 1]));
        assert!((g.log_density(&x) - product).abs() < 1e-13);
    }

    #[test]
    fn one_variable_is_the_textbook_formula() {
        let g = Gaussian::new(DVector::from_element(1, 2.0), DMatrix::from_element(1, 1, 9.0)).unwrap();
        let expected = -0.5 * (25.0 / 9.0 + (2.0 * std::f64::consts::PI * 9.0f64).ln());
        assert!((g.log_density(&DVector::from_element(1, 7.0)) - expected).abs() < 1e-14);
    }

    #[test]
    fn flat_and_misshapen_covariances_are_refused() {
        let flat = Gaussian::new(DVector::zeros(2), DMatrix::from_element(2, 2, 1.0));
        assert!(matches!(flat, Err(MathError::NotPositiveDefinite { size: 2, .. })));
        assert!(Gaussian::new(DVector::zeros(2), DMatrix::identity(3, 3)).is_err());
        assert!(example().marginal(&[0, 0]).is_err() && example().conditional(&[5], &DVector::zeros(1)).is_err());
    }
}
