//! The parts of a skill file: matrices as lists of rows.

use nalgebra::{DMatrix, DVector, Quaternion, UnitQuaternion};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::learning::cpdmp::{Compliance, Statistic};
use crate::learning::dmp::Lwr;
use crate::learning::phmm::{Phmm, StateEvidence};
use crate::learning::{Combination, FeatureMap, LearningError, LinearMap, OrientationProfile, Standard};

type Rows = Vec<Vec<f64>>;

#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct MapFile {
    weights: Rows,
    mean: Vec<f64>,
}

#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct PhmmFile {
    initial: Vec<f64>,
    transition: Rows,
    weights: Vec<Rows>,
    means: Rows,
    covariances: Vec<Rows>,
    /// One per state, or none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    evidence: Vec<EvidenceFile>,
    #[serde(default)]
    pub(super) log_likelihood: Vec<f64>,
}

/// How well the demonstrations determine a state's mean.
#[derive(Serialize, Deserialize, JsonSchema)]
struct EvidenceFile {
    demonstrations: f64,
    centre: Vec<f64>,
    information: Rows,
}

#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct LwrFile {
    centres: Vec<f64>,
    widths: Vec<f64>,
    weights: Rows,
}

#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct ComplianceFile {
    statistic: Statistic,
    /// `null`: no state complies.
    threshold_m2: Option<f64>,
    values_m2: Vec<f64>,
    beta: Vec<f64>,
    between_m2: Vec<Rows>,
}

#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct OrientationFile {
    reference: [f64; 4],
    /// Absent where the reference stands, and in files of programs that know no other.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    reference_path: Option<Rows>,
    mean: Rows,
    weights: Vec<Rows>,
}

#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct GripperFile {
    pub(super) openings: Vec<f64>,
}

/// A direction in the space of the parameters, and how far the demonstrations reach along it.
#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct CombinationFile {
    direction: Vec<f64>,
    range: [f64; 2],
}

impl CombinationFile {
    pub(super) fn of(combination: &Combination) -> Self {
        Self { direction: combination.direction.clone(), range: combination.range }
    }

    pub(super) fn into_combination(self) -> Combination {
        Combination { direction: self.direction, range: self.range }
    }
}

/// Functions of the parameters.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub(super) enum FeaturesFile {
    Linear,
    Quadratic { mean: Vec<f64>, inverse_scale: Vec<f64> },
    Rbf { mean: Vec<f64>, inverse_scale: Vec<f64>, centres: Rows, width: f64 },
}

impl FeaturesFile {
    /// `None` for linear features, which a file need not name.
    pub(super) fn of(map: &FeatureMap) -> Option<Self> {
        let list = |v: &DVector<f64>| v.iter().copied().collect::<Vec<f64>>();
        match map {
            FeatureMap::Linear => None,
            FeatureMap::Quadratic(s) => Some(Self::Quadratic { mean: list(&s.mean), inverse_scale: list(&s.inverse_scale) }),
            FeatureMap::Rbf { standard: s, centres, width } => Some(Self::Rbf {
                mean: list(&s.mean),
                inverse_scale: list(&s.inverse_scale),
                centres: centres.iter().map(list).collect(),
                width: *width,
            }),
        }
    }

    pub(super) fn into_map(self) -> FeatureMap {
        let standard = |mean, scale| Standard { mean: DVector::from_vec(mean), inverse_scale: DVector::from_vec(scale) };
        match self {
            Self::Linear => FeatureMap::Linear,
            Self::Quadratic { mean, inverse_scale } => FeatureMap::Quadratic(standard(mean, inverse_scale)),
            Self::Rbf { mean, inverse_scale, centres, width } => {
                let centres = centres.into_iter().map(DVector::from_vec).collect();
                FeatureMap::Rbf { standard: standard(mean, inverse_scale), centres, width }
            }
        }
    }
}

impl MapFile {
    pub(super) fn of(map: &LinearMap) -> Self {
        Self { weights: rows(&map.weights), mean: map.mean.iter().copied().collect() }
    }

    pub(super) fn into_map(self, place: &str, parameters: usize) -> Result<LinearMap, LearningError> {
        Ok(LinearMap { weights: matrix(place, &self.weights, parameters)?, mean: DVector::from_vec(self.mean) })
    }
}

impl PhmmFile {
    pub(super) fn of(phmm: &Phmm, evidence: &[StateEvidence], log_likelihood: Vec<f64>) -> Self {
        let evidence = evidence.iter().map(|e| EvidenceFile {
            demonstrations: e.demonstrations,
            centre: e.centre.iter().copied().collect(),
            information: rows(&e.information),
        });
        Self {
            evidence: evidence.collect(),
            initial: phmm.initial.iter().copied().collect(),
            transition: rows(&phmm.transition),
            weights: phmm.weights.iter().map(rows).collect(),
            means: phmm.means.iter().map(|m| m.iter().copied().collect()).collect(),
            covariances: phmm.covariances.iter().map(rows).collect(),
            log_likelihood,
        }
    }

    pub(super) fn evidence(&self, place: &str, features: usize) -> Result<Vec<StateEvidence>, LearningError> {
        let state = |(i, e): (usize, &EvidenceFile)| {
            let information = matrix(&format!("{place}.evidence[{i}].information"), &e.information, features)?;
            Ok(StateEvidence { demonstrations: e.demonstrations, centre: DVector::from_column_slice(&e.centre), information })
        };
        self.evidence.iter().enumerate().map(state).collect()
    }

    pub(super) fn into_phmm(self, place: &str, parameters: usize) -> Result<Phmm, LearningError> {
        let (n, d) = (self.initial.len(), self.means.first().map_or(0, Vec::len));
        let matrices = |key: &str, list: &[Rows], columns: usize| -> Result<Vec<DMatrix<f64>>, LearningError> {
            list.iter().enumerate().map(|(i, m)| matrix(&format!("{place}.{key}[{i}]"), m, columns)).collect()
        };
        Ok(Phmm {
            transition: matrix(&format!("{place}.transition"), &self.transition, n)?,
            weights: matrices("weights", &self.weights, parameters)?,
            covariances: matrices("covariances", &self.covariances, d)?,
            initial: DVector::from_vec(self.initial),
            means: self.means.into_iter().map(DVector::from_vec).collect(),
        })
    }
}

impl LwrFile {
    pub(super) fn of(lwr: &Lwr) -> Self {
        Self { centres: lwr.centres.iter().copied().collect(), widths: lwr.widths.iter().copied().collect(), weights: rows(&lwr.weights) }
    }

    pub(super) fn into_lwr(self, columns: usize) -> Result<Lwr, LearningError> {
        let weights = matrix("motion.lwr.weights", &self.weights, columns)?;
        Ok(Lwr { centres: DVector::from_vec(self.centres), widths: DVector::from_vec(self.widths), weights })
    }
}

impl ComplianceFile {
    pub(super) fn of(c: &Compliance) -> Self {
        Self {
            statistic: c.statistic,
            threshold_m2: c.threshold_m2.is_finite().then_some(c.threshold_m2),
            values_m2: c.values_m2.clone(),
            beta: c.beta.clone(),
            between_m2: c.between.iter().map(rows).collect(),
        }
    }

    pub(super) fn into_compliance(self, columns: usize) -> Result<Compliance, LearningError> {
        let between = self.between_m2.iter().enumerate();
        let between = between.map(|(i, b)| matrix(&format!("compliance.between_m2[{i}]"), b, columns));
        Ok(Compliance {
            statistic: self.statistic,
            threshold_m2: self.threshold_m2.unwrap_or(f64::INFINITY),
            values_m2: self.values_m2,
            beta: self.beta,
            between: between.collect::<Result<_, _>>()?,
        })
    }
}

impl OrientationFile {
    pub(super) fn of(o: &OrientationProfile) -> Self {
        Self {
            reference: o.reference.coords.into(),
            reference_path: o.path.as_ref().map(rows),
            mean: rows(&o.mean),
            weights: o.weights.iter().map(rows).collect(),
        }
    }

    pub(super) fn into_profile(self) -> Result<OrientationProfile, LearningError> {
        let q = Quaternion::from(nalgebra::Vector4::from(self.reference));
        if !(q.norm() - 1.0).abs().lt(&1e-6) {
            return Err(LearningError::Skill("orientation.reference is not a unit quaternion x, y, z, w".to_owned()));
        }
        let weights = self.weights.iter().enumerate().map(|(j, w)| matrix(&format!("orientation.weights[{j}]"), w, 3));
        Ok(OrientationProfile {
            reference: UnitQuaternion::new_unchecked(q),
            path: self.reference_path.map(|path| matrix("orientation.reference_path", &path, 4)).transpose()?,
            mean: matrix("orientation.mean", &self.mean, 3)?,
            weights: weights.collect::<Result<_, _>>()?,
        })
    }
}

fn rows(matrix: &DMatrix<f64>) -> Rows {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}

fn matrix(place: &str, rows: &Rows, columns: usize) -> Result<DMatrix<f64>, LearningError> {
    if let Some(row) = rows.iter().position(|row| row.len() != columns) {
        return Err(LearningError::Skill(format!("{place}: row {row} has {} numbers, expected {columns}", rows[row].len())));
    }
    Ok(DMatrix::from_fn(rows.len(), columns, |i, j| rows[i][j]))
}
