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
    /// In which combinations they were demonstrated; none of a single parameter.
    pub combinations: Vec<Combination>,
    /// What the models see of the parameters.
    pub features: FeatureMap,
}

/// A direction in the space of the parameters, each counted in widths of its range, and how far the demonstrations reach along it. Where
/// parameters changed together, one of these is narrow, and values that are all in range can be far outside.
#[derive(Debug, Clone, PartialEq)]
pub struct Combination {
    /// The direction (p, norm 1): a principal axis of the demonstrated values.
    pub direction: Vec<f64>,
    /// Smallest and largest demonstrated value along it (-).
    pub range: [f64; 2],
}

impl ParameterSpace {
    /// From the values of every demonstration (K of p), with linear features.
    #[must_use]
    pub fn of(names: Vec<String>, thetas: &[DVector<f64>]) -> Self {
        let range = |j: usize| {
            let values = thetas.iter().map(|theta| theta[j]);
            let (from, to) = (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max));
            if to - from <= rounding(from, to) { [from, from] } else { [from, to] }
        };
        let ranges: Vec<[f64; 2]> = (0..names.len()).map(range).collect();
        Self { combinations: combinations(&ranges, thetas), ranges, names, features: FeatureMap::Linear }
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
    /// after 17 to 26 cm. The worst parameter or combination of parameters counts; outside a range without width it is infinite.
    #[must_use]
    pub fn extrapolation(&self, theta: &DVector<f64>) -> f64 {
        self.single_extrapolation(theta).max(self.combined_extrapolation(theta))
    }

    /// The part of [`Self::extrapolation`] that is due to single values, whatever is combined with them (-).
    #[must_use]
    pub fn single_extrapolation(&self, theta: &DVector<f64>) -> f64 {
        let alone = self.ranges.iter().zip(theta.iter()).map(|(range, value)| {
            let (distance, width) = (outside(*range, *value), range[1] - range[0]);
            if distance == 0.0 || (width == 0.0 && distance <= rounding(range[0], *value)) { 0.0 } else { distance / width }
        });
        alone.fold(0.0, f64::max)
    }

    /// The part of [`Self::extrapolation`] that is due to combinations that were not demonstrated, whatever the single values are (-).
    #[must_use]
    pub fn combined_extrapolation(&self, theta: &DVector<f64>) -> f64 {
        let widths = in_widths(&self.ranges, theta);
        let combined = self.combinations.iter().map(|combination| {
            let along: f64 = combination.direction.iter().zip(&widths).map(|(v, x)| v * x).sum();
            let (distance, width) = (outside(combination.range, along), combination.range[1] - combination.range[0]);
            if distance <= ROUNDING { 0.0 } else { distance / width.max(ROUNDING) }
        });
        combined.fold(0.0, f64::max)
    }
}

/// What is rounding along a combination (widths of ranges): digits that a person leaves out.
const ROUNDING: f64 = 1e-3;

/// The difference of two values of a parameter that is rounding (its unit).
fn rounding(a: f64, b: f64) -> f64 {
    CONSTANT * a.abs().max(b.abs())
}

fn outside([from, to]: [f64; 2], value: f64) -> f64 {
    (from - value).max(value - to).max(0.0)
}

/// Each parameter from its smallest value on, in widths of its range; 0 for one that never varied.
fn in_widths(ranges: &[[f64; 2]], theta: &DVector<f64>) -> Vec<f64> {
    let width = |([from, to], value): (&[f64; 2], &f64)| if to > from { (value - from) / (to - from) } else { 0.0 };
    ranges.iter().zip(theta.iter()).map(width).collect()
}

/// The principal axes of the demonstrated values and how far those reach along each; none when fewer than two parameters vary.
fn combinations(ranges: &[[f64; 2]], thetas: &[DVector<f64>]) -> Vec<Combination> {
    let varying: Vec<usize> = (0..ranges.len()).filter(|j| ranges[*j][1] > ranges[*j][0]).collect();
    if varying.len() < 2 {
        return Vec::new();
    }
    let rows: Vec<Vec<f64>> = thetas.iter().map(|theta| in_widths(ranges, theta)).collect();
    let values = DMatrix::from_fn(rows.len(), varying.len(), |k, j| rows[k][varying[j]]);
    let centred = DMatrix::from_fn(rows.len(), varying.len(), |k, j| values[(k, j)] - values.column(j).mean());
    let axes = centred.tr_mul(&centred).symmetric_eigen().eigenvectors;
    let axis = |axis: nalgebra::DVectorView<f64>| {
        let along = &values * axis;
        let mut direction = vec![0.0; ranges.len()];
        varying.iter().zip(axis.iter()).for_each(|(j, v)| direction[*j] = *v);
        Combination { direction, range: [along.min(), along.max()] }
    };
    axes.column_iter().map(|column| axis(column.as_view())).collect()
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
