//! Every demonstration predicted by a skill that was learned without it.

use rayon::prelude::*;

use super::super::{ExecutionSettings, LearningError, LearningSettings, ShapingKind, Skill, learn};
use super::folds::{Folds, split};
use super::reproduction::{Reproduction, reproduction, with_ends, with_parameters};
use super::{ErrorSize, MovementError, Selection, StatesCriterion, wrench_error, wrench_error_over};
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
    /// The wrench, when there is a force model; the baseline has none.
    pub force: Option<HeldOutForce>,
}

/// The wrench of one demonstration, predicted by a skill that was learned without it and without all others of the same parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldOutForce {
    /// The group that was left out with it, counted from 0.
    pub fold: usize,
    /// How far its `theta_f` lies outside what was learned from, as a fraction of the range (-).
    pub extrapolation: f64,
    /// The error of the expected wrench, per column of the force model (w; unit of the column).
    pub wrench: Vec<ErrorSize>,
}

/// The outcome of a cross-validation. Nothing in it comes from the noise of one lucky split: every demonstration is predicted once.
#[derive(Debug, Clone, PartialEq)]
pub struct CrossValidation {
    /// How many groups were left out in turn.
    pub folds: usize,
    /// How many groups were left out in turn to predict the wrench.
    pub force_folds: usize,
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

    /// Mean root mean square and largest error of the expected wrench over all demonstrations, per column of the force model; none without
    /// one.
    #[must_use]
    pub fn wrench(&self) -> Vec<ErrorSize> {
        wrench_error_over(&self.held_out.iter().filter_map(|h| Some(h.force.as_ref()?.wrench.as_slice())).collect::<Vec<_>>())
    }

    fn over(&self, of: fn(&HeldOut) -> &MovementError) -> Option<MovementError> {
        MovementError::over(&self.held_out.iter().map(of).collect::<Vec<_>>())
    }
}

/// Learns once without each distinct value of `theta_m` and predicts the movements that were left out. When all demonstrations share
/// `theta_m`, those of one `theta_f` are left out together, and when they share that too, each alone. Wrenches are predicted by skills that
/// were learned without their `theta_f`, when that varies, and by the same skills as movements otherwise. Everything that settings leave to
/// the data is chosen anew without what was left out. The same dataset, settings and seed give the same bits, on any number of threads.
///
/// # Errors
/// When there are fewer than two demonstrations, or one of the splits cannot be learned from.
pub fn cross_validate(dataset: &Dataset, settings: &LearningSettings, seed: u64) -> Result<CrossValidation, LearningError> {
    dataset.check()?;
    let folds = Folds::of(dataset)?;
    check_rest(dataset, settings, &folds)?;
    let whole = learn(dataset, settings, seed)?.skill;
    let training = reproduction(dataset, &whole)?;
    let baseline = LearningSettings { shaping: ShapingKind::Lwr, ..settings.clone() };
    let without = |rest: &Dataset| Ok(learn(rest, settings, seed)?.skill);
    let both = |rest: &Dataset| Ok((without(rest)?, learn(rest, &baseline, seed)?.skill));
    let mut held_out = predicted(dataset, &folds.motion, both, held_out)?;
    if whole.force.is_some() && folds.force != folds.motion {
        for (held, force) in held_out.iter_mut().zip(predicted(dataset, &folds.force, without, held_out_force)?) {
            held.force = force;
        }
    }
    Ok(CrossValidation { folds: folds.motion.len(), force_folds: folds.force.len(), held_out, training })
}

/// What is left must be enough to choose by leaving out again.
fn check_rest(dataset: &Dataset, settings: &LearningSettings, folds: &Folds) -> Result<(), LearningError> {
    let chosen = |selection: Selection| selection.states.is_some_and(|search| search.criterion == StatesCriterion::CrossValidation);
    let few = |group: &Vec<usize>| dataset.demonstrations.len() - group.len() < 2;
    if (chosen(settings.motion_selection) || chosen(settings.force_selection)) && folds.motion.iter().chain(&folds.force).any(few) {
        let why = "leaving one out, of two, leaves one to choose the number of states by, and that needs two: show more or set the states";
        return Err(LearningError::Data(why.to_owned()));
    }
    Ok(())
}

/// What `judge` says of every demonstration and of what was `learned` without its group, in the dataset's order.
fn predicted<S, T: Send>(
    dataset: &Dataset,
    groups: &[Vec<usize>],
    learned: impl Fn(&Dataset) -> Result<S, LearningError> + Sync,
    judge: impl Fn(&Demonstration, usize, &S) -> Result<T, LearningError> + Sync,
) -> Result<Vec<T>, LearningError> {
    let parts = groups.par_iter().enumerate().map(|(fold, group)| {
        let (rest, left_out) = split(dataset, group);
        let learned = learned(&rest)?;
        left_out.demonstrations.iter().map(|demonstration| judge(demonstration, fold, &learned)).collect::<Result<Vec<T>, LearningError>>()
    });
    let parts: Vec<Vec<T>> = parts.collect::<Result<_, _>>()?;
    let mut judged: Vec<(usize, T)> = groups.iter().flatten().copied().zip(parts.into_iter().flatten()).collect();
    judged.sort_by_key(|(k, _)| *k);
    Ok(judged.into_iter().map(|(_, one)| one).collect())
}

fn held_out(demonstration: &Demonstration, fold: usize, (skill, lwr): &(Skill, Skill)) -> Result<HeldOut, LearningError> {
    let error = |skill: &Skill, settings: &ExecutionSettings| MovementError::of(skill, settings, &demonstration.trajectory);
    Ok(HeldOut {
        demonstration: demonstration.name.clone(),
        fold,
        extrapolation: skill.extrapolation(&demonstration.theta_m)?,
        with_ends: error(skill, &with_ends(demonstration, skill)?)?,
        parameters_alone: error(skill, &with_parameters(demonstration, skill))?,
        lwr: error(lwr, &with_ends(demonstration, lwr)?)?,
        force: held_out_force(demonstration, fold, skill)?,
    })
}

fn held_out_force(demonstration: &Demonstration, fold: usize, skill: &Skill) -> Result<Option<HeldOutForce>, LearningError> {
    let Some(force) = &skill.force else { return Ok(None) };
    let theta = force.parameters.resolve(&demonstration.theta_f)?;
    let extrapolation = force.parameters.extrapolation(&theta);
    Ok(Some(HeldOutForce { fold, extrapolation, wrench: wrench_error(skill, demonstration)? }))
}
