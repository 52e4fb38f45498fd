//! Task parameters by name, and how far a query lies outside what was demonstrated.

use nalgebra::{DMatrix, DVector};

use super::{FeatureMap, LearningError};

/// Names of parameters and the range in which they were demonstrated.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ParameterSpace {
    /// Names, sorted (p).
    pub names: Vec<String>,
    /// Smallest and largest demonstrated value of each (p).
    pub ranges: Vec<[f64; 2]>,
    /// What the models see of the parameters.
    pub features: FeatureMap,
}

impl ParameterSpace {
    /// From the values of every demonstration (K of p), with linear features.
    #[must_use]
    pub fn of(names: Vec<String>, thetas: &[DVector<f64>]) -> Self {
        let range = |j: usize| {
            let values = thetas.iter().map(|theta| theta[j]);
            [values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max)]
        };
        Self { ranges: (0..names.len()).map(range).collect(), names, features: FeatureMap::Linear }
    }

    /// The same parameters, seen through other features.
    #[must_use]
    pub fn with_features(self, features: FeatureMap) -> Self {
        Self { features, ..self }
    }

    /// Number of features (q).
    #[must_use]
    pub fn feature_count(&self) -> usize {
        self.features.count(self.names.len())
    }

    /// Values in the order of the names (p).
    ///
    /// # Errors
    /// When a name is missing, unknown or given twice, or a value is not finite.
    pub fn resolve(&self, given: &[(String, f64)]) -> Result<DVector<f64>, LearningError> {
        let mut problems = Vec::new();
        for (i, (name, value)) in given.iter().enumerate() {
            if !self.names.contains(name) {
                problems.push(format!("unknown parameter {name}; known: [{}]", self.names.join(", ")));
            } else if given[..i].iter().any(|(other, _)| other == name) {
                problems.push(format!("parameter {name} is given twice"));
            } else if !value.is_finite() {
                problems.push(format!("parameter {name} is {value}, but must be finite"));
            }
        }
        let find = |name: &String| given.iter().find(|(other, _)| other == name).map(|(_, value)| *value);
        problems.extend(self.names.iter().filter(|name| find(name).is_none()).map(|name| format!("parameter {name} is missing")));
        if !problems.is_empty() {
            return Err(LearningError::Request(problems.join("; ")));
        }
        Ok(DVector::from_iterator(self.names.len(), self.names.iter().filter_map(find)))
    }

    /// How far `theta` (p) lies outside the demonstrated range, as a fraction of the range's width (-): 0 inside, 0.33 for 29 cm
    /// after 17 to 26 cm. The worst parameter counts; outside a range without width it is infinite.
    #[must_use]
    pub fn extrapolation(&self, theta: &DVector<f64>) -> f64 {
        let outside = self.ranges.iter().zip(theta.iter()).map(|([from, to], value)| {
            let distance = (from - value).max(value - to).max(0.0);
            if distance == 0.0 { 0.0 } else { distance / (to - from) }
        });
        outside.fold(0.0, f64::max)
    }
}

/// Spread of a parameter relative to its magnitude below which it counts as constant (-): rounding is not variation.
const CONSTANT: f64 = 1e-9;

/// The mean of the parameters (p) and every demonstration's deviation from it (K x p), exactly zero for parameters that are constant.
pub(super) fn mean_and_deviations(thetas: &[&DVector<f64>]) -> (DVector<f64>, DMatrix<f64>) {
    let p = thetas.first().map_or(0, |theta| theta.len());
    let mean = thetas.iter().map(|theta| *theta / thetas.len() as f64).fold(DVector::zeros(p), |sum, part| sum + part);
    let mut deviations = DMatrix::from_fn(thetas.len(), p, |k, j| thetas[k][j] - mean[j]);
    for (j, mut column) in deviations.column_iter_mut().enumerate() {
        if column.amax() <= CONSTANT * mean[j].abs() {
            column.fill(0.0);
        }
    }
    (mean, deviations)
}
