//! A mixture from several starts: the one with the highest likelihood is kept.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::expectation_maximisation::Run;
use super::problem::Problem;
use super::{FramedSequence, TpGmm, TpGmmSettings, TpGmmStart};
use crate::learning::phmm::{FitStatus, k_means};
use crate::learning::{FOR_EVER, LearningError, MayGoOn, go_on};
use crate::math::stream;

/// How one start fared.
#[derive(Debug, Clone, PartialEq)]
pub struct TpGmmStartReport {
    /// Which start.
    pub start: TpGmmStart,
    /// The log-likelihood it reached (user units).
    pub objective: f64,
    /// How it ended.
    pub status: FitStatus,
}

/// A learned mixture and how it came about.
#[derive(Debug, Clone)]
pub struct TpGmmFit {
    /// The mixture, in user units.
    pub model: TpGmm,
    /// Log-likelihood of all samples as seen from all frames (user units), before each iteration and after the last.
    pub history: Vec<f64>,
    /// How the chosen start ended.
    pub status: FitStatus,
    /// All starts, in the order they were made; the chosen one has the highest objective.
    pub starts: Vec<TpGmmStartReport>,
}

/// Learns a mixture from every start of the settings, in parallel, and keeps the most likely one. The result does not depend on the number
/// of threads.
///
/// # Errors
/// When settings are outside their ranges, sequences disagree in frames or columns, a value is not finite, or there are fewer samples than
/// components.
pub fn fit(sequences: &[FramedSequence], settings: &TpGmmSettings, seed: u64) -> Result<TpGmmFit, LearningError> {
    fit_while(sequences, settings, seed, FOR_EVER)
}

/// Learns as [`fit`] while it may go on.
///
/// # Errors
/// As [`fit`], and [`LearningError::Stopped`] when it may not.
pub fn fit_while(sequences: &[FramedSequence], settings: &TpGmmSettings, seed: u64, may_go_on: MayGoOn) -> Result<TpGmmFit, LearningError> {
    let problem = Problem::new(sequences, settings, may_go_on)?;
    let starts = settings.starts();
    let runs: Vec<Run> = starts.par_iter().map(|start| problem.climb(problem.first_model(*start, seed))).collect();
    go_on(may_go_on, || "a mixture was learned".to_owned())?;
    let offset = problem.log_likelihood_offset();
    let objective = |run: &Run| run.history.last().map_or(f64::NEG_INFINITY, |last| last + offset);
    let report = |(start, run): (&TpGmmStart, &Run)| TpGmmStartReport { start: *start, objective: objective(run), status: run.status };
    let reports: Vec<TpGmmStartReport> = starts.iter().zip(&runs).map(report).collect();
    let mut best = 0;
    for (i, report) in reports.iter().enumerate() {
        if report.objective > reports[best].objective {
            best = i;
        }
    }
    let run = &runs[best];
    Ok(TpGmmFit {
        model: problem.to_user(run.model.clone()),
        history: run.history.iter().map(|value| value + offset).collect(),
        status: run.status,
        starts: reports,
    })
}

impl Problem<'_> {
    /// The maximum for samples that belong to one component each.
    fn first_model(&self, start: TpGmmStart, seed: u64) -> TpGmm {
        let (n, d) = (self.settings.components, self.local[0].nrows());
        let labels = match start {
            TpGmmStart::TimeSlices => self.lengths.iter().flat_map(|len| (0..*len).map(move |t| t * n / len)).collect(),
            TpGmmStart::KMeans(index) => self.clusters(seed, index),
        };
        let mut gamma = DMatrix::zeros(n, labels.len());
        for (t, label) in labels.into_iter().enumerate() {
            gamma[(label, t)] = 1.0;
        }
        let broad = TpGmm {
            priors: DVector::zeros(n),
            means: vec![vec![DVector::zeros(d); n]; self.local.len()],
            covariances: vec![vec![DMatrix::identity(d, d); n]; self.local.len()],
        };
        self.maximised(&gamma, broad)
    }

    /// k-means over the samples as all frames see them; the phase input, which they share, counts once.
    fn clusters(&self, seed: u64, index: u64) -> Vec<usize> {
        let d = self.local[0].nrows();
        let all: Vec<f64> = (0..self.samples())
            .flat_map(|t| {
                let columns = self.local.iter().flat_map(move |local| (1..d).map(move |i| local[(i, t)]));
                std::iter::once(self.local[0][(0, t)]).chain(columns)
            })
            .collect();
        k_means(&all, 1 + self.local.len() * (d - 1), self.settings.components, &mut stream(seed, "tpgmm k-means", index))
    }
}
