//! Every demonstration predicted by a skill that was learned without it.

use rayon::prelude::*;

use super::super::{ExecutionSettings, LearningError, LearningSettings, ShapingKind, Skill, learn};
use super::folds::{folds_of, split};
use super::reproduction::{Reproduction, reproduction, with_ends, with_parameters};
use super::{MovementError, Selection, StatesCriterion};
use crate::demonstration::{Dataset, Demonstration};

/// One demonstration, predicted by a skill that was learned without it and without all others of the same parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldOut {
    /// The demonstration's name.
    pub demonstration: String,
    /// The group that was left out with it, counted from 0.
    pub fold: usize,
    /// How far its parameters lie outside those that were learned from, as a fraction of their range (-).
    pub extrapolation: f64,
    /// The error with the demonstration's start and goal given beside its parameters.
    pub with_ends: MovementError,
    /// The error when only its parameters are given: start and goal are predicted too.
    pub parameters_alone: MovementError,
    /// The error of the baseline, LWR-DMP, learned from the same demonstrations, with the start and goal given.
    pub lwr: MovementError,
}

/// The outcome of a cross-validation. Nothing in it comes from the noise of one lucky split: every demonstration is predicted once.
#[derive(Debug, Clone, PartialEq)]
pub struct CrossValidation {
    /// How many groups were left out in turn.
    pub folds: usize,
    /// Every demonstration, in the dataset's order.
    pub held_out: Vec<HeldOut>,
    /// The error of repeating the demonstrations that were learned from, by the skill learned from all of them.
    pub training: Vec<Reproduction>,
}

impl CrossValidation {
    /// Mean root mean square and largest error over all demonstrations, with their start and goal given.
    #[must_use]
    pub fn with_ends(&self) -> Option<MovementError> {
        self.over(|h| &h.with_ends)
    }

    /// The same from the parameters alone.
    #[must_use]
    pub fn parameters_alone(&self) -> Option<MovementError> {
        self.over(|h| &h.parameters_alone)
    }

    /// The same of the baseline, with start and goal given.
    #[must_use]
    pub fn lwr(&self) -> Option<MovementError> {
        self.over(|h| &h.lwr)
    }

    /// The same of the demonstrations that were learned from.
    #[must_use]
    pub fn training(&self) -> Option<MovementError> {
        MovementError::over(&self.training.iter().map(|r| &r.error).collect::<Vec<_>>())
    }

    fn over(&self, of: fn(&HeldOut) -> &MovementError) -> Option<MovementError> {
        MovementError::over(&self.held_out.iter().map(of).collect::<Vec<_>>())
    }
}

/// Learns once without each distinct value of `theta_m` (without each demonstration, when there is only one value) and predicts what was
/// left out. Everything that settings leave to the data is chosen anew without what was left out. The same dataset, settings and seed give
/// the same bits, on any number of threads.
///
/// # Errors
/// When there are fewer than two demonstrations, or one of the splits cannot be learned from.
pub fn cross_validate(dataset: &Dataset, settings: &LearningSettings, seed: u64) -> Result<CrossValidation, LearningError> {
    dataset.check()?;
    let groups = folds_of(dataset)?;
    let chosen = |selection: Selection| selection.states.is_some_and(|search| search.criterion == StatesCriterion::CrossValidation);
    if groups.len() < 3 && (chosen(settings.motion_selection) || chosen(settings.force_selection)) {
        let why = "leaving one out, of two, leaves one to choose the number of states by, and that needs two: show more or set the states";
        return Err(LearningError::Data(why.to_owned()));
    }
    let training = reproduction(dataset, &learn(dataset, settings, seed)?.skill)?;
    let parts = groups.par_iter().enumerate().map(|(fold, group)| {
        let (rest, left_out) = split(dataset, group);
        let skill = learn(&rest, settings, seed)?.skill;
        let lwr = learn(&rest, &LearningSettings { shaping: ShapingKind::Lwr, ..settings.clone() }, seed)?.skill;
        let one = |demonstration: &Demonstration| held_out(demonstration, fold, &skill, &lwr);
        left_out.demonstrations.iter().map(one).collect::<Result<Vec<_>, LearningError>>()
    });
    let parts: Vec<Vec<HeldOut>> = parts.collect::<Result<_, _>>()?;
    let mut held_out: Vec<(usize, HeldOut)> = groups.iter().flatten().copied().zip(parts.into_iter().flatten()).collect();
    held_out.sort_by_key(|(k, _)| *k);
    Ok(CrossValidation { folds: groups.len(), held_out: held_out.into_iter().map(|(_, h)| h).collect(), training })
}

fn held_out(demonstration: &Demonstration, fold: usize, skill: &Skill, lwr: &Skill) -> Result<HeldOut, LearningError> {
    let error = |skill: &Skill, settings: &ExecutionSettings| MovementError::of(skill, settings, &demonstration.trajectory);
    Ok(HeldOut {
        demonstration: demonstration.name.clone(),
        fold,
        extrapolation: skill.extrapolation(&demonstration.theta_m)?,
        with_ends: error(skill, &with_ends(demonstration, skill)?)?,
        parameters_alone: error(skill, &with_parameters(demonstration, skill))?,
        lwr: error(lwr, &with_ends(demonstration, lwr)?)?,
    })
}
