//! What `cpdmp learn` tells: what was read, what was learned, how well it repeats and predicts.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::Serialize;

use super::{ChoiceSection, DataSection, ErrorRow, FitSection, Outcome, SkillSection, ValidationSection};
use crate::demonstration::Dataset;
use crate::learning::selection::{CrossValidation, Reproduction};
use crate::learning::{Learned, LearningError};

/// The whole report; `--format json` prints it on one line.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct LearnReport {
    /// Version of this format.
    pub schema_version: u32,
    /// Version of the program.
    pub version: &'static str,
    /// How it ended.
    pub outcome: Outcome,
    /// Its exit code.
    pub exit_code: u8,
    /// The dataset as it was named.
    pub dataset: PathBuf,
    /// The skill file, when one was written.
    pub written: Option<PathBuf>,
    /// Seed of every random number.
    pub seed: u64,
    /// What was read.
    pub data: DataSection,
    /// What was learned.
    pub skill: SkillSection,
    /// How the motion model was fitted; none for the baseline.
    pub motion_fit: Option<FitSection>,
    /// How the force model was fitted, when there is one.
    pub force_fit: Option<FitSection>,
    /// What was chosen from the data.
    pub choices: Vec<ChoiceSection>,
    /// The largest shift in time of each demonstration by the alignment (s); empty without one.
    pub alignment_shifts_s: Vec<f64>,
    /// Estimated standard deviation of sensor noise in the forcing term, per motion column (unit of the column).
    pub forcing_noise: Vec<f64>,
    /// The error of repeating every demonstration, told its parameters, start, goal and duration or the learned one.
    pub reproduction: Vec<ErrorRow>,
    /// Mean rms and largest error over all of them.
    pub reproduction_overall: Option<ErrorRow>,
    /// Predictions of what was left out, when they were asked for.
    pub cross_validation: Option<ValidationSection>,
    /// What a person should know.
    pub warnings: Vec<String>,
}

impl LearnReport {
    /// Everything but the file that is written.
    ///
    /// # Errors
    /// When the skill's covariances are not usable.
    pub fn of(
        (path, dataset): (PathBuf, &Dataset),
        notes: Vec<String>,
        learned: &Learned,
        reproduction: &[Reproduction],
        cross_validation: Option<&CrossValidation>,
        seed: u64,
    ) -> Result<Self, LearningError> {
        let report = &learned.report;
        let (rows, overall) = ErrorRow::reproduction(reproduction);
        Ok(Self {
            schema_version: 1,
            version: env!("CARGO_PKG_VERSION"),
            outcome: Outcome::Passed,
            exit_code: Outcome::Passed.exit_code(),
            dataset: path,
            written: None,
            seed,
            data: DataSection::of(dataset, notes),
            skill: SkillSection::of(&learned.skill)?,
            motion_fit: report.motion.as_ref().map(FitSection::of),
            force_fit: report.force.as_ref().map(FitSection::of),
            choices: ChoiceSection::of(report),
            alignment_shifts_s: report.alignment_shifts_s.clone(),
            forcing_noise: report.forcing_noise.iter().map(|variance| variance.max(0.0).sqrt()).collect(),
            reproduction: rows,
            reproduction_overall: overall,
            cross_validation: cross_validation.and_then(ValidationSection::of),
            warnings: report.warnings.clone(),
        })
    }
}
