//! How many states a model needs.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::super::parameters::mean_and_deviations;
use super::super::phmm::{Phmm, PhmmSettings, Sequence, Topology, expect, fit_while, prediction_error};
use super::super::{LearningError, MayGoOn, go_on};
use super::folds::folds;
use crate::math::solve_normal_equations;

/// What decides about the number of states.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StatesCriterion {
    /// Bayes' information criterion, `k ln(samples) - 2 log-likelihood`, on all demonstrations. Samples of a movement are not independent,
    /// so it favours many states.
    Bic,
    /// The error on parameter values that were left out (-, in standard deviations of each column).
    CrossValidation,
}

/// The numbers of states to try.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StatesSearch {
    /// What decides. Default cross-validation.
    pub criterion: StatesCriterion,
    /// Fewest states (1 to 200). Default 4.
    pub min: usize,
    /// Most states (`min` to 200). Default 24.
    pub max: usize,
}

impl Default for StatesSearch {
    fn default() -> Self {
        Self { criterion: StatesCriterion::CrossValidation, min: 4, max: 24 }
    }
}

/// One number of states and its score; less is better.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StatesCandidate {
    /// Number of states.
    pub states: usize,
    /// The criterion's value; infinite when this many could not be fitted.
    pub score: f64,
}

/// The chosen number and the whole curve.
#[derive(Debug, Clone, PartialEq)]
pub struct StatesChoice {
    /// What decided.
    pub criterion: StatesCriterion,
    /// The number of states with the least score.
    pub states: usize,
    /// Every number that was tried, rising.
    pub curve: Vec<StatesCandidate>,
}

/// Fits every number of states of the search from all starts of the settings and keeps the one with the least score.
///
/// # Errors
/// When no number of states can be fitted, or cross-validation has fewer than two demonstrations.
pub fn choose_states(
    sequences: &[Sequence],
    settings: &PhmmSettings,
    search: StatesSearch,
    seed: u64,
    may_go_on: MayGoOn,
) -> Result<StatesChoice, LearningError> {
    let groups = folds(&sequences.iter().map(|s| s.theta.clone()).collect::<Vec<_>>());
    if search.criterion == StatesCriterion::CrossValidation && groups.len() < 2 {
        return Err(LearningError::Data("choosing states by cross-validation needs at least two demonstrations".to_owned()));
    }
    let numbers: Vec<usize> = (search.min..=search.max).collect();
    let scores: Vec<Result<f64, LearningError>> = numbers
        .par_iter()
        .map(|states| {
            let settings = PhmmSettings { states: *states, ..settings.clone() };
            match search.criterion {
                StatesCriterion::Bic => bic(sequences, &settings, seed, may_go_on),
                StatesCriterion::CrossValidation => left_out_error(sequences, &groups, &settings, seed, may_go_on),
            }
        })
        .collect();
    // A number of states that was not tried for want of time is none that cannot be fitted.
    go_on(may_go_on, || "the number of states was chosen".to_owned())?;
    let score = |s: &Result<f64, LearningError>| s.as_ref().ok().copied().filter(|x| x.is_finite()).unwrap_or(f64::INFINITY);
    let curve: Vec<StatesCandidate> =
        numbers.iter().zip(&scores).map(|(states, s)| StatesCandidate { states: *states, score: score(s) }).collect();
    match curve.iter().min_by(|a, b| a.score.total_cmp(&b.score)) {
        Some(best) if best.score.is_finite() => Ok(StatesChoice { criterion: search.criterion, states: best.states, curve }),
        _ => Err(scores.into_iter().find_map(Result::err).unwrap_or_else(|| LearningError::Data("no number of states to try".to_owned()))),
    }
}

fn bic(sequences: &[Sequence], settings: &PhmmSettings, seed: u64, may_go_on: MayGoOn) -> Result<f64, LearningError> {
    let model = fit_while(sequences, settings, seed, may_go_on)?.model;
    let degenerate = || LearningError::Model("a covariance is not positive definite".to_owned());
    let mut log_likelihood = 0.0;
    for sequence in sequences {
        log_likelihood += expect(&model, sequence).ok_or_else(degenerate)?.log_likelihood;
    }
    let samples: usize = sequences.iter().map(Sequence::samples).sum();
    Ok(free_parameters(&model, settings, sequences) as f64 * (samples as f64).ln() - 2.0 * log_likelihood)
}

/// How many numbers of a model the data choose: means, covariances, `W` (without the phase row unless it is learned), and the transitions
/// that the topology leaves open. A row of `W` has as many free numbers as the demonstrations vary features: one bump per demonstrated
/// value, squares of a parameter with two values, or a parameter that never varied, add columns that nothing decides about. Floors and
/// priors are not counted: they act on a state's few directions without data.
#[must_use]
pub fn free_parameters(model: &Phmm, settings: &PhmmSettings, sequences: &[Sequence]) -> usize {
    let (n, d, p) = (model.states(), model.dimension(), varied_features(sequences));
    let rows = if settings.weights_on_phase { d } else { d - 1 };
    let chain = match settings.topology {
        Topology::LeftToRight => n - 1,
        Topology::Ergodic => (n - 1) + n * (n - 1),
    };
    n * (d + d * (d + 1) / 2 + rows * p) + chain
}

/// Rank of the features' deviations from their mean over the demonstrations.
fn varied_features(sequences: &[Sequence]) -> usize {
    let features: Vec<&DVector<f64>> = sequences.iter().map(|s| &s.theta).collect();
    let (_, deviations) = mean_and_deviations(&features);
    solve_normal_equations(&deviations.tr_mul(&deviations), &DMatrix::zeros(deviations.ncols(), 0)).rank
}

fn left_out_error(
    sequences: &[Sequence],
    groups: &[Vec<usize>],
    settings: &PhmmSettings,
    seed: u64,
    may_go_on: MayGoOn,
) -> Result<f64, LearningError> {
    let mut squares = 0.0;
    for group in groups {
        let part = |left_out: bool| -> Vec<Sequence> {
            let chosen = sequences.iter().enumerate().filter(|(k, _)| group.contains(k) == left_out);
            chosen.map(|(_, s)| s.clone()).collect()
        };
        let model = fit_while(&part(false), settings, seed, may_go_on)?.model;
        squares += prediction_error(&model, &part(true), sequences)?.powi(2);
    }
    Ok((squares / groups.len() as f64).sqrt())
}
