//! How far what is asked of a skill lies outside what was demonstrated.

use nalgebra::DVector;

use crate::learning::{ExecutionSettings, LearningError, ParameterSpace, Request, Skill};

/// How far outside parameters are, as fractions of ranges (-).
#[derive(Clone, Copy)]
struct Beyond {
    /// The worst of them by itself.
    single: f64,
    /// The worst of their combinations.
    combined: f64,
}

/// How far outside a request is.
pub(super) struct Outside {
    motion: Beyond,
    /// When a wrench is asked for.
    force: Option<Beyond>,
    /// Variance for want of demonstrations over the variance that they show (-); none for the baseline.
    pub uncertainty: Option<f64>,
}

impl Outside {
    /// Of what is asked of `skill`.
    pub fn of(skill: &Skill, asked: &Request, settings: &ExecutionSettings) -> Result<Self, LearningError> {
        let motion = Beyond::of(&skill.motion.parameters, &asked.theta);
        let force = match &skill.force {
            Some(model) => Some(Beyond::of(&model.parameters, &model.parameters.resolve(&settings.theta_f)?)),
            None => None,
        };
        Ok(Self { motion, force, uncertainty: skill.motion.extrapolation_ratio(&asked.theta)? })
    }

    /// Of the motion's parameters.
    pub fn motion(&self) -> f64 {
        self.motion.worst()
    }

    /// Of the force's, when a wrench is asked for.
    pub fn force(&self) -> Option<f64> {
        self.force.map(Beyond::worst)
    }

    /// The larger of the two.
    pub fn worst(&self) -> f64 {
        self.motion().max(self.force().unwrap_or(0.0))
    }

    /// What a person should know about it.
    pub fn warnings(&self) -> Vec<String> {
        let guessed = self.uncertainty.filter(|ratio| *ratio > 1.0).map_or_else(String::new, |ratio| {
            format!("; its uncertainty for want of demonstrations is {} times the spread that they show", short(ratio.sqrt()))
        });
        let motion = self.motion.told("parameter").map(|told| told + &guessed);
        let force = self.force.and_then(|beyond| beyond.told("parameter of the force"));
        motion.into_iter().chain(force).collect()
    }
}

impl Beyond {
    fn of(space: &ParameterSpace, theta: &DVector<f64>) -> Self {
        Self { single: space.single_extrapolation(theta), combined: space.combined_extrapolation(theta) }
    }

    fn worst(self) -> f64 {
        self.single.max(self.combined)
    }

    /// The single value first: it is what a person sees at once. Nothing for what is inside.
    fn told(self, what: &str) -> Option<String> {
        let alone = match self.single {
            0.0 => None,
            ratio if ratio.is_finite() => Some(format!("a {what} lies outside what was demonstrated, by {} of its range", short(ratio))),
            _ => Some(format!("a {what} lies outside what was demonstrated, where it never varied")),
        };
        let combined = (self.combined > self.single)
            .then(|| format!("combined with others as was not demonstrated, by {} of what they vary together", short(self.combined)));
        match (alone, combined) {
            (Some(alone), Some(combined)) => Some(format!("{alone}, and is {combined}")),
            (None, Some(combined)) => Some(format!("a {what} is {combined}")),
            (alone, None) => alone,
        }
    }
}

fn short(ratio: f64) -> String {
    if ratio < 1e4 { format!("{ratio:.2}") } else { format!("{ratio:.1e}") }
}
