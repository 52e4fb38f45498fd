//! Symmetric matrices through their eigenvalues: the pseudo-inverse that reveals rank, and the floor that keeps covariances positive.

use nalgebra::{DMatrix, Dyn, SymmetricEigen};

/// The Moore-Penrose inverse of a symmetric positive semi-definite matrix, with the projector onto the directions that were kept.
///
/// A direction is kept when its eigenvalue exceeds `smallest`. Returns `(inverse, projector, rank)`; the inverse is zero in the
/// directions that were dropped, and in all when an entry is not finite.
#[must_use]
pub fn symmetric_pseudo_inverse(matrix: &DMatrix<f64>, smallest: f64) -> (DMatrix<f64>, DMatrix<f64>, usize) {
    let n = matrix.nrows();
    let Some(eigen) = decomposed(matrix) else { return (DMatrix::zeros(n, n), DMatrix::zeros(n, n), 0) };
    let (mut inverse, mut projector) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
    let mut rank = 0;
    for (lambda, v) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        if *lambda > smallest {
            rank += 1;
            inverse.ger(1.0 / lambda, &v, &v, 1.0);
            projector.ger(1.0, &v, &v, 1.0);
        }
    }
    (inverse, projector, rank)
}

/// Raises every eigenvalue of a symmetric matrix to at least `floor`. Returns the matrix and whether anything was raised.
///
/// For a Gaussian with scatter `S` this is the exact maximum of the likelihood over all covariances with eigenvalues of at least
/// `floor`, so a floor applied this way never makes the likelihood of expectation maximisation fall. A matrix that is not finite comes
/// back as it is.
#[must_use]
pub fn clamp_eigenvalues(matrix: &DMatrix<f64>, floor: f64) -> (DMatrix<f64>, bool) {
    let symmetric = symmetrised(matrix);
    let Some(eigen) = decomposed(matrix) else { return (symmetric, false) };
    if eigen.eigenvalues.iter().all(|lambda| *lambda >= floor) {
        return (symmetric, false);
    }
    let mut clamped = DMatrix::zeros(matrix.nrows(), matrix.ncols());
    for (lambda, v) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        clamped.ger(lambda.max(floor), &v, &v, 1.0);
    }
    (symmetrised(&clamped), true)
}

/// Smallest and largest eigenvalue of a symmetric matrix; zeros when it is empty, not-a-numbers when an entry is not finite.
#[must_use]
pub fn eigenvalue_range(matrix: &DMatrix<f64>) -> [f64; 2] {
    match decomposed(matrix) {
        Some(eigen) => [eigen.eigenvalues.min(), eigen.eigenvalues.max()],
        None if matrix.is_empty() => [0.0; 2],
        None => [f64::NAN; 2],
    }
}

/// `None` for what the decomposition would panic on or never finish: an empty matrix, an entry that is not finite.
fn decomposed(matrix: &DMatrix<f64>) -> Option<SymmetricEigen<f64, Dyn>> {
    let usable = !matrix.is_empty() && matrix.iter().all(|x| x.is_finite());
    usable.then(|| SymmetricEigen::new(symmetrised(matrix)))
}

fn symmetrised(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    (matrix + matrix.transpose()) * 0.5
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pseudo_inverse_of_a_rank_one_matrix() {
        let a = DMatrix::from_row_slice(2, 2, &[4.0, 2.0, 2.0, 1.0]);
        let (inverse, projector, rank) = symmetric_pseudo_inverse(&a, 1e-12);
        assert_eq!(rank, 1);
        assert!((&a * &inverse * &a - &a).norm() < 1e-14);
        assert!((&projector * &projector - &projector).norm() < 1e-14);
    }

    #[test]
    fn empty_and_unusable_matrices_neither_panic_nor_hang() {
        assert_eq!(symmetric_pseudo_inverse(&DMatrix::zeros(0, 0), 0.0).2, 0);
        let unusable = DMatrix::from_element(3, 3, f64::NAN);
        assert_eq!(symmetric_pseudo_inverse(&unusable, 0.0).2, 0);
        assert!(!clamp_eigenvalues(&unusable, 1.0).1 && eigenvalue_range(&unusable)[0].is_nan());
    }

    #[test]
    fn clamping_leaves_a_healthy_matrix_alone_and_mends_a_flat_one() {
        let healthy = DMatrix::from_row_slice(2, 2, &[2.0, 0.5, 0.5, 1.0]);
        assert_eq!(clamp_eigenvalues(&healthy, 0.1), (healthy.clone(), false));
        let flat = DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 1.0, 1.0]);
        let (mended, raised) = clamp_eigenvalues(&flat, 0.25);
        assert!(raised && (mended.symmetric_eigenvalues().min() - 0.25).abs() < 1e-14);
        assert!((mended.symmetric_eigenvalues().max() - 2.0).abs() < 1e-14);
    }
}
