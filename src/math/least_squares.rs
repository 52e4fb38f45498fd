//! Linear least squares that says how many of its unknowns the data determine.

use nalgebra::{DMatrix, DVector};

use super::{MathError, eigenvalue_range, symmetric_pseudo_inverse};

/// The solution of a least-squares problem.
#[derive(Debug, Clone)]
pub struct LeastSquares {
    /// Unknowns (columns of the regressors x columns of the targets); the one of smallest norm where the data leave a choice.
    pub solution: DMatrix<f64>,
    /// How many directions of the unknowns the data determine.
    pub rank: usize,
    /// Largest over smallest kept singular value of the scaled regressors (-), squared; 1 when nothing is determined.
    pub condition: f64,
}

/// Relative eigenvalue of the scaled normal matrix below which a direction counts as not determined (-).
///
/// The normal matrix squares the condition number, so its eigenvalues carry a rounding error of about 1e-16 x its size.
const RANK_TOLERANCE: f64 = 1e-12;

/// Minimises `sum_t w_t |y_t - B^T a_t|^2` over `B`, for regressors `A` (samples x m), targets `Y` (samples x d), weights `w >= 0`.
///
/// # Errors
/// When the numbers of rows disagree.
pub fn solve_weighted(regressors: &DMatrix<f64>, targets: &DMatrix<f64>, weights: &DVector<f64>) -> Result<LeastSquares, MathError> {
    let samples = regressors.nrows();
    for (what, found) in [("rows of the targets", targets.nrows()), ("weights", weights.len())] {
        if found != samples {
            return Err(MathError::Shape { what, expected: samples, found });
        }
    }
    let mut weighted = regressors.clone();
    for (mut row, w) in weighted.row_iter_mut().zip(weights.iter()) {
        row *= *w;
    }
    let weighted_transpose = weighted.transpose();
    Ok(solve_normal_equations(&(&weighted_transpose * regressors), &(&weighted_transpose * targets)))
}

/// Solves `N B = M` for a symmetric positive semi-definite `N` (m x m) and `M` (m x d) by the pseudo-inverse, after scaling the
/// unknowns so that `N` has a unit diagonal: the answer does not depend on the unit of any regressor.
#[must_use]
pub fn solve_normal_equations(normal: &DMatrix<f64>, moments: &DMatrix<f64>) -> LeastSquares {
    let m = normal.nrows();
    let scale = DVector::from_fn(m, |i, _| if normal[(i, i)] > 0.0 { 1.0 / normal[(i, i)].sqrt() } else { 0.0 });
    let scaled = DMatrix::from_fn(m, m, |i, j| normal[(i, j)] * scale[i] * scale[j]);
    let [_, largest] = eigenvalue_range(&scaled);
    let (inverse, _, rank) = symmetric_pseudo_inverse(&scaled, RANK_TOLERANCE * largest);
    let scaling = DMatrix::from_diagonal(&scale);
    let solution = &scaling * (&inverse * (&scaling * moments));
    // The largest eigenvalue of the pseudo-inverse is one over the smallest that was kept.
    let condition = if rank == 0 { 1.0 } else { largest * eigenvalue_range(&inverse)[1] };
    LeastSquares { solution, rank, condition }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_found_with_weights_and_in_any_unit() {
        for unit in [1e-3, 1.0, 1e3] {
            let a = DMatrix::from_fn(5, 2, |t, j| if j == 0 { 1.0 } else { t as f64 * unit });
            let y = DMatrix::from_fn(5, 1, |t, _| 2.0 - 3.0 * t as f64 + if t == 4 { 100.0 } else { 0.0 });
            let w = DVector::from_vec(vec![1.0, 2.0, 1.0, 0.5, 0.0]);
            let fit = solve_weighted(&a, &y, &w).unwrap();
            assert_eq!(fit.rank, 2);
            assert!((fit.solution[0] - 2.0).abs() < 1e-11 && (fit.solution[1] * unit + 3.0).abs() < 1e-11);
        }
    }

    #[test]
    fn a_constant_regressor_beside_the_intercept_lowers_the_rank_and_nothing_else() {
        let a = DMatrix::from_fn(4, 2, |_, j| if j == 0 { 1.0 } else { 0.2 });
        let fit = solve_weighted(&a, &DMatrix::from_element(4, 1, 7.0), &DVector::from_element(4, 1.0)).unwrap();
        assert_eq!(fit.rank, 1);
        assert!((fit.solution[0] + 0.2 * fit.solution[1] - 7.0).abs() < 1e-12);
    }
}
