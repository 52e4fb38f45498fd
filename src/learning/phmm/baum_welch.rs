//! Expectation maximisation over several sequences, from several starts.

use nalgebra::DVector;
use rayon::prelude::*;

use super::forward_backward::expect;
use super::maximisation::{Penalty, maximise_state};
use super::standardisation::Standardisation;
use super::starts::first_model;
use super::statistics::{Group, gather};
use super::{Expectation, Phmm, PhmmSettings, Sequence, Start};
use crate::learning::LearningError;

/// How a fit ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FitStatus {
    /// The objective rose by less than the tolerance.
    Converged,
    /// All iterations were used.
    IterationLimit,
    /// The objective fell by more than rounding explains; the model before the fall was kept.
    Fell,
    /// A covariance collapsed or a number was not finite; the last good model was kept.
    Degenerate,
}

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

/// The objective may fall by this fraction of its scale through rounding.
const ROUNDING: f64 = 1e-9;
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
    let runs: Vec<(Start, Run)> =
        settings.starts().into_par_iter().map(|start| (start, problem.run(start, seed))).collect();
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

/// One climb of the objective.
struct Run {
    model: Phmm,
    history: Vec<f64>,
    status: FitStatus,
}

impl Run {
    fn objective(&self) -> f64 {
        self.history.last().copied().unwrap_or(f64::NEG_INFINITY)
    }
}

/// Standardised data with everything the iterations need.
struct Problem<'a> {
    settings: &'a PhmmSettings,
    scaling: Standardisation,
    sequences: Vec<Sequence>,
    samples: usize,
}

impl<'a> Problem<'a> {
    fn new(sequences: &[Sequence], settings: &'a PhmmSettings) -> Result<Self, LearningError> {
        let Some(first) = sequences.first() else { return Err(LearningError::Data("no demonstration".to_owned())) };
        let (d, p) = (first.dimension, first.theta.len());
        if let Some(k) = sequences.iter().position(|s| s.dimension != d || s.theta.len() != p || s.samples() == 0) {
            return Err(LearningError::Data(format!("sequence {k} is empty or differs from the first in columns or parameters")));
        }
        let samples = sequences.iter().map(Sequence::samples).sum();
        if samples < settings.states {
            return Err(LearningError::Data(format!("{samples} samples cannot support {} states", settings.states)));
        }
        let scaling = Standardisation::of(sequences);
        let sequences = sequences.iter().map(|s| scaling.sequence(s)).collect();
        Ok(Self { settings, scaling, sequences, samples })
    }

    /// The prior is worth `ridge` demonstrations, spread over the states: it does not depend on the rate of sampling.
    fn penalty(&self, parametric: bool) -> Penalty {
        let samples_per_visit = self.samples as f64 / (self.sequences.len() * self.settings.states) as f64;
        Penalty {
            ridge: self.settings.ridge * samples_per_visit,
            floor: self.settings.covariance_floor,
            weights_on_phase: self.settings.weights_on_phase,
            parametric,
        }
    }

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

    /// Expectation and maximisation until the objective stands still.
    fn climb(&self, first: Phmm, parametric: bool, most_iterations: usize) -> Run {
        let penalty = self.penalty(parametric);
        let (mut model, mut history, mut status) = (first, Vec::new(), FitStatus::IterationLimit);
        let mut kept = model.clone();
        for iteration in 0..=most_iterations {
            let Some((objective, expectations)) = self.expectations(&model, &penalty).filter(|e| e.0.is_finite()) else {
                (model, status) = (kept, FitStatus::Degenerate);
                break;
            };
            let rise = objective - history.last().copied().unwrap_or(f64::NEG_INFINITY);
            if rise < -ROUNDING * (objective.abs() + self.samples as f64) {
                (model, status) = (kept, FitStatus::Fell);
                break;
            }
            history.push(objective);
            if rise < self.settings.tolerance * objective.abs() {
                status = FitStatus::Converged;
                break;
            }
            if iteration < most_iterations {
                kept = model.clone();
                model = self.maximised(&model, &expectations, &penalty);
            }
        }
        Run { model, history, status }
    }

    fn expectations(&self, model: &Phmm, penalty: &Penalty) -> Option<(f64, Vec<Expectation>)> {
        let expectations: Vec<Expectation> = self.sequences.iter().map(|s| expect(model, s)).collect::<Option<_>>()?;
        let priors = model.weights.iter().zip(&model.covariances).map(|(w, c)| penalty.log_prior(w, c));
        let prior: f64 = priors.collect::<Option<Vec<_>>>()?.iter().sum();
        Some((prior + expectations.iter().map(|e| e.log_likelihood).sum::<f64>(), expectations))
    }

    fn maximised(&self, model: &Phmm, expectations: &[Expectation], penalty: &Penalty) -> Phmm {
        let mut next = model.clone();
        let groups: Vec<Vec<Group>> = self.sequences.iter().zip(expectations).map(|(s, e)| gather(model, s, e)).collect();
        let thetas: Vec<&DVector<f64>> = self.sequences.iter().map(|s| &s.theta).collect();
        next.initial.fill(0.0);
        next.transition.fill(0.0);
        for e in expectations {
            for i in 0..model.states() {
                next.initial[i] += e.responsibilities[i] / expectations.len() as f64;
            }
            next.transition += &e.transitions;
        }
        for i in 0..model.states() {
            let leaving = next.transition.row(i).sum();
            let row = if leaving > 0.0 { next.transition.row(i) / leaving } else { model.transition.row(i).into_owned() };
            next.transition.set_row(i, &row);
            let of_state: Vec<&Group> = groups.iter().map(|g| &g[i]).collect();
            if let Some((w, mean, c)) = maximise_state(&of_state, &thetas, (&model.weights[i], &model.covariances[i]), penalty) {
                (next.weights[i], next.means[i], next.covariances[i]) = (w, mean, c);
            }
        }
        next
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
