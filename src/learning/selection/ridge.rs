//! The strength of the prior on `W` that predicts demonstrations best when they are left out.

use rayon::prelude::*;

use super::super::phmm::{PhmmSettings, Sequence, fit_while, prediction_error, refine};
use super::super::{LearningError, MayGoOn, go_on};
use super::folds::folds;

/// Candidates for the strength: two per decade. 0 is not among them: with few demonstrations some prior is always better than none.
pub const RIDGES: [f64; 11] = [0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0];
/// Iterations from the fold's own model to the one of a candidate.
const CONTINUATION: usize = 30;

/// One candidate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RidgeCandidate {
    /// The strength (demonstrations).
    pub ridge: f64,
    /// Root mean square error on what was left out, in standard deviations of each column (-).
    pub error: f64,
}

/// The chosen strength and the whole curve.
#[derive(Debug, Clone, PartialEq)]
pub struct RidgeChoice {
    /// The strength with the smallest error; the settings' own when nothing can be left out or parameters do not vary.
    pub ridge: f64,
    /// Every candidate, rising.
    pub curve: Vec<RidgeCandidate>,
}

/// Chooses among [`RIDGES`]: for every distinct parameter value left out, a model is fitted from all starts with the settings' own strength
/// and then continued with each candidate's, which leaves states where they are and costs a fraction of a fit each.
///
/// # Errors
/// When the sequences cannot be learned from.
pub fn choose_ridge(sequences: &[Sequence], settings: &PhmmSettings, seed: u64, may_go_on: MayGoOn) -> Result<RidgeChoice, LearningError> {
    let thetas: Vec<_> = sequences.iter().map(|s| s.theta.clone()).collect();
    let groups = folds(&thetas);
    if groups.len() < 3 || thetas.iter().all(|theta| *theta == thetas[0]) {
        return Ok(RidgeChoice { ridge: settings.ridge, curve: Vec::new() });
    }
    let errors = groups.par_iter().map(|group| {
        let part = |left_out: bool| -> Vec<Sequence> {
            let chosen = sequences.iter().enumerate().filter(|(k, _)| group.contains(k) == left_out);
            chosen.map(|(_, s)| s.clone()).collect()
        };
        let (rest, left_out) = (part(false), part(true));
        let first = fit_while(&rest, settings, seed, may_go_on)?.model;
        let error = |ridge: &f64| {
            go_on(may_go_on, || format!("a ridge of {ridge} was tried"))?;
            let settings = PhmmSettings { ridge: *ridge, max_iterations: CONTINUATION, ..settings.clone() };
            prediction_error(&refine(&first, &rest, &settings)?.model, &left_out, sequences)
        };
        RIDGES.iter().map(error).collect::<Result<Vec<f64>, LearningError>>()
    });
    let errors: Vec<Vec<f64>> = errors.collect::<Result<_, _>>()?;
    let mean = |i: usize| (errors.iter().map(|e| e[i].powi(2)).sum::<f64>() / errors.len() as f64).sqrt();
    let curve: Vec<RidgeCandidate> = RIDGES.iter().enumerate().map(|(i, ridge)| RidgeCandidate { ridge: *ridge, error: mean(i) }).collect();
    let best = curve.iter().min_by(|a, b| a.error.total_cmp(&b.error)).map_or(settings.ridge, |c| c.ridge);
    Ok(RidgeChoice { ridge: best, curve })
}
