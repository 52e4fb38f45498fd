//! How far what is asked of a skill lies outside what was demonstrated.

use crate::learning::{ExecutionSettings, FeatureMap, LearningError, ParameterSpace, Request, Skill};

/// How far outside a request is.
pub(super) struct Outside {
    /// Of the motion's parameters, as a fraction of their range (-).
    pub motion: f64,
    /// Of the force's, when a wrench is asked for (-).
    pub force: Option<f64>,
    /// Variance for want of demonstrations over the variance that they show (-); none for the baseline.
    pub uncertainty: Option<f64>,
    /// Whether the worst of the motion, of the force, is a combination rather than a value.
    combined: [bool; 2],
}

impl Outside {
    /// Of what is asked of `skill`.
    pub fn of(skill: &Skill, asked: &Request, settings: &ExecutionSettings) -> Result<Self, LearningError> {
        let of = |space: &ParameterSpace, theta| {
            let (all, combined) = (space.extrapolation(theta), space.combined_extrapolation(theta));
            (all, combined > 0.0 && combined >= all)
        };
        let (motion, motion_combined) = of(&skill.motion.parameters, &asked.theta);
        let force = match &skill.force {
            Some(model) => Some(of(&model.parameters, &model.parameters.resolve(&settings.theta_f)?)),
            None => None,
        };
        let combined = [motion_combined, force.is_some_and(|(_, combined)| combined)];
        Ok(Self { motion, force: force.map(|(ratio, _)| ratio), uncertainty: skill.motion.extrapolation_ratio(&asked.theta)?, combined })
    }

    /// The larger of the two.
    pub fn worst(&self) -> f64 {
        self.motion.max(self.force.unwrap_or(0.0))
    }

    /// What a person should know about it.
    pub fn warnings(&self) -> Vec<String> {
        let guessed = self.uncertainty.filter(|ratio| *ratio > 1.0 && self.motion > 0.0);
        let guessed = guessed.map_or_else(String::new, |ratio| {
            format!("; its uncertainty for want of demonstrations is {} times the spread that they show", short(ratio.sqrt()))
        });
        let motion = (self.motion > 0.0).then(|| beyond("parameter", self.motion, self.combined[0]) + &guessed);
        let force = self.force.filter(|ratio| *ratio > 0.0).map(|ratio| beyond("parameter of the force", ratio, self.combined[1]));
        motion.into_iter().chain(force).collect()
    }

    /// Bumps vanish far from the demonstrations, and what is unknown there does not show in the covariance.
    pub fn of_bumps(&self, skill: &Skill, covariance: bool) -> Option<String> {
        let bumps = matches!(skill.motion.parameters.features, FeatureMap::Rbf { .. });
        (bumps && covariance && self.motion > 0.0)
            .then(|| "std_… stands still where the bumps (rbf) have vanished: out there it says nothing about the movement".to_owned())
    }
}

fn beyond(what: &str, ratio: f64, combined: bool) -> String {
    match (ratio.is_finite(), combined) {
        (true, false) => format!("a {what} lies outside what was demonstrated, by {} of its range", short(ratio)),
        (false, false) => format!("a {what} lies outside what was demonstrated, where it never varied"),
        (true, true) => format!("a {what} is combined with others as was not demonstrated, by {} of what they vary together", short(ratio)),
        (false, true) => format!("a {what} is combined with others as was not demonstrated, where they always changed together"),
    }
}

fn short(ratio: f64) -> String {
    if ratio < 1e4 { format!("{ratio:.2}") } else { format!("{ratio:.1e}") }
}
