//! The data of a mixture: samples as every frame sees them, in unit-free coordinates.

use nalgebra::{DMatrix, DVector};

use super::{FramedSequence, TpGmm, TpGmmSettings};
use crate::learning::phmm::mean_and_spread;
use crate::learning::{LearningError, MayGoOn};

/// All samples as every frame sees them, with mean 0 and spread 1 per column.
pub(super) struct Problem<'a> {
    pub(super) settings: &'a TpGmmSettings,
    /// By frame: one column per sample (1 + d x T).
    pub(super) local: Vec<DMatrix<f64>>,
    /// Number of samples of every sequence.
    pub(super) lengths: Vec<usize>,
    /// Mean and spread by frame, then by variable.
    scaling: Vec<Vec<(f64, f64)>>,
    /// Asked before every iteration. What a climb that may not go on has reached is no result: whoever started it asks again.
    pub(super) may_go_on: MayGoOn<'a>,
}

impl<'a> Problem<'a> {
    pub(super) fn new(sequences: &[FramedSequence], settings: &'a TpGmmSettings, may_go_on: MayGoOn<'a>) -> Result<Self, LearningError> {
        let faults = settings.faults("tpgmm");
        if !faults.is_empty() {
            return Err(LearningError::Settings(faults));
        }
        let Some(first) = sequences.first() else { return Err(LearningError::Data("no demonstration".to_owned())) };
        let (frames, d) = (first.frames.len(), first.dimension());
        let differs = |s: &FramedSequence| {
            let shape = s.frames.len() == frames && s.frames.iter().all(|frame| frame.dimension() + 1 == d) && !s.values.is_empty();
            !shape || !s.values.len().is_multiple_of(d.max(1)) || s.values.iter().any(|x| !x.is_finite())
        };
        if let Some(k) = sequences.iter().position(differs) {
            return Err(LearningError::Data(format!("sequence {k} is empty, not finite, or differs from the first in frames or columns")));
        }
        let lengths: Vec<usize> = sequences.iter().map(FramedSequence::samples).collect();
        let samples: usize = lengths.iter().sum();
        if frames == 0 || samples < settings.components {
            let found = format!("{frames} frames and {samples} samples");
            return Err(LearningError::Data(format!("{found} cannot support {} components", settings.components)));
        }
        let mut local: Vec<DMatrix<f64>> = (0..frames).map(|j| seen_from(sequences, j)).collect();
        let scaling = local.iter_mut().map(standardise).collect();
        Ok(Self { settings, local, lengths, scaling, may_go_on })
    }

    pub(super) fn samples(&self) -> usize {
        self.lengths.iter().sum()
    }

    /// A standardised model in user units.
    pub(super) fn to_user(&self, mut model: TpGmm) -> TpGmm {
        for (j, scaling) in self.scaling.iter().enumerate() {
            let scale = DVector::from_iterator(scaling.len(), scaling.iter().map(|s| s.1));
            let mean = DVector::from_iterator(scaling.len(), scaling.iter().map(|s| s.0));
            for i in 0..model.components() {
                model.means[j][i] = &mean + scale.component_mul(&model.means[j][i]);
                let covariance = &model.covariances[j][i];
                model.covariances[j][i] = DMatrix::from_fn(scale.len(), scale.len(), |a, b| scale[a] * covariance[(a, b)] * scale[b]);
            }
        }
        model
    }

    /// What to add to a standardised log-likelihood to get the one in user units.
    pub(super) fn log_likelihood_offset(&self) -> f64 {
        -(self.samples() as f64) * self.scaling.iter().flatten().map(|(_, spread)| spread.ln()).sum::<f64>()
    }
}

fn seen_from(sequences: &[FramedSequence], frame: usize) -> DMatrix<f64> {
    let rows = sequences.iter().flat_map(|s| s.values.chunks_exact(s.dimension()).map(|row| s.frames[frame].local(row)));
    DMatrix::from_columns(&rows.collect::<Vec<_>>())
}

fn standardise(local: &mut DMatrix<f64>) -> Vec<(f64, f64)> {
    let mut scaling = Vec::with_capacity(local.nrows());
    for mut row in local.row_iter_mut() {
        let (mean, spread) = mean_and_spread(row.iter().copied().collect::<Vec<_>>().into_iter());
        row.iter_mut().for_each(|x| *x = (*x - mean) / spread);
        scaling.push((mean, spread));
    }
    scaling
}
