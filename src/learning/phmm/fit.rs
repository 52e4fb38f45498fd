//! A model from several starts: the one with the highest objective is kept, of those in which the demonstrations share the states.
//!
//! The highest likelihood alone may belong to a model that describes one demonstration with some states and another one with others. A
//! regression over the phase then mixes movements that are not alike. From left to right a state is shared when at least half of the
//! demonstrations take part in it, and the states' phases follow each other.

use nalgebra::DVector;
use rayon::prelude::*;

use super::baum_welch::{FitStatus, Problem, Run, demonstrations};
use super::empty_states::EMPTY;
use super::starts::first_model;
use super::{Group, Phmm, PhmmSettings, Sequence, Start, StateEvidence, Topology, gather, prediction_error};
use crate::learning::{FOR_EVER, LearningError, MayGoOn, go_on};

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
    /// The objective before each iteration and after the last; empty when it never was finite.
    pub history: Vec<f64>,
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
    /// All starts, in the order they were made; the chosen one has the highest objective among those that left no state empty and whose
    /// states are shared. When there is no such, it is the one whose regression repeats the demonstrations best.
    pub starts: Vec<StartReport>,
    /// Whether the demonstrations share the states of a model from left to right; always true of an ergodic one.
    pub shared: bool,
    /// How well the demonstrations determine each state's mean (N).
    pub evidence: Vec<StateEvidence>,
}

/// How often a fit that has settled with empty states goes on with those moved.
const MOST_RESEEDINGS: usize = 3;
/// The part of the demonstrations that takes part in a state that they share (-).
const SHARED: f64 = 0.5;
/// Most iterations of the plain model that only prepares the parametric one.
const GLOBAL_ITERATIONS: usize = 50;

/// Learns a model from every start of the settings, in parallel, and keeps the one with the highest objective among those whose states the
/// demonstrations share. The result does not depend on the number of threads.
///
/// # Errors
/// When the sequences disagree in shape, hold a number that is not finite, or cannot support so many states.
pub fn fit(sequences: &[Sequence], settings: &PhmmSettings, seed: u64) -> Result<Fit, LearningError> {
    fit_while(sequences, settings, seed, FOR_EVER)
}

/// Learns as [`fit`] while it may go on.
///
/// # Errors
/// As [`fit`], and [`LearningError::Stopped`] when it may not.
pub fn fit_while(sequences: &[Sequence], settings: &PhmmSettings, seed: u64, may_go_on: MayGoOn) -> Result<Fit, LearningError> {
    let problem = Problem::new(sequences, settings, may_go_on)?;
    let runs: Vec<(Start, Run)> = settings.starts().into_par_iter().map(|start| (start, problem.run(start, seed))).collect();
    go_on(may_go_on, || "a model was learned".to_owned())?;
    let usable = problem.refuse_empty_states(&runs)?;
    problem.best(runs, &usable)
}

/// Continues from a given model in user units, with no other start; `tolerance = 0` makes exactly `max_iterations` iterations.
///
/// # Errors
/// When model and sequences do not fit together, or the likelihood is not finite from the first iteration on.
pub fn refine(model: &Phmm, sequences: &[Sequence], settings: &PhmmSettings) -> Result<Fit, LearningError> {
    model.check()?;
    let problem = Problem::new(sequences, settings, FOR_EVER)?;
    let (d, p) = (sequences[0].dimension, sequences[0].theta.len());
    if (model.dimension(), model.parameters()) != (d, p) {
        let (md, mp) = (model.dimension(), model.parameters());
        return Err(LearningError::Data(format!("the model is over {md} variables and {mp} parameters, the data over {d} and {p}")));
    }
    let first = problem.scaling.standardised(model);
    let run = problem.climb(first, true, settings.max_iterations);
    problem.best(vec![(Start::Given, run)], &[true])
}

impl Problem<'_> {
    fn run(&self, start: Start, seed: u64) -> Run {
        let global = start != Start::TimeSlices;
        let mut model = first_model(&self.sequences, self.settings, start, &self.penalty(!global), seed);
        if global {
            model = self.climb(model, false, self.settings.max_iterations.min(GLOBAL_ITERATIONS)).model;
        }
        let mut run = self.climb(model, true, self.settings.max_iterations);
        for _ in 0..MOST_RESEEDINGS {
            let Some(mended) = self.without_empty_states(&run.model) else { break };
            run = self.climb(mended, true, self.settings.max_iterations);
        }
        run
    }

    /// Whether every run that ended well left a state empty: then which, in the best of them.
    fn refuse_empty_states(&self, runs: &[(Start, Run)]) -> Result<Vec<bool>, LearningError> {
        let counts: Vec<Option<Vec<f64>>> = runs.iter().map(|(_, run)| self.occupancy(&run.model)).collect();
        let full = |c: &Option<Vec<f64>>| c.as_ref().is_some_and(|c| c.iter().all(|count| *count >= EMPTY));
        let usable: Vec<bool> = counts.iter().map(full).collect();
        let (Some(Some(first)), false) = (counts.first(), usable.contains(&true)) else { return Ok(usable) };
        let (n, shown, samples) = (first.len(), demonstrations(self.sequences.len()), self.samples);
        let (state, count) = first.iter().enumerate().fold((0, f64::INFINITY), |m, (i, c)| if *c < m.1 { (i, *c) } else { m });
        Err(LearningError::Data(format!(
            "state {state} of {n} holds {count:.2} samples after {MOST_RESEEDINGS} re-seedings, from every start: {shown} with \
             {samples} samples cannot support {n} states; use fewer states, or show more demonstrations"
        )))
    }

    /// Of the usable runs whose states are shared that with the highest objective, or else the usable one with the best regression; in user
    /// units.
    fn best(&self, runs: Vec<(Start, Run)>, usable: &[bool]) -> Result<Fit, LearningError> {
        let offset = self.scaling.log_likelihood_offset(self.samples);
        let report = |(start, run): &(Start, Run)| {
            let history: Vec<f64> = run.history.iter().map(|objective| objective + offset).collect();
            let iterations = history.len().saturating_sub(1);
            StartReport { start: *start, objective: run.objective() + offset, iterations, status: run.status, history }
        };
        let starts: Vec<StartReport> = runs.iter().map(report).collect();
        let candidate = |i: &usize| usable[*i] && runs[*i].1.objective().is_finite();
        let rank = |i: usize| {
            let (model, objective) = (&runs[i].1.model, runs[i].1.objective());
            let shared = self.shares_states(model);
            // Without shared states a likelihood says little; what counts in the end is the regression.
            let regressed = || prediction_error(model, &self.sequences, &self.sequences).map_or(f64::NEG_INFINITY, |error| -error);
            (shared, if shared { objective } else { regressed() }, i)
        };
        let ranked = (0..runs.len()).filter(candidate).map(rank);
        // The first of equals.
        let best = ranked.reduce(|best, other| if (other.0, other.1) > (best.0, best.1) { other } else { best });
        let collapsed = || {
            let floor = self.settings.covariance_floor;
            LearningError::Data(format!(
                "no start gave a finite likelihood: a covariance collapsed; raise covariance_floor (now {floor}) or use fewer states"
            ))
        };
        let (shared, _, best) = best.ok_or_else(collapsed)?;
        let evidence = self.evidence(&runs[best].1.model).ok_or_else(collapsed)?;
        let model = self.scaling.to_user(&runs[best].1.model);
        Ok(Fit { model, history: starts[best].history.clone(), status: runs[best].1.status, starts, shared, evidence })
    }

    /// Whether half of the demonstrations or more take part in every state, and phases follow each other in the order of the states. Asked of
    /// models from left to right only.
    fn shares_states(&self, model: &Phmm) -> bool {
        if self.settings.topology == Topology::Ergodic {
            return true;
        }
        let first = &self.sequences[0];
        let forward = (first.values[first.values.len() - first.dimension] - first.values[0]).signum();
        let in_order = model.means.windows(2).all(|pair| (pair[1][0] - pair[0][0]) * forward > 0.0);
        let half = SHARED * self.sequences.len() as f64;
        in_order && self.evidence(model).is_some_and(|evidence| evidence.iter().all(|e| e.demonstrations >= half))
    }

    fn evidence(&self, model: &Phmm) -> Option<Vec<StateEvidence>> {
        let expectations = self.expectations(model)?;
        let groups: Vec<Vec<Group>> = self.sequences.iter().zip(&expectations).map(|(s, e)| gather(model, s, e)).collect();
        let phis: Vec<&DVector<f64>> = self.phis.iter().collect();
        let state = |i: usize| {
            let groups: Vec<&Group> = groups.iter().map(|g| &g[i]).collect();
            StateEvidence::of(&groups, &phis, self.settings.ridge, &self.settings.scale_factors)
        };
        Some((0..model.states()).map(state).collect())
    }
}
