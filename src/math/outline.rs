//! Outlines of ellipses.

use nalgebra::{Matrix2, SymmetricEigen, Vector2};

/// Points of an outline.
const POINTS: usize = 72;

/// The outline of an ellipse with half axes `half` along x and y.
#[must_use]
pub fn ellipse_outline(center: [f64; 2], half: [f64; 2]) -> Vec<[f64; 2]> {
    outline(center, Matrix2::from_diagonal(&Vector2::from(half)))
}

/// The outline on which a Gaussian of this covariance is `deviations` standard deviations away from its centre.
#[must_use]
pub fn covariance_outline(center: [f64; 2], covariance: &Matrix2<f64>, deviations: f64) -> Vec<[f64; 2]> {
    let eigen = SymmetricEigen::new(*covariance);
    let half = eigen.eigenvalues.map(|lambda| deviations * lambda.max(0.0).sqrt());
    outline(center, eigen.eigenvectors * Matrix2::from_diagonal(&half))
}

/// The image of the unit circle under `map`.
fn outline(center: [f64; 2], map: Matrix2<f64>) -> Vec<[f64; 2]> {
    let angle = |i: usize| std::f64::consts::TAU * i as f64 / POINTS as f64;
    let point = |angle: f64| (Vector2::from(center) + map * Vector2::new(angle.cos(), angle.sin())).into();
    (0..POINTS).map(|i| point(angle(i))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every point of the outline has the Mahalanobis distance asked for: the definition, not the construction.
    #[test]
    fn an_outline_lies_at_its_distance() {
        let covariance = Matrix2::new(2.0, 0.7, 0.7, 0.5);
        let inverse = covariance.try_inverse().expect("regular");
        for point in covariance_outline([1.0, -2.0], &covariance, 2.0) {
            let away = Vector2::from(point) - Vector2::new(1.0, -2.0);
            assert!(((away.transpose() * inverse * away)[0].sqrt() - 2.0).abs() < 1e-12);
        }
        for [x, y] in ellipse_outline([0.0, 0.0], [1.0, 3.0]) {
            assert!((x * x + y * y / 9.0 - 1.0).abs() < 1e-12);
        }
    }
}
