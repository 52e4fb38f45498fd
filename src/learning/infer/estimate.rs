//! Expectation and maximisation until the parameters stand still.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::InferenceSettings;
use super::observation::Visit;
use super::observed_part::Part;
use super::prior::Prior;
use crate::demonstration::{ParameterSource, Trajectory};
use crate::learning::cpdmp::{MotionModel, Shaping};
use crate::learning::phmm::Phmm;
use crate::learning::{LearningError, Skill, parameter_selection};

/// How an inference ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InferenceStatus {
    /// The parameters stand still.
    Converged,
    /// All iterations were used.
    IterationLimit,
    /// The skill has no parameter that its demonstrations varied, or its parameters are the start, which is seen.
    NothingToInfer,
}

/// Parameters inferred from a part of a movement.
#[derive(Debug, Clone, PartialEq)]
pub struct Inference {
    /// Names and values (p), ready for a request to the skill.
    pub theta: Vec<(String, f64)>,
    /// Their covariance (p x p; squared units): as wide as the demonstrated range in directions the movement does not show yet, 0 for
    /// parameters that never varied.
    pub covariance: DMatrix<f64>,
    /// Log-likelihood of the observed part at these parameters.
    pub log_likelihood: f64,
    /// Iterations of expectation and maximisation, of the start that was best.
    pub iterations: usize,
    /// How it ended.
    pub status: InferenceStatus,
}

/// Most iterations from one start.
const MOST_ITERATIONS: usize = 100;
/// Parameters stand still when they move by less than this fraction of their range (-).
const STILL: f64 = 1e-6;
/// How often a Gauss-Newton step that makes things worse is halved.
const MOST_HALVINGS: usize = 20;

/// Infers `theta_m` from the first part of a movement, which starts where and when `observed` does. Parameters that are the start itself are
/// read off it.
///
/// # Errors
/// When settings are outside their ranges, the skill has no parametric model, the part is too short to be differentiated or longer than
/// the movement, a column is missing, or neither movement nor demonstrated ranges determine the parameters.
pub fn infer(skill: &Skill, observed: &Trajectory, settings: &InferenceSettings) -> Result<Inference, LearningError> {
    let motion = &skill.motion;
    let Shaping::Phmm(phmm) = &motion.shaping else {
        return Err(LearningError::Request("the skill is blind to parameters (locally weighted regression): nothing to infer".to_owned()));
    };
    settings.check()?;
    let part = Part::of(motion, observed, settings)?;
    let prior = match skill.parameter_source {
        ParameterSource::Start => Prior::certain(first_sample(skill, observed)?),
        _ => Prior::of(&motion.parameters.ranges),
    };
    let problem = Problem { skill, motion, phmm, part, prior };
    let mut best: Option<Inference> = None;
    for start in problem.prior.starts() {
        let found = problem.climb(start)?;
        if best.as_ref().is_none_or(|b| found.log_likelihood > b.log_likelihood) {
            best = Some(found);
        }
    }
    best.ok_or_else(|| LearningError::Model("the likelihood is not finite at any parameter".to_owned()))
}

/// The parameters (p) that are the start itself, which is seen.
fn first_sample(skill: &Skill, observed: &Trajectory) -> Result<DVector<f64>, LearningError> {
    let (columns, names) = (&skill.motion.columns, &skill.motion.parameters.names);
    let start = observed.select(columns)?.row(0).transpose();
    Ok(parameter_selection(skill.parameter_source, names, columns)? * start)
}

/// A skill and what was seen.
pub(super) struct Problem<'a> {
    pub(super) skill: &'a Skill,
    pub(super) motion: &'a MotionModel,
    pub(super) phmm: &'a Phmm,
    pub(super) part: Part,
    pub(super) prior: Prior,
}

impl Problem<'_> {
    fn climb(&self, mut theta: DVector<f64>) -> Result<Inference, LearningError> {
        let active = &self.prior.active;
        let mut status = if active.is_empty() { InferenceStatus::NothingToInfer } else { InferenceStatus::IterationLimit };
        let mut iterations = 0;
        let most = if active.is_empty() { 0 } else { MOST_ITERATIONS };
        while iterations < most {
            let (visits, _) = self.visits(&theta)?;
            let (hessian, gradient) = self.normal_equations(&theta, &visits);
            let factor = Cholesky::new(hessian).ok_or_else(undetermined)?;
            let step = self.guarded(&theta, &visits, -factor.solve(&gradient));
            iterations += 1;
            let scale =
                |j: usize| if self.prior.inverse_width[j] > 0.0 { self.prior.inverse_width[j] } else { 1.0 / theta[j].abs().max(1.0) };
            let moved = active.iter().zip(step.iter()).fold(0.0, |m: f64, (j, s)| m.max(s.abs() * scale(*j)));
            for (j, s) in active.iter().zip(step.iter()) {
                theta[*j] += s;
            }
            if moved < STILL {
                status = InferenceStatus::Converged;
                break;
            }
        }
        let (visits, log_likelihood) = self.visits(&theta)?;
        let mut covariance = DMatrix::zeros(theta.len(), theta.len());
        if !active.is_empty() {
            let inverse = Cholesky::new(self.normal_equations(&theta, &visits).0).ok_or_else(undetermined)?.inverse();
            for (a, j) in active.iter().enumerate() {
                for (b, k) in active.iter().enumerate() {
                    covariance[(*j, *k)] = inverse[(a, b)];
                }
            }
        }
        let theta = self.motion.parameters.names.iter().cloned().zip(theta.iter().copied()).collect();
        Ok(Inference { theta, covariance, log_likelihood, iterations, status })
    }

    /// Hessian and gradient, halved, over the parameters that varied.
    fn normal_equations(&self, theta: &DVector<f64>, visits: &[Visit]) -> (DMatrix<f64>, DVector<f64>) {
        let active = &self.prior.active;
        let jacobian = self.motion.parameters.features.jacobian(theta).select_columns(active);
        let precision = DVector::from_iterator(active.len(), active.iter().map(|j| self.prior.inverse_width[*j].powi(2)));
        let off = DVector::from_iterator(active.len(), active.iter().map(|j| theta[*j] - self.prior.mean[*j]));
        let (mut hessian, mut gradient) = (DMatrix::from_diagonal(&precision), precision.component_mul(&off));
        for visit in visits {
            let slope = &visit.slope * &jacobian;
            let weighted = slope.transpose() * &visit.precision;
            hessian += &weighted * &slope;
            gradient += weighted * &visit.residual;
        }
        ((&hessian + hessian.transpose()) * 0.5, gradient)
    }

    /// The step, halved until the objective for the present responsibilities does not rise.
    fn guarded(&self, theta: &DVector<f64>, visits: &[Visit], mut step: DVector<f64>) -> DVector<f64> {
        let features = &self.motion.parameters.features;
        let phi = features.at(theta);
        let objective = |theta: &DVector<f64>| {
            let moved = features.at(theta) - &phi;
            let misfit = |visit: &Visit| {
                let e = &visit.residual + &visit.slope * &moved;
                e.dot(&(&visit.precision * &e))
            };
            visits.iter().map(misfit).sum::<f64>() + self.prior.penalty(theta)
        };
        let before = objective(theta);
        for _ in 0..MOST_HALVINGS {
            let mut next = theta.clone();
            for (j, s) in self.prior.active.iter().zip(step.iter()) {
                next[*j] += s;
            }
            if objective(&next) <= before {
                return step;
            }
            step *= 0.5;
        }
        step * 0.0
    }
}

fn undetermined() -> LearningError {
    LearningError::Request("neither the observed part nor the skill's parameter ranges determine the parameters: observe more".to_owned())
}
