//! TP-GMM on the two-sided task, with the frames that make it strongest.
//!
//! Told the side, it sees start, goal and the edge that is passed from frames that are mirrored on the left: both sides then look the same,
//! and the edge says where to pass. Not told, it sees start, goal and both edges.

use nalgebra::{DMatrix, DVector};

use super::reproduction::SAMPLES;
use super::two_sided_settings::TwoSidedObstacleSettings;
use super::{COLUMNS, Guidance, Method, ModelReport, Side};
use crate::demonstration::Trajectory;
use crate::learning::tpgmm::{Frame, FramedSequence, TpGmm, fit_while};
use crate::learning::{LearningError, MayGoOn};

/// The mixture of one guidance.
pub(super) struct Rival {
    model: TpGmm,
}

impl Rival {
    pub(super) fn learned(
        settings: &TwoSidedObstacleSettings,
        guidance: Guidance,
        seed: u64,
        may_go_on: MayGoOn,
    ) -> Result<(Self, ModelReport), LearningError> {
        let dataset = settings.dataset(Method::TpGmm, guidance, seed)?;
        let situations = settings.shown_situations();
        let sequences = dataset.demonstrations.iter().zip(&situations).map(|(demonstration, (half_width, side))| {
            let learned = demonstration.trajectory.resampled(settings.learning.rate_hz)?;
            let told = (guidance != Guidance::WithoutSide).then_some(*side);
            Ok(FramedSequence { values: over_the_phase(&learned)?, frames: frames(settings, *half_width, told)? })
        });
        let fitted = fit_while(&sequences.collect::<Result<Vec<_>, LearningError>>()?, &settings.tpgmm, seed, may_go_on)?;
        let report = ModelReport {
            method: Method::TpGmm,
            guidance,
            states: settings.tpgmm.components,
            starts: fitted.starts.len(),
            status: Some(fitted.status),
            log_likelihood: fitted.history,
            warnings: Vec::new(),
        };
        Ok((Self { model: fitted.model }, report))
    }

    /// The path (m) past an obstacle of a half width (m).
    pub(super) fn path(
        &self,
        settings: &TwoSidedObstacleSettings,
        half_width: f64,
        told: Option<Side>,
    ) -> Result<Vec<[f64; 2]>, LearningError> {
        let inputs: Vec<f64> = (0..SAMPLES).map(|t| t as f64 / (SAMPLES - 1) as f64).collect();
        let path = self.model.reproduce(&frames(settings, half_width, told)?, &inputs)?;
        Ok(path.row_iter().map(|row| [row[0], row[1]]).collect())
    }
}

fn frames(settings: &TwoSidedObstacleSettings, half_width: f64, told: Option<Side>) -> Result<Vec<Frame>, LearningError> {
    let mut origins = vec![settings.start_m, settings.goal_m];
    match told {
        Some(side) => origins.push([side.sign() * half_width, 0.0]),
        None => origins.extend([[-half_width, 0.0], [half_width, 0.0]]),
    }
    let axes = DMatrix::from_diagonal(&DVector::from_vec(vec![told.map_or(1.0, Side::sign), 1.0]));
    origins.into_iter().map(|origin| Frame::new(axes.clone(), DVector::from_column_slice(&origin))).collect()
}

/// Samples `[u, x, y]`, row by row.
fn over_the_phase(trajectory: &Trajectory) -> Result<Vec<f64>, LearningError> {
    let values = trajectory.select(&COLUMNS)?;
    let last = (values.nrows() - 1) as f64;
    Ok(values.row_iter().enumerate().flat_map(|(t, row)| [t as f64 / last, row[0], row[1]]).collect())
}
