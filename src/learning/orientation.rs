//! The orientation of the hand over the phase, averaged over all demonstrations.

use nalgebra::{DMatrix, DVector, UnitQuaternion, Vector3};

use super::parameters::mean_and_deviations;
use crate::math::{exp_map, log_map, mean_quaternion, same_hemisphere, solve_normal_equations};

/// Rotation vectors about a mean orientation, smooth in the time fraction `u` and linear in the parameters:
/// `q(u, theta) = reference * exp(sum_i psi_i(u) (mean_i + W_i theta) / sum_i psi_i(u))`.
#[derive(Debug, Clone, PartialEq)]
pub struct OrientationProfile {
    /// The mean orientation of all demonstrations.
    pub reference: UnitQuaternion<f64>,
    /// Rotation vectors (rad) at the `m` basis centres `i / (m - 1)`, at `theta = 0` (m x 3).
    pub mean: DMatrix<f64>,
    /// Their change with each parameter (p of m x 3).
    pub weights: Vec<DMatrix<f64>>,
}

/// One demonstration's orientations: time fractions (T), quaternions (T), parameters (p).
pub(super) struct OrientationSample<'a> {
    pub(super) fractions: &'a [f64],
    pub(super) orientations: Vec<UnitQuaternion<f64>>,
    pub(super) theta: &'a DVector<f64>,
}

impl OrientationProfile {
    /// Least squares over all samples with `basis` functions; `ridge` (demonstrations) holds the parameters' effect back.
    pub(super) fn fit(demonstrations: &[OrientationSample], basis: usize, ridge: f64) -> Self {
        let reference = mean_quaternion(demonstrations.iter().flat_map(|d| &d.orientations));
        let k = demonstrations.len() as f64;
        let (mean_theta, deviations) = mean_and_deviations(&demonstrations.iter().map(|d| d.theta).collect::<Vec<_>>());
        let p = mean_theta.len();
        let spread = DVector::from_fn(p, |j, _| match deviations.column(j).norm() / k.sqrt() {
            0.0 => 1.0,
            spread => spread,
        });
        let unknowns = basis * (1 + p);
        let (mut normal, mut moments) = (DMatrix::zeros(unknowns, unknowns), DMatrix::zeros(unknowns, 3));
        let mut psi = vec![0.0; basis];
        for (d, deviation) in demonstrations.iter().zip(deviations.row_iter()) {
            let factors: Vec<f64> = std::iter::once(1.0).chain((0..p).map(|j| deviation[j] / spread[j])).collect();
            for (u, r) in d.fractions.iter().zip(rotation_vectors(&reference, &d.orientations)) {
                activations(*u, &mut psi);
                let row = DVector::from_fn(unknowns, |i, _| factors[i / basis] * psi[i % basis]);
                normal.ger(1.0, &row, &row, 1.0);
                moments += row * r.transpose();
            }
        }
        for i in basis..unknowns {
            normal[(i, i)] += ridge * normal[(i % basis, i % basis)] / k;
        }
        let solution = solve_normal_equations(&normal, &moments).solution;
        let mut mean = solution.rows(0, basis).into_owned();
        let mut weights = Vec::new();
        for j in 0..p {
            let w = solution.rows(basis * (j + 1), basis) / spread[j];
            mean -= &w * mean_theta[j];
            weights.push(w);
        }
        Self { reference, mean, weights }
    }

    /// The same profile for all values of so many parameters; this one has none.
    pub(super) fn blind_to(self, parameters: usize) -> Self {
        Self { weights: vec![DMatrix::zeros(self.mean.nrows(), 3); parameters], ..self }
    }

    /// The profile at `theta` (p), as one with no parameters left.
    #[must_use]
    pub fn at(&self, theta: &DVector<f64>) -> Self {
        let mut mean = self.mean.clone();
        for (w, value) in self.weights.iter().zip(theta.iter()) {
            mean += w * *value;
        }
        Self { reference: self.reference, mean, weights: Vec::new() }
    }

    /// The orientation at time fraction `u` (-; clamped to [0, 1]) with the parameters at zero. No allocation.
    #[must_use]
    pub fn orientation(&self, u: f64) -> UnitQuaternion<f64> {
        let basis = self.mean.nrows();
        let (mut sum, mut turn) = (0.0, Vector3::zeros());
        for i in 0..basis {
            let psi = activation(u.clamp(0.0, 1.0), i, basis);
            sum += psi;
            turn += Vector3::new(self.mean[(i, 0)], self.mean[(i, 1)], self.mean[(i, 2)]) * psi;
        }
        self.reference * exp_map(&(turn / sum))
    }
}

/// Rotation vectors (rad) from the reference, continuous along the movement.
fn rotation_vectors(reference: &UnitQuaternion<f64>, orientations: &[UnitQuaternion<f64>]) -> Vec<Vector3<f64>> {
    let mut previous = UnitQuaternion::identity();
    let mut vectors = Vec::with_capacity(orientations.len());
    for q in orientations {
        let turn = same_hemisphere(&(reference.inverse() * q), &previous);
        vectors.push(log_map(&turn));
        previous = turn;
    }
    vectors
}

/// A Gaussian as wide as the distance between centres.
fn activation(u: f64, i: usize, basis: usize) -> f64 {
    let z = u * (basis - 1) as f64 - i as f64;
    (-0.5 * z * z).exp()
}

fn activations(u: f64, psi: &mut [f64]) {
    let basis = psi.len();
    let mut sum = 0.0;
    for (i, p) in psi.iter_mut().enumerate() {
        *p = activation(u, i, basis);
        sum += *p;
    }
    psi.iter_mut().for_each(|p| *p /= sum);
}
