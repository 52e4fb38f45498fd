//! The orientation of the hand over the phase: rotation vectors about a reference, regressed over all demonstrations.
//!
//! ```text
//! q(u, theta) = Q(u) exp(r(u, phi))        r(u, phi) = sum_i psi_i(u) (mean_i + W_i phi) / sum_i psi_i(u),   phi = phi(theta)
//! ```
//!
//! `Q` is the mean orientation of all demonstrations, the same for every `u`, unless a demonstration turns half a turn or more away from
//! it. Near a whole turn a rotation vector swings wildly while the hand hardly moves, so then `Q` moves too: along the mean path of the
//! demonstrations, coming to rest softly at its end, and `r` is only what they differ from it.
//!
//! In execution `r` is a primitive of its own (1) with the spring and phase of the position. Its forcing term (4) is that of `r(u, phi)`:
//! with `' = d/du` and `omega tau = sqrt(K)`, `f = r + 2 r' / sqrt(K) + r'' / K - g + (g - x0) s`, exact since `r` has closed derivatives.

use nalgebra::{DMatrix, DVector, Quaternion, UnitQuaternion, Vector3, Vector4};

use super::parameters::mean_and_deviations;
use crate::math::{continuous_log, exp_map, mean_quaternion, same_hemisphere, smooth_step, solve_normal_equations};

/// Rotation vectors about a reference, smooth in the time fraction `u` and linear in the features of the parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct OrientationProfile {
    /// The mean orientation of all demonstrations.
    pub reference: UnitQuaternion<f64>,
    /// The reference that moves, as quaternions x, y, z, w at the basis centres (m x 4; blended and normalised); `None` when it stands.
    pub path: Option<DMatrix<f64>>,
    /// Rotation vectors (rad) at the `m` basis centres `i / (m - 1)`, at `phi = 0` (m x 3).
    pub mean: DMatrix<f64>,
    /// Their change with each feature (q of m x 3).
    pub weights: Vec<DMatrix<f64>>,
}

/// One demonstration's orientations: time fractions (T), quaternions (T), features of its parameters (q).
pub(super) struct OrientationSample<'a> {
    pub(super) fractions: &'a [f64],
    pub(super) orientations: Vec<UnitQuaternion<f64>>,
    pub(super) phi: &'a DVector<f64>,
}

impl OrientationProfile {
    /// Least squares over all samples with `basis` functions; `ridge` (demonstrations) holds the features' effect back, more where
    /// the factors of their spreads (none: 1) are larger.
    pub(super) fn fit(demonstrations: &[OrientationSample], basis: usize, ridge: f64, factors: &[f64]) -> Self {
        let reference = mean_quaternion(demonstrations.iter().flat_map(|d| &d.orientations));
        let rotations = |path: Option<&DMatrix<f64>>| -> Vec<Vec<Vector3<f64>>> {
            demonstrations.iter().map(|d| rotation_vectors(d, &reference, path)).collect()
        };
        let (mut path, mut vectors) = (None, rotations(None));
        if vectors.iter().flatten().any(|r| r.norm() >= std::f64::consts::PI) {
            path = mean_path(demonstrations, basis);
            vectors = rotations(path.as_ref());
        }
        let k = demonstrations.len() as f64;
        let (mean_phi, deviations) = mean_and_deviations(&demonstrations.iter().map(|d| d.phi).collect::<Vec<_>>());
        let p = mean_phi.len();
        let spread = DVector::from_fn(p, |j, _| match deviations.column(j).norm() / k.sqrt() {
            0.0 => 1.0,
            spread => spread * factors.get(j).unwrap_or(&1.0),
        });
        let unknowns = basis * (1 + p);
        let (mut normal, mut moments) = (DMatrix::zeros(unknowns, unknowns), DMatrix::zeros(unknowns, 3));
        let mut psi = vec![0.0; basis];
        for ((d, vectors), deviation) in demonstrations.iter().zip(&vectors).zip(deviations.row_iter()) {
            let factors: Vec<f64> = std::iter::once(1.0).chain((0..p).map(|j| deviation[j] / spread[j])).collect();
            for (u, r) in d.fractions.iter().zip(vectors) {
                activations(*u, &mut psi);
                let row = DVector::from_fn(unknowns, |i, _| factors[i / basis] * psi[i % basis]);
                normal.ger(1.0, &row, &row, 1.0);
                moments.ger(1.0, &row, r, 1.0);
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
            mean -= &w * mean_phi[j];
            weights.push(w);
        }
        Self { reference, path, mean, weights }
    }

    /// The same profile for all values of so many features; this one has none.
    pub(super) fn blind_to(self, features: usize) -> Self {
        Self { weights: vec![DMatrix::zeros(self.mean.nrows(), 3); features], ..self }
    }

    /// The profile at the features `phi` (q), as one with no features left.
    #[must_use]
    pub fn at(&self, phi: &DVector<f64>) -> Self {
        let mut mean = self.mean.clone();
        for (w, value) in self.weights.iter().zip(phi.iter()) {
            mean += w * *value;
        }
        Self { reference: self.reference, path: self.path.clone(), mean, weights: Vec::new() }
    }

    /// The orientation at time fraction `u` (-; clamped to [0, 1]) with the features at zero. No allocation.
    #[must_use]
    pub fn orientation(&self, u: f64) -> UnitQuaternion<f64> {
        self.frame(u).0 * exp_map(&self.turn(u)[0])
    }

    /// The rotation vector `r` (rad) and its first and second derivative by `u` (rad) at `u` (-; clamped to [0, 1]), with the
    /// features at zero. No allocation.
    #[must_use]
    pub fn turn(&self, u: f64) -> [Vector3<f64>; 3] {
        blend(&self.mean, u.clamp(0.0, 1.0)).map(|r| r.xyz())
    }

    /// The reference `Q` at time fraction `u` (-; at rest outside [0, 1]) and its angular velocity along its own axes, per unit of `u`
    /// (rad). No allocation.
    #[must_use]
    pub fn frame(&self, u: f64) -> (UnitQuaternion<f64>, Vector3<f64>) {
        let Some(path) = &self.path else { return (self.reference, Vector3::zeros()) };
        let (along, rate) = softly_stopped(u);
        let [b, slope, _] = blend(path, along).map(Quaternion::from_vector);
        (UnitQuaternion::new_normalize(b), (b.conjugate() * slope).imag() * (2.0 * rate / b.norm_squared()))
    }
}

/// Rotation vectors (rad) from the reference, continuous along the movement.
fn rotation_vectors(d: &OrientationSample, reference: &UnitQuaternion<f64>, path: Option<&DMatrix<f64>>) -> Vec<Vector3<f64>> {
    let mut previous = Vector3::zeros();
    let vector = |(u, q): (&f64, &UnitQuaternion<f64>)| {
        let frame =
            path.map_or(*reference, |path| UnitQuaternion::from_quaternion(Quaternion::from_vector(blend(path, softly_stopped(*u).0)[0])));
        previous = continuous_log(&(frame.inverse() * q), &previous);
        previous
    };
    d.fractions.iter().zip(&d.orientations).map(vector).collect()
}

/// Quaternions at the basis centres whose blend follows all demonstrations in the mean (m x 4); `None` when they differ so much, or turn
/// so fast, that the mean is no orientation.
fn mean_path(demonstrations: &[OrientationSample], basis: usize) -> Option<DMatrix<f64>> {
    const LEAST_NORM: f64 = 0.5;
    let first = continuous_signs(&demonstrations[0].orientations);
    let (mut normal, mut moments) = (DMatrix::zeros(basis, basis), DMatrix::zeros(basis, 4));
    let mut psi = vec![0.0; basis];
    for d in demonstrations {
        let path = continuous_signs(&d.orientations);
        let beside = |u: &f64| first[((u * (first.len() - 1) as f64).round() as usize).min(first.len() - 1)];
        let agreement: f64 = d.fractions.iter().zip(&path).map(|(u, q)| beside(u).dot(q)).sum();
        for (u, q) in d.fractions.iter().zip(&path) {
            activations(softly_stopped(*u).0, &mut psi);
            let row = DVector::from_column_slice(&psi);
            normal.ger(1.0, &row, &row, 1.0);
            moments.ger(agreement.signum(), &row, q, 1.0);
        }
    }
    let path = solve_normal_equations(&normal, &moments).solution;
    let moment = |i: usize| softly_stopped(i as f64 / (4 * basis) as f64).0;
    (0..=4 * basis).all(|i| blend(&path, moment(i))[0].norm() > LEAST_NORM).then_some(path)
}

/// Where along its path the moving reference is at time fraction `u`, and how fast (per unit of `u`): even, but with a minimum-jerk stop over
/// the last tenth, so that nothing jerks when the movement is over. At rest outside [0, 1].
fn softly_stopped(u: f64) -> (f64, f64) {
    const STOP: f64 = 0.1;
    let z = ((u - (1.0 - STOP)) / STOP).clamp(0.0, 1.0);
    let held_back = STOP * z.powi(4) * (2.5 - 3.0 * z + z * z);
    let rate = if u < 0.0 { 0.0 } else { smooth_step(z, 1.0, 0.0) };
    (u.clamp(0.0, 1.0) - held_back, rate)
}

/// Quaternions with the signs that make them continuous.
fn continuous_signs(orientations: &[UnitQuaternion<f64>]) -> Vec<Vector4<f64>> {
    let mut previous = orientations.first().copied().unwrap_or_default();
    let follow = |q: &UnitQuaternion<f64>| {
        previous = same_hemisphere(q, &previous);
        previous.coords
    };
    orientations.iter().map(follow).collect()
}

/// Centres farther than this many widths have no weight: exp(-40) beside at least exp(-1/8).
const REACH: f64 = 9.0;

/// `sum_i psi_i(u) row_i / sum_i psi_i(u)` of up to four columns, and its first and second derivative by `u`.
fn blend(rows: &DMatrix<f64>, u: f64) -> [Vector4<f64>; 3] {
    let (basis, columns) = rows.shape();
    let c = (basis - 1) as f64;
    let at = u * c;
    let (from, to) = ((at - REACH).ceil().max(0.0) as usize, ((at + REACH).floor() as usize).min(basis - 1));
    let (mut sum, mut total) = ([Vector4::zeros(); 3], [0.0; 3]);
    for i in from..=to {
        let z = at - i as f64;
        let psi = (-0.5 * z * z).exp();
        let row = Vector4::from_fn(|j, _| if j < columns { rows[(i, j)] } else { 0.0 });
        for (n, factor) in [psi, -z * c * psi, (z * z - 1.0) * c * c * psi].into_iter().enumerate() {
            sum[n] += row * factor;
            total[n] += factor;
        }
    }
    let value = sum[0] / total[0];
    let slope = (sum[1] - value * total[1]) / total[0];
    [value, slope, (sum[2] - slope * (2.0 * total[1]) - value * total[2]) / total[0]]
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
