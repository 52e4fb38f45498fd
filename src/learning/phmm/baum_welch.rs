//! Expectation maximisation over several sequences, until the objective stands still.

use nalgebra::DVector;

use super::forward_backward::Recursions;
use super::maximisation::{Penalty, maximise_state};
use super::standardisation::Standardisation;
use super::statistics::{Group, gather};
use super::{CovarianceMode, Expectation, Phmm, PhmmSettings, Sequence};
use crate::learning::{LearningError, MayGoOn};

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

/// The objective may fall by this fraction of its scale through rounding.
const ROUNDING: f64 = 1e-9;
/// Floor for which rounding is allowed when there is none (-).
const LEAST_FLOOR: f64 = 1e-8;
/// One climb of the objective.
pub(super) struct Run {
    pub(super) model: Phmm,
    pub(super) history: Vec<f64>,
    pub(super) status: FitStatus,
}

impl Run {
    pub(super) fn objective(&self) -> f64 {
        self.history.last().copied().unwrap_or(f64::NEG_INFINITY)
    }
}

/// What the iterations of one climb use again and again.
#[derive(Default)]
struct Memory {
    recursions: Recursions,
    expectations: Vec<Expectation>,
}

/// So many demonstrations, in words.
pub(super) fn demonstrations(count: usize) -> String {
    if count == 1 { "1 demonstration".to_owned() } else { format!("{count} demonstrations") }
}

/// Standardised data with everything the iterations need.
pub(super) struct Problem<'a> {
    pub(super) settings: &'a PhmmSettings,
    pub(super) scaling: Standardisation,
    pub(super) sequences: Vec<Sequence>,
    pub(super) samples: usize,
    /// Features of every sequence, in user units.
    pub(super) phis: Vec<DVector<f64>>,
    /// Asked before every iteration. What a climb that may not go on has reached is no result: whoever started it asks again.
    pub(super) may_go_on: MayGoOn<'a>,
}

impl<'a> Problem<'a> {
    pub(super) fn new(sequences: &[Sequence], settings: &'a PhmmSettings, may_go_on: MayGoOn<'a>) -> Result<Self, LearningError> {
        let Some(first) = sequences.first() else { return Err(LearningError::Data("no demonstration".to_owned())) };
        let (d, p) = (first.dimension, first.theta.len());
        if let Some(k) = sequences.iter().position(|s| s.dimension != d || s.theta.len() != p || s.samples() == 0) {
            return Err(LearningError::Data(format!("sequence {k} is empty or differs from the first in columns or parameters")));
        }
        let samples = sequences.iter().map(Sequence::samples).sum();
        if samples < settings.states {
            let (k, n) = (sequences.len(), settings.states);
            let found = format!("{} with {samples} samples cannot support {n} states", demonstrations(k));
            return Err(LearningError::Data(format!("{found}; use fewer states, a higher learning rate, or show more demonstrations")));
        }
        for (k, sequence) in sequences.iter().enumerate() {
            let numbers = sequence.values.iter().chain(sequence.theta.iter());
            if let Some(at) = numbers.copied().position(|x| !x.is_finite()) {
                let (t, c) = (at / d, at % d);
                let place = if t < sequence.samples() { format!("sample {t}, variable {c}") } else { "a parameter".to_owned() };
                return Err(LearningError::Data(format!("sequence {k}, {place}: not a finite number")));
            }
        }
        let scaling = Standardisation::of(sequences, &settings.scale_factors);
        let phis = sequences.iter().map(|s| s.theta.clone()).collect();
        let sequences = sequences.iter().map(|s| scaling.sequence(s)).collect();
        Ok(Self { settings, scaling, sequences, samples, phis, may_go_on })
    }

    /// The prior is worth `ridge` demonstrations, spread over the states: it does not depend on the rate of sampling.
    pub(super) fn penalty(&self, parametric: bool) -> Penalty {
        let samples_per_visit = self.samples as f64 / (self.sequences.len() * self.settings.states) as f64;
        Penalty {
            ridge: self.settings.ridge * samples_per_visit,
            floor: self.settings.covariance_floor,
            weights_on_phase: self.settings.weights_on_phase,
            parametric,
            fixed_covariance: parametric && self.settings.covariance == CovarianceMode::Fixed,
        }
    }

    /// What rounding may take from the objective, as a fraction of its scale: a covariance keeps its smallest eigenvalue to
    /// `epsilon / floor` only.
    fn rounding(&self) -> f64 {
        ROUNDING.max(8.0 * f64::EPSILON / self.settings.covariance_floor.max(LEAST_FLOOR))
    }

    /// Expectation and maximisation until the objective stands still.
    pub(super) fn climb(&self, first: Phmm, parametric: bool, most_iterations: usize) -> Run {
        let penalty = self.penalty(parametric);
        let (mut model, mut history, mut status) = (first, Vec::new(), FitStatus::IterationLimit);
        let (mut kept, mut memory) = (model.clone(), Memory::default());
        for iteration in 0..=most_iterations {
            if !(self.may_go_on)() {
                break;
            }
            let Some(objective) = self.expect(&model, &penalty, &mut memory).filter(|o| o.is_finite()) else {
                (model, status) = (kept, FitStatus::Degenerate);
                break;
            };
            let rise = objective - history.last().copied().unwrap_or(f64::NEG_INFINITY);
            if rise < -self.rounding() * (objective.abs() + self.samples as f64) {
                (model, status) = (kept, FitStatus::Fell);
                break;
            }
            history.push(objective);
            if self.settings.tolerance > 0.0 && rise < self.settings.tolerance * objective.abs() {
                status = FitStatus::Converged;
                break;
            }
            if iteration < most_iterations {
                kept = model.clone();
                model = self.maximised(&model, &memory.expectations, &penalty);
            }
        }
        Run { model, history, status }
    }

    /// The expectation step of every sequence, for the parametric model. `None` when a covariance is not positive definite.
    pub(super) fn expectations(&self, model: &Phmm) -> Option<Vec<Expectation>> {
        let mut memory = Memory::default();
        self.expect(model, &self.penalty(true), &mut memory).map(|_| memory.expectations)
    }

    /// The objective; the expectations are left in the memory.
    fn expect(&self, model: &Phmm, penalty: &Penalty, memory: &mut Memory) -> Option<f64> {
        memory.recursions.set(&model.initial, &model.transition);
        memory.expectations.resize(self.sequences.len(), Expectation::default());
        let mut objective = 0.0;
        for (w, c) in model.weights.iter().zip(&model.covariances) {
            objective += penalty.log_prior(w, c)?;
        }
        for (sequence, expectation) in self.sequences.iter().zip(&mut memory.expectations) {
            if !memory.recursions.expect(model, sequence, expectation) {
                return None;
            }
            objective += expectation.log_likelihood;
        }
        Some(objective)
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
}
