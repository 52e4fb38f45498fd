//! A skill as JSON: `{"format": "cpdmp-skill", "version": 1, …}`. Numbers survive the round trip bit for bit; unknown keys are allowed.

use std::collections::BTreeMap;
use std::path::Path;

use nalgebra::{DMatrix, DVector, Quaternion, UnitQuaternion};
use serde::{Deserialize, Serialize};

use super::cpdmp::{Compliance, ForceModel, MotionModel, Shaping, Statistic};
use super::dmp::{Lwr, PhaseInput};
use super::phmm::Phmm;
use super::{GripperProfile, LearningError, LinearMap, OrientationProfile, ParameterSpace, Skill};

const FORMAT: &str = "cpdmp-skill";
const VERSION: u64 = 1;

type Rows = Vec<Vec<f64>>;

impl Skill {
    /// The skill as JSON text.
    ///
    /// # Errors
    /// When the skill does not pass [`Skill::check`].
    pub fn to_json(&self) -> Result<String, LearningError> {
        self.check()?;
        let mut text = serde_json::to_string_pretty(&File::of(self)).map_err(|e| LearningError::Skill(e.to_string()))?;
        text.push('\n');
        Ok(text)
    }

    /// A skill from JSON text.
    ///
    /// # Errors
    /// When the text is not JSON of this format and version, or the skill does not pass [`Skill::check`].
    pub fn from_json(text: &str) -> Result<Self, LearningError> {
        let wrong = |e: serde_json::Error| LearningError::Skill(e.to_string());
        let value: serde_json::Value = serde_json::from_str(text).map_err(wrong)?;
        if value["format"] != FORMAT {
            return Err(LearningError::Skill(format!("\"format\" is {}, but must be \"{FORMAT}\"", value["format"])));
        }
        if value["version"] != VERSION {
            let hint = if value["version"].as_u64() > Some(VERSION) { ": a newer cpdmp wrote it" } else { "" };
            return Err(LearningError::Skill(format!("\"version\" is {}, but must be {VERSION}{hint}", value["version"])));
        }
        let file: File = serde_json::from_str(text).map_err(wrong)?;
        let skill = file.into_skill()?;
        skill.check()?;
        Ok(skill)
    }

    /// Reads a skill file.
    ///
    /// # Errors
    /// As [`Skill::from_json`], or when the file cannot be read.
    pub fn read(path: &Path) -> Result<Self, LearningError> {
        let text = std::fs::read_to_string(path).map_err(|source| LearningError::Io { path: path.to_owned(), source })?;
        Self::from_json(&text)
    }

    /// Writes a skill file: beside, then renamed.
    ///
    /// # Errors
    /// As [`Skill::to_json`], or when the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), LearningError> {
        let text = self.to_json()?;
        let io = |source| LearningError::Io { path: path.to_owned(), source };
        let parent = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let beside = tempfile::NamedTempFile::new_in(parent).map_err(io)?;
        std::fs::write(beside.path(), text).map_err(io)?;
        beside.persist(path).map_err(|e| io(e.error))?;
        Ok(())
    }
}

#[derive(Serialize, Deserialize)]
struct File {
    format: String,
    version: u64,
    #[serde(default)]
    provenance: BTreeMap<String, String>,
    motion: MotionFile,
    #[serde(default)]
    force: Option<ForceFile>,
    #[serde(default)]
    compliance: Option<ComplianceFile>,
    #[serde(default)]
    orientation: Option<OrientationFile>,
    #[serde(default)]
    gripper: Option<GripperFile>,
}

#[derive(Serialize, Deserialize)]
struct MotionFile {
    stiffness: f64,
    duration_s: f64,
    alpha: f64,
    phase_input: PhaseInput,
    #[serde(default = "default_gate_start")]
    gate_start: f64,
    columns: Vec<String>,
    parameters: Vec<String>,
    #[serde(default)]
    parameter_ranges: Option<Vec<[f64; 2]>>,
    start: MapFile,
    goal: MapFile,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    phmm: Option<PhmmFile>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    lwr: Option<LwrFile>,
}

fn default_gate_start() -> f64 {
    0.94
}

#[derive(Serialize, Deserialize)]
struct MapFile {
    weights: Rows,
    mean: Vec<f64>,
}

#[derive(Serialize, Deserialize)]
struct PhmmFile {
    initial: Vec<f64>,
    transition: Rows,
    weights: Vec<Rows>,
    means: Rows,
    covariances: Vec<Rows>,
    #[serde(default)]
    log_likelihood: Vec<f64>,
}

#[derive(Serialize, Deserialize)]
struct LwrFile {
    centres: Vec<f64>,
    widths: Vec<f64>,
    weights: Rows,
}

#[derive(Serialize, Deserialize)]
struct ForceFile {
    columns: Vec<String>,
    parameters: Vec<String>,
    #[serde(default)]
    parameter_ranges: Option<Vec<[f64; 2]>>,
    phase_input: PhaseInput,
    phmm: PhmmFile,
}

#[derive(Serialize, Deserialize)]
struct ComplianceFile {
    statistic: Statistic,
    /// `null`: no state complies.
    threshold_m2: Option<f64>,
    values_m2: Vec<f64>,
    beta: Vec<f64>,
    between_m2: Vec<Rows>,
}

#[derive(Serialize, Deserialize)]
struct OrientationFile {
    reference: [f64; 4],
    mean: Rows,
    weights: Vec<Rows>,
}

#[derive(Serialize, Deserialize)]
struct GripperFile {
    openings: Vec<f64>,
}

impl File {
    fn of(skill: &Skill) -> Self {
        let m = &skill.motion;
        let history = |of: &str| skill.histories.iter().find(|(name, _)| name == of).map(|(_, h)| h.clone()).unwrap_or_default();
        let (phmm, lwr) = match &m.shaping {
            Shaping::Phmm(phmm) => (Some(PhmmFile::of(phmm, history("motion"))), None),
            Shaping::Lwr(lwr) => (None, Some(LwrFile::of(lwr))),
        };
        let motion = MotionFile {
            stiffness: m.stiffness,
            duration_s: m.duration_s,
            alpha: m.alpha,
            phase_input: m.phase_input,
            gate_start: m.gate_start,
            columns: m.columns.clone(),
            parameters: m.parameters.names.clone(),
            parameter_ranges: Some(m.parameters.ranges.clone()),
            start: MapFile::of(&m.start),
            goal: MapFile::of(&m.goal),
            phmm,
            lwr,
        };
        let force = skill.force.as_ref().map(|f| ForceFile {
            columns: f.columns.clone(),
            parameters: f.parameters.names.clone(),
            parameter_ranges: Some(f.parameters.ranges.clone()),
            phase_input: f.phase_input,
            phmm: PhmmFile::of(&f.phmm, history("force")),
        });
        let c = &skill.compliance;
        let compliance = ComplianceFile {
            statistic: c.statistic,
            threshold_m2: c.threshold_m2.is_finite().then_some(c.threshold_m2),
            values_m2: c.values_m2.clone(),
            beta: c.beta.clone(),
            between_m2: c.between.iter().map(rows).collect(),
        };
        let orientation = skill.orientation.as_ref().map(|o| OrientationFile {
            reference: o.reference.coords.into(),
            mean: rows(&o.mean),
            weights: o.weights.iter().map(rows).collect(),
        });
        let gripper = skill.gripper.as_ref().map(|g| GripperFile { openings: g.openings.clone() });
        let provenance = skill.provenance.iter().cloned().collect();
        Self { format: FORMAT.to_owned(), version: VERSION, provenance, motion, force, compliance: Some(compliance), orientation, gripper }
    }

    fn into_skill(self) -> Result<Skill, LearningError> {
        let m = self.motion;
        let p = m.parameters.len();
        let mut histories = Vec::new();
        let shaping = match (m.phmm, m.lwr) {
            (Some(phmm), None) => {
                histories.push(("motion".to_owned(), phmm.log_likelihood.clone()));
                Shaping::Phmm(phmm.into_phmm("motion.phmm", p)?)
            }
            (None, Some(lwr)) => Shaping::Lwr(lwr.into_lwr(m.columns.len())?),
            _ => return Err(LearningError::Skill("motion needs either phmm or lwr".to_owned())),
        };
        let motion = MotionModel {
            stiffness: m.stiffness,
            duration_s: m.duration_s,
            alpha: m.alpha,
            phase_input: m.phase_input,
            gate_start: m.gate_start,
            start: m.start.into_map("motion.start", p)?,
            goal: m.goal.into_map("motion.goal", p)?,
            columns: m.columns,
            parameters: space(m.parameters, m.parameter_ranges),
            shaping,
        };
        let force = match self.force {
            Some(f) => {
                histories.push(("force".to_owned(), f.phmm.log_likelihood.clone()));
                let phmm = f.phmm.into_phmm("force.phmm", f.parameters.len())?;
                let parameters = space(f.parameters, f.parameter_ranges);
                Some(ForceModel { columns: f.columns, parameters, phase_input: f.phase_input, phmm })
            }
            None => None,
        };
        let compliance = match self.compliance {
            Some(c) => c.into_compliance(motion.columns.len())?,
            None => Compliance::stiff(motion.states(), motion.columns.len()),
        };
        let orientation = self.orientation.map(OrientationFile::into_profile).transpose()?;
        let gripper = self.gripper.map(|g| GripperProfile { openings: g.openings });
        let provenance = self.provenance.into_iter().collect();
        Ok(Skill { motion, force, compliance, orientation, gripper, provenance, histories })
    }
}

impl MapFile {
    fn of(map: &LinearMap) -> Self {
        Self { weights: rows(&map.weights), mean: map.mean.iter().copied().collect() }
    }

    fn into_map(self, place: &str, parameters: usize) -> Result<LinearMap, LearningError> {
        Ok(LinearMap { weights: matrix(place, &self.weights, parameters)?, mean: DVector::from_vec(self.mean) })
    }
}

impl PhmmFile {
    fn of(phmm: &Phmm, log_likelihood: Vec<f64>) -> Self {
        Self {
            initial: phmm.initial.iter().copied().collect(),
            transition: rows(&phmm.transition),
            weights: phmm.weights.iter().map(rows).collect(),
            means: phmm.means.iter().map(|m| m.iter().copied().collect()).collect(),
            covariances: phmm.covariances.iter().map(rows).collect(),
            log_likelihood,
        }
    }

    fn into_phmm(self, place: &str, parameters: usize) -> Result<Phmm, LearningError> {
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
    fn of(lwr: &Lwr) -> Self {
        Self {
            centres: lwr.centres.iter().copied().collect(),
            widths: lwr.widths.iter().copied().collect(),
            weights: rows(&lwr.weights),
        }
    }

    fn into_lwr(self, columns: usize) -> Result<Lwr, LearningError> {
        let weights = matrix("motion.lwr.weights", &self.weights, columns)?;
        Ok(Lwr { centres: DVector::from_vec(self.centres), widths: DVector::from_vec(self.widths), weights })
    }
}

impl ComplianceFile {
    fn into_compliance(self, columns: usize) -> Result<Compliance, LearningError> {
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
    fn into_profile(self) -> Result<OrientationProfile, LearningError> {
        let q = Quaternion::from(nalgebra::Vector4::from(self.reference));
        if !(q.norm() - 1.0).abs().lt(&1e-6) {
            return Err(LearningError::Skill("orientation.reference is not a unit quaternion x, y, z, w".to_owned()));
        }
        let weights = self.weights.iter().enumerate().map(|(j, w)| matrix(&format!("orientation.weights[{j}]"), w, 3));
        Ok(OrientationProfile {
            reference: UnitQuaternion::new_unchecked(q),
            mean: matrix("orientation.mean", &self.mean, 3)?,
            weights: weights.collect::<Result<_, _>>()?,
        })
    }
}

/// Parameter ranges may be absent in files of other programs: then everything counts as demonstrated.
fn space(names: Vec<String>, ranges: Option<Vec<[f64; 2]>>) -> ParameterSpace {
    let ranges = ranges.unwrap_or_else(|| vec![[-f64::MAX, f64::MAX]; names.len()]);
    ParameterSpace { names, ranges }
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
