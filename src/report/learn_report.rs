//! What `cpdmp learn` tells: what was read, what was learned, how well it repeats and predicts.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::Serialize;

use super::{ChoiceSection, DataSection, ErrorRow, FitSection, Outcome, SkillSection, ValidationSection, WrenchRow};
use crate::demonstration::Dataset;
use crate::learning::selection::{CrossValidation, Reproduction};
use crate::learning::{Learned, LearningError, Preparation};

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
    /// How it was resampled and smoothed.
    pub preparation: PreparationSection,
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
    /// The error of the wrench that the force model expects, told the demonstration's `theta_f`; none without a force model.
    pub wrench_reproduction: Vec<WrenchRow>,
    /// Mean rms and largest error over all of them.
    pub wrench_reproduction_overall: Option<WrenchRow>,
    /// Predictions of what was left out, when they were asked for.
    pub cross_validation: Option<ValidationSection>,
    /// What a person should know.
    pub warnings: Vec<String>,
}

/// How demonstrations were resampled and smoothed before learning.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PreparationSection {
    /// Samples per second that were learned from (Hz).
    pub rate_hz: f64,
    /// Shortest and longest window that smoothed and differentiated a movement (s).
    pub smoothing_window_s: [f64; 2],
    /// Degree of the polynomials in it.
    pub smoothing_degree: usize,
}

impl PreparationSection {
    fn of(p: &Preparation) -> Self {
        Self { rate_hz: p.rate_hz, smoothing_window_s: p.window_s, smoothing_degree: p.degree }
    }

    /// In one line.
    pub(super) fn text(&self) -> String {
        let [shortest, longest] = self.smoothing_window_s.map(|window| format!("{window:.3}"));
        let window = if shortest == longest { shortest } else { format!("{shortest} to {longest}") };
        format!("resampled to {} Hz, smoothed over {window} s by polynomials of degree {}", self.rate_hz, self.smoothing_degree)
    }
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
        let skill = SkillSection::of(&learned.skill)?;
        let (wrench_rows, wrench_overall) = WrenchRow::reproduction(&skill.wrench, reproduction);
        Ok(Self {
            schema_version: 1,
            version: env!("CARGO_PKG_VERSION"),
            outcome: Outcome::Passed,
            exit_code: Outcome::Passed.exit_code(),
            dataset: path,
            written: None,
            seed,
            data: DataSection::of(dataset, notes),
            preparation: PreparationSection::of(&report.preparation),
            motion_fit: report.motion.as_ref().map(FitSection::of),
            force_fit: report.force.as_ref().map(FitSection::of),
            choices: ChoiceSection::of(report),
            alignment_shifts_s: report.alignment_shifts_s.clone(),
            forcing_noise: report.forcing_noise.iter().map(|variance| variance.max(0.0).sqrt()).collect(),
            reproduction: rows,
            reproduction_overall: overall,
            wrench_reproduction: wrench_rows,
            wrench_reproduction_overall: wrench_overall,
            cross_validation: cross_validation.and_then(|found| ValidationSection::of(found, &skill.wrench)),
            skill,
            warnings: report.warnings.clone(),
        })
    }
}
