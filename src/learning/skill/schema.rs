//! The layout of a skill file, and its way to and from a [`Skill`]. Keys are an interface: add, do not rename.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Skill;
use super::schema_parts::{CombinationFile, ComplianceFile, FeaturesFile, GripperFile, LwrFile, MapFile, OrientationFile, PhmmFile};
use crate::demonstration::ParameterSource;
use crate::learning::cpdmp::{Compliance, ForceModel, MotionModel, Shaping};
use crate::learning::dmp::PhaseInput;
use crate::learning::{FeatureMap, GripperProfile, LearningError, ParameterSpace};

/// What a file calls itself.
pub(super) const FORMAT: &str = "cpdmp-skill";
/// The version this program reads and writes.
pub(super) const VERSION: u64 = 1;

#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) struct File {
    format: String,
    version: u64,
    /// Of everything else in the file; see [`super::checksum`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) checksum: Option<String>,
    #[serde(default)]
    provenance: BTreeMap<String, String>,
    /// Where the motion's parameters come from: `given`, `start`, `goal` or `start_relative_to_goal`.
    #[serde(default = "given")]
    parameter_source: String,
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

#[derive(Serialize, Deserialize, JsonSchema)]
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
    /// Principal axes of the demonstrated parameters, each in widths of its range, and how far they reach; absent where they are not known.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    parameter_combinations: Vec<CombinationFile>,
    /// Absent: linear.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    features: Option<FeaturesFile>,
    start: MapFile,
    goal: MapFile,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    phmm: Option<PhmmFile>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    lwr: Option<LwrFile>,
}

fn given() -> String {
    ParameterSource::Given.word().to_owned()
}

fn default_gate_start() -> f64 {
    0.94
}

#[derive(Serialize, Deserialize, JsonSchema)]
struct ForceFile {
    columns: Vec<String>,
    parameters: Vec<String>,
    #[serde(default)]
    parameter_ranges: Option<Vec<[f64; 2]>>,
    /// As of the motion.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    parameter_combinations: Vec<CombinationFile>,
    /// Absent: linear.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    features: Option<FeaturesFile>,
    phase_input: PhaseInput,
    phmm: PhmmFile,
}

impl File {
    pub(super) fn of(skill: &Skill) -> Self {
        let m = &skill.motion;
        let history = |of: &str| skill.histories.iter().find(|(name, _)| name == of).map(|(_, h)| h.clone()).unwrap_or_default();
        let (phmm, lwr) = match &m.shaping {
            Shaping::Phmm(phmm) => (Some(PhmmFile::of(phmm, &m.evidence, history("motion"))), None),
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
            parameter_combinations: m.parameters.combinations.iter().map(CombinationFile::of).collect(),
            features: FeaturesFile::of(&m.parameters.features),
            start: MapFile::of(&m.start),
            goal: MapFile::of(&m.goal),
            phmm,
            lwr,
        };
        let force = skill.force.as_ref().map(|f| ForceFile {
            columns: f.columns.clone(),
            parameters: f.parameters.names.clone(),
            parameter_ranges: Some(f.parameters.ranges.clone()),
            parameter_combinations: f.parameters.combinations.iter().map(CombinationFile::of).collect(),
            features: FeaturesFile::of(&f.parameters.features),
            phase_input: f.phase_input,
            phmm: PhmmFile::of(&f.phmm, &f.evidence, history("force")),
        });
        let compliance = Some(ComplianceFile::of(&skill.compliance));
        let orientation = skill.orientation.as_ref().map(OrientationFile::of);
        let gripper = skill.gripper.as_ref().map(|g| GripperFile { openings: g.openings.clone() });
        let provenance = skill.provenance.iter().cloned().collect();
        let parameter_source = skill.parameter_source.word().to_owned();
        Self {
            format: FORMAT.to_owned(),
            version: VERSION,
            checksum: None,
            provenance,
            parameter_source,
            motion,
            force,
            compliance,
            orientation,
            gripper,
        }
    }

    pub(super) fn into_skill(self) -> Result<Skill, LearningError> {
        let Some(parameter_source) = ParameterSource::from_word(&self.parameter_source) else {
            let known = ParameterSource::ALL.map(ParameterSource::word).join(", ");
            return Err(LearningError::Skill(format!("parameter_source is {}, but must be one of {known}", self.parameter_source)));
        };
        let m = self.motion;
        let parameters = space(m.parameters, m.parameter_ranges, m.parameter_combinations, m.features);
        parameters.features.check(parameters.names.len())?;
        let q = parameters.feature_count();
        let mut histories = Vec::new();
        let mut evidence = Vec::new();
        let shaping = match (m.phmm, m.lwr) {
            (Some(phmm), None) => {
                histories.push(("motion".to_owned(), phmm.log_likelihood.clone()));
                evidence = phmm.evidence("motion.phmm", q)?;
                Shaping::Phmm(phmm.into_phmm("motion.phmm", q)?)
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
            start: m.start.into_map("motion.start", q)?,
            goal: m.goal.into_map("motion.goal", q)?,
            columns: m.columns,
            parameters,
            shaping,
            evidence,
        };
        let force = match self.force {
            Some(f) => {
                histories.push(("force".to_owned(), f.phmm.log_likelihood.clone()));
                let parameters = space(f.parameters, f.parameter_ranges, f.parameter_combinations, f.features);
                parameters.features.check(parameters.names.len())?;
                let evidence = f.phmm.evidence("force.phmm", parameters.feature_count())?;
                let phmm = f.phmm.into_phmm("force.phmm", parameters.feature_count())?;
                Some(ForceModel { columns: f.columns, parameters, phase_input: f.phase_input, phmm, evidence })
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
        Ok(Skill { parameter_source, motion, force, compliance, orientation, gripper, provenance, histories })
    }
}

/// Parameter ranges may be absent in files of other programs: then everything counts as demonstrated.
fn space(
    names: Vec<String>,
    ranges: Option<Vec<[f64; 2]>>,
    combinations: Vec<CombinationFile>,
    features: Option<FeaturesFile>,
) -> ParameterSpace {
    let ranges = ranges.unwrap_or_else(|| vec![[-f64::MAX, f64::MAX]; names.len()]);
    let combinations = combinations.into_iter().map(CombinationFile::into_combination).collect();
    ParameterSpace { names, ranges, combinations, features: features.map_or(FeatureMap::Linear, FeaturesFile::into_map) }
}
