//! A model from several starts: the one with the highest objective is kept.

use rayon::prelude::*;

use super::baum_welch::{FitStatus, Problem, Run};
use super::starts::first_model;
use super::{Phmm, PhmmSettings, Sequence, Start};
use crate::learning::LearningError;

/// How one start fared.
#[derive(Debug, Clone, PartialEq)]
pub struct StartReport {
    /// Which start.
    pub start: Start,
    /// The objective it reached (log-likelihood in user units plus log prior).
    pub objective: f64,
    /// Iterations of the parametric stage.
    pub iterations: usize,
    /// How it ended.
    pub status: FitStatus,
}

/// A learned model and how it came about.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The model, in user units.
    pub model: Phmm,
    /// Log-likelihood in user units plus log prior, before each iteration and after the last.
    pub history: Vec<f64>,
    /// How the chosen start ended.
    pub status: FitStatus,
    /// All starts, in the order they were made; the chosen one has the highest objective.
    pub starts: Vec<StartReport>,
}

/// A state with fewer expected samples than this is empty and is moved once the fit has settled.
const EMPTY: f64 = 1.0;
/// Most iterations of the plain model that only prepares the parametric one.
const GLOBAL_ITERATIONS: usize = 50;

/// Learns a model from every start of the settings, in parallel, and keeps the one with the highest objective. The result does not
/// depend on the number of threads.
///
/// # Errors
/// When the sequences disagree in shape or hold fewer samples than states.
pub fn fit(sequences: &[Sequence], settings: &PhmmSettings, seed: u64) -> Result<Fit, LearningError> {
    let problem = Problem::new(sequences, settings)?;
    let runs: Vec<(Start, Run)> = settings.starts().into_par_iter().map(|start| (start, problem.run(start, seed))).collect();
    Ok(problem.best(runs))
}

/// Continues from a given model in user units, with no other start; `tolerance = 0` makes exactly `max_iterations` iterations.
///
/// # Errors
/// When model and sequences do not fit together.
pub fn refine(model: &Phmm, sequences: &[Sequence], settings: &PhmmSettings) -> Result<Fit, LearningError> {
    model.check()?;
    let problem = Problem::new(sequences, settings)?;
    let (d, p) = (sequences[0].dimension, sequences[0].theta.len());
    if (model.dimension(), model.parameters()) != (d, p) {
        let (md, mp) = (model.dimension(), model.parameters());
        return Err(LearningError::Data(format!("the model is over {md} variables and {mp} parameters, the data over {d} and {p}")));
    }
    let first = problem.scaling.standardised(model);
    let run = problem.climb(first, true, settings.max_iterations);
    Ok(problem.best(vec![(Start::Given, run)]))
}

impl Problem<'_> {
    fn run(&self, start: Start, seed: u64) -> Run {
        let global = start != Start::TimeSlices;
        let mut model = first_model(&self.sequences, self.settings, start, &self.penalty(!global), seed);
        if global {
            model = self.climb(model, false, self.settings.max_iterations.min(GLOBAL_ITERATIONS)).model;
        }
        let mut run = self.climb(model, true, self.settings.max_iterations);
        if let Some(mended) = self.without_empty_states(&run.model) {
            let again = self.climb(mended, true, self.settings.max_iterations);
            if again.objective() > run.objective() {
                run = again;
            }
        }
        run
    }

    /// Every empty state moved to half of the fullest one; `None` when no state is empty.
    fn without_empty_states(&self, model: &Phmm) -> Option<Phmm> {
        let (_, expectations) = self.expectations(model, &self.penalty(true))?;
        let n = model.states();
        let mut counts = vec![0.0; n];
        for row in expectations.iter().flat_map(|e| e.responsibilities.chunks_exact(n)) {
            counts.iter_mut().zip(row).for_each(|(count, g)| *count += g);
        }
        let empty: Vec<usize> = (0..n).filter(|i| counts[*i] < EMPTY).collect();
        if empty.is_empty() {
            return None;
        }
        let mut mended = model.clone();
        for i in empty {
            let fullest = (0..n).max_by(|a, b| counts[*a].total_cmp(&counts[*b]))?;
            let spread = mended.covariances[fullest].diagonal().map(|v| 0.5 * v.max(0.0).sqrt());
            mended.means[i] = &mended.means[fullest] + &spread;
            mended.means[fullest] -= &spread;
            mended.weights[i] = mended.weights[fullest].clone();
            mended.covariances[i] = mended.covariances[fullest].clone();
            (counts[i], counts[fullest]) = (0.5 * counts[fullest], 0.5 * counts[fullest]);
        }
        Some(mended)
    }

    fn best(&self, runs: Vec<(Start, Run)>) -> Fit {
        let offset = self.scaling.log_likelihood_offset(self.samples);
        let report = |(start, run): &(Start, Run)| StartReport {
            start: *start,
            objective: run.objective() + offset,
            iterations: run.history.len().saturating_sub(1),
            status: run.status,
        };
        let starts = runs.iter().map(report).collect();
        let mut best = 0;
        for (i, (_, run)) in runs.iter().enumerate() {
            if run.objective() > runs[best].1.objective() {
                best = i;
            }
        }
        let run = &runs[best].1;
        let history = run.history.iter().map(|objective| objective + offset).collect();
        Fit { model: self.scaling.to_user(&run.model), history, status: run.status, starts }
    }
}
