//! What the models see of the task parameters: the parameters themselves, or functions of them in which a bent dependence is linear.
//!
//! ```text
//! z_j = (theta_j - m_j) / r_j                                 standardised over the demonstrations
//! linear      phi = theta
//! quadratic   phi = [theta; z_i z_j for i <= j]
//! rbf         phi_c = exp(-|z - z_c|^2 / (2 w^2))             one bump per centre z_c
//! ```
//!
//! The hidden Markov model, the start and the goal stay linear in `phi`. Far outside the demonstrations linear features go on straight,
//! quadratic ones bend on, and bumps vanish: what is expected then is one movement, whatever the parameters. A parameter that never varied has no `z`.

use nalgebra::{DMatrix, DVector};

use super::phmm::k_means;
use super::{LearningError, SettingFault};
use crate::math::stream;

/// Which functions of the parameters are used.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Features {
    /// The parameters themselves. Default, as in the paper.
    #[default]
    Linear,
    /// Parameters, their squares and products: needs three values per parameter.
    Quadratic,
    /// Gaussian bumps over the parameters, the kernels the paper names as future work.
    Rbf {
        /// Most bumps (1 to 200): one per distinct demonstrated value when there are no more, else the means of as many clusters.
        centres: usize,
        /// Width of a bump as a multiple of the mean distance from a centre to its nearest neighbour (-, 0.1 to 100). Sensible: 1 to 2.
        width: f64,
    },
}

impl Features {
    /// Everything that is outside its range; `prefix` is how the owner calls these settings.
    pub(crate) fn faults(self, prefix: &str) -> Vec<SettingFault> {
        let Self::Rbf { centres, width } = self else { return Vec::new() };
        let centres = SettingFault::outside(&format!("{prefix}.rbf_centres"), centres as f64, 1.0, 200.0, "");
        let width = SettingFault::outside(&format!("{prefix}.rbf_width"), width, 0.1, 100.0, "distances between centres");
        centres.into_iter().chain(width).collect()
    }
}

/// `theta (p) -> phi (q)`.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum FeatureMap {
    /// `phi = theta`.
    #[default]
    Linear,
    /// `phi = [theta; z_i z_j]`, products row by row of the upper triangle.
    Quadratic(Standard),
    /// `phi` = bumps.
    Rbf {
        /// How `theta` becomes `z`.
        standard: Standard,
        /// Centres `z_c` (q of p; -).
        centres: Vec<DVector<f64>>,
        /// Width `w` of every bump in `z` (-).
        width: f64,
    },
}

/// `z = (theta - mean) * inverse_scale`; an inverse scale of 0 leaves a parameter out.
#[derive(Debug, Clone, PartialEq)]
pub struct Standard {
    /// Mean over the demonstrations (p).
    pub mean: DVector<f64>,
    /// One over the standard deviation (p), 0 for a parameter that never varied.
    pub inverse_scale: DVector<f64>,
}

/// Spread of a parameter relative to its largest magnitude below which it counts as constant (-).
const CONSTANT: f64 = 1e-9;
/// Squared distance in `z` below which two parameter vectors are the same (-).
const SAME: f64 = 1e-12;

impl Standard {
    fn of(thetas: &[DVector<f64>]) -> Self {
        let p = thetas.first().map_or(0, DVector::len);
        let count = thetas.len().max(1) as f64;
        let mean = thetas.iter().fold(DVector::zeros(p), |sum, theta| sum + theta / count);
        let inverse_scale = DVector::from_fn(p, |j, _| {
            let spread = (thetas.iter().map(|theta| (theta[j] - mean[j]).powi(2)).sum::<f64>() / count).sqrt();
            let largest = thetas.iter().fold(0.0, |m: f64, theta| m.max(theta[j].abs()));
            if spread > CONSTANT * largest { 1.0 / spread } else { 0.0 }
        });
        Self { mean, inverse_scale }
    }

    fn at(&self, theta: &DVector<f64>) -> DVector<f64> {
        (theta - &self.mean).component_mul(&self.inverse_scale)
    }
}

impl FeatureMap {
    /// The map for demonstrated parameters (K of p); the seed decides where many values are gathered into few centres.
    #[must_use]
    pub fn of(features: Features, thetas: &[DVector<f64>], seed: u64) -> Self {
        Self::scaled(features, thetas, &[], seed)
    }

    /// The same where each parameter counts by its standard deviation times a factor (p, each at least 1; none: 1).
    #[must_use]
    pub fn scaled(features: Features, thetas: &[DVector<f64>], factors: &[f64], seed: u64) -> Self {
        if thetas.first().is_none_or(|theta| theta.is_empty()) {
            return Self::Linear;
        }
        match features {
            Features::Linear => Self::Linear,
            Features::Quadratic => Self::Quadratic(Standard::of(thetas)),
            Features::Rbf { centres, width } => {
                let mut standard = Standard::of(thetas);
                standard.inverse_scale.iter_mut().zip(factors).for_each(|(inverse, factor)| *inverse /= factor);
                let centres = centres_of(thetas.iter().map(|theta| standard.at(theta)).collect(), centres, seed);
                Self::Rbf { width: width * mean_neighbour_distance(&centres), standard, centres }
            }
        }
    }

    /// Number of features (q) of `p` parameters.
    #[must_use]
    pub fn count(&self, p: usize) -> usize {
        match self {
            Self::Linear => p,
            Self::Quadratic(_) => p + p * (p + 1) / 2,
            Self::Rbf { centres, .. } => centres.len(),
        }
    }

    /// The factors of the features' spreads that follow from those of the parameters (p, or none): a product has its members'. Bumps have them
    /// in their distances.
    #[must_use]
    pub fn factors(&self, of_parameters: &[f64]) -> Vec<f64> {
        let g = of_parameters;
        match self {
            Self::Linear => g.to_vec(),
            Self::Quadratic(_) => {
                let products = (0..g.len()).flat_map(|i| (i..g.len()).map(move |j| g[i] * g[j]));
                g.iter().copied().chain(products).collect()
            }
            Self::Rbf { .. } => Vec::new(),
        }
    }

    /// `phi(theta)` (q) for `theta` (p).
    #[must_use]
    pub fn at(&self, theta: &DVector<f64>) -> DVector<f64> {
        match self {
            Self::Linear => theta.clone(),
            Self::Quadratic(standard) => {
                let (z, p) = (standard.at(theta), theta.len());
                let products = (0..p).flat_map(|i| (i..p).map(move |j| (i, j))).map(|(i, j)| z[i] * z[j]);
                DVector::from_iterator(self.count(p), theta.iter().copied().chain(products))
            }
            Self::Rbf { standard, centres, width } => {
                let z = standard.at(theta);
                DVector::from_iterator(centres.len(), centres.iter().map(|c| bump(&z, c, *width)))
            }
        }
    }

    /// `d phi / d theta` (q x p) at `theta` (p).
    #[must_use]
    pub fn jacobian(&self, theta: &DVector<f64>) -> DMatrix<f64> {
        let p = theta.len();
        match self {
            Self::Linear => DMatrix::identity(p, p),
            Self::Quadratic(standard) => {
                let mut jacobian = DMatrix::zeros(self.count(p), p);
                jacobian.view_mut((0, 0), (p, p)).fill_diagonal(1.0);
                let z = standard.at(theta);
                for (row, (i, j)) in (p..).zip((0..p).flat_map(|i| (i..p).map(move |j| (i, j)))) {
                    jacobian[(row, i)] += z[j] * standard.inverse_scale[i];
                    jacobian[(row, j)] += z[i] * standard.inverse_scale[j];
                }
                jacobian
            }
            Self::Rbf { standard, centres, width } => {
                let z = standard.at(theta);
                DMatrix::from_fn(centres.len(), p, |c, j| {
                    bump(&z, &centres[c], *width) * (centres[c][j] - z[j]) / (width * width) * standard.inverse_scale[j]
                })
            }
        }
    }

    /// Checks shapes and numbers for `p` parameters.
    ///
    /// # Errors
    /// What is wrong.
    pub fn check(&self, p: usize) -> Result<(), LearningError> {
        let standard_fits = |s: &Standard| s.mean.len() == p && s.inverse_scale.len() == p && finite(&s.mean) && finite(&s.inverse_scale);
        let fits = match self {
            Self::Linear => true,
            Self::Quadratic(standard) => standard_fits(standard),
            Self::Rbf { standard, centres, width } => {
                let centred = !centres.is_empty() && centres.iter().all(|c| c.len() == p && finite(c));
                standard_fits(standard) && centred && width.is_finite() && *width > 0.0
            }
        };
        let wrong = || LearningError::Skill(format!("features are not finite, of a positive width, over {p} parameters"));
        if fits { Ok(()) } else { Err(wrong()) }
    }
}

fn finite(vector: &DVector<f64>) -> bool {
    vector.iter().all(|x| x.is_finite())
}

fn bump(z: &DVector<f64>, centre: &DVector<f64>, width: f64) -> f64 {
    (-0.5 * (z - centre).norm_squared() / (width * width)).exp()
}

/// The distinct values, or the means of `most` clusters of them.
fn centres_of(values: Vec<DVector<f64>>, most: usize, seed: u64) -> Vec<DVector<f64>> {
    let mut distinct: Vec<DVector<f64>> = Vec::new();
    for z in values {
        if !distinct.iter().any(|other| (other - &z).norm_squared() < SAME) {
            distinct.push(z);
        }
    }
    if distinct.len() <= most {
        return distinct;
    }
    let p = distinct[0].len();
    let flat: Vec<f64> = distinct.iter().flat_map(|z| z.iter().copied()).collect();
    let labels = k_means(&flat, p, most, &mut stream(seed, "rbf centres", 0));
    let cluster = |c: usize| {
        let members: Vec<&DVector<f64>> = labels.iter().zip(&distinct).filter(|(label, _)| **label == c).map(|(_, z)| z).collect();
        members.iter().fold(DVector::zeros(p), |sum, z| sum + *z / members.len() as f64)
    };
    (0..most).filter(|c| labels.contains(c)).map(cluster).collect()
}

/// 1, a standard deviation, for a centre without neighbours.
fn mean_neighbour_distance(centres: &[DVector<f64>]) -> f64 {
    if centres.len() < 2 {
        return 1.0;
    }
    let others = |i: usize| centres.iter().enumerate().filter(move |(j, _)| *j != i).map(|(_, other)| other);
    let nearest = |i: usize| others(i).fold(f64::INFINITY, |least: f64, other| least.min((other - &centres[i]).norm()));
    (0..centres.len()).map(nearest).sum::<f64>() / centres.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn thetas() -> Vec<DVector<f64>> {
        [[0.1, 5.0, 7.0], [0.2, 1.0, 7.0], [0.4, 2.0, 7.0], [0.2, 1.0, 7.0]].map(|t| DVector::from_row_slice(&t)).to_vec()
    }

    const ALL: [Features; 4] =
        [Features::Linear, Features::Quadratic, Features::Rbf { centres: 9, width: 1.5 }, Features::Rbf { centres: 2, width: 1.0 }];

    #[test]
    fn jacobians_equal_finite_differences() {
        for features in ALL {
            let map = FeatureMap::of(features, &thetas(), 0);
            let theta = DVector::from_row_slice(&[0.25, 3.0, 8.0]);
            let jacobian = map.jacobian(&theta);
            assert_eq!(jacobian.shape(), (map.count(3), 3));
            for j in 0..3 {
                let step = DVector::from_fn(3, |i, _| if i == j { 1e-6 } else { 0.0 });
                let slope = (map.at(&(&theta + &step)) - map.at(&(&theta - &step))) / 2e-6;
                assert!((slope - jacobian.column(j)).amax() < 1e-7, "{features:?}, parameter {j}");
            }
        }
    }

    #[test]
    fn bumps_stand_at_the_distinct_values_and_reach_their_neighbours() {
        let map = FeatureMap::of(ALL[2], &thetas(), 0);
        assert_eq!((map.count(3), FeatureMap::of(ALL[3], &thetas(), 0).count(3)), (3, 2));
        for (k, theta) in thetas()[..3].iter().enumerate() {
            let phi = map.at(theta);
            assert!((phi[k] - 1.0).abs() < 1e-12 && phi.iter().all(|x| *x > 0.0 && *x < 1.0 + 1e-12));
        }
    }

    #[test]
    fn the_unit_of_a_parameter_changes_only_the_linear_part() {
        let scale = DVector::from_row_slice(&[1e3, 1e-3, 1.0]);
        let scaled: Vec<DVector<f64>> = thetas().iter().map(|t| t.component_mul(&scale)).collect();
        let theta = DVector::from_row_slice(&[0.3, 2.5, 7.0]);
        for features in &ALL[1..] {
            let (map, other) = (FeatureMap::of(*features, &thetas(), 0), FeatureMap::of(*features, &scaled, 0));
            let from = if *features == Features::Quadratic { 3 } else { 0 };
            let (phi, also) = (map.at(&theta), other.at(&theta.component_mul(&scale)));
            assert!((phi.rows_range(from..) - also.rows_range(from..)).amax() < 1e-12, "{features:?}");
        }
    }

    #[test]
    fn no_parameter_and_one_value_for_all_give_usable_features() {
        for features in ALL {
            assert_eq!(FeatureMap::of(features, &[DVector::zeros(0), DVector::zeros(0)], 0).at(&DVector::zeros(0)).len(), 0);
            let map = FeatureMap::of(features, &vec![DVector::from_element(1, 0.3); 4], 0);
            assert!(map.at(&DVector::from_element(1, 1e6)).iter().all(|x| x.is_finite()) && map.check(1).is_ok());
            assert!(features == Features::Linear || map.check(2).is_err());
        }
    }
}
