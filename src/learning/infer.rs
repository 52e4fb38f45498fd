//! Which parameters a movement is performed under, from its first part alone: expectation maximisation at test time (Wilson and Bobick,
//! "Parametric Hidden Markov Models for Gesture Recognition", 1999).
//!
//! The forcing target (4) of a partial movement depends on the goal, and the goal on `theta`; both are affine in `phi(theta)`:
//!
//! ```text
//! f_t = a_t + (s_t - 1) g,   a_t = x - x0 s + xddot / omega^2 + 2 xdot / omega,   g = G phi + g0
//! E: gamma_t(i) at the present theta
//! M: min over theta of  sum_i ebar_i^T V_i^-1 ebar_i + (theta - m)^T R^-2 (theta - m)
//!    ebar_i: mean of f_t - E[f | phase_t, theta, state i] over the samples of state i
//!    V_i = 2 (1 + r_i) B_i + C_i (1 / n_i + z_i^2)
//! ```
//!
//! What demonstrations disagree about is shared by all samples of one visit to a state, so a visit counts once: `B_i` is the covariance
//! between demonstrations, corrected for the parameters that were fitted, `r_i` the doubt about the state's mean. Neighbouring states
//! share their deviation (a way-point that was missed bends the path before and after it), hence the 2. `C_i / n_i` is what is left of
//! the samples' own scatter; most of that is curvature, which cancels over a whole visit but not over the part of one: `z_i`, the
//! observed phase's distance from the state's mean in standard deviations, says how partial it is. That makes the reported covariance
//! honest; counting samples would make it a hundred times too small. The prior is the demonstrated range: its middle `m` and its width `R`. The M step is closed for linear features and one guarded
//! Gauss-Newton step for others.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::cpdmp::{MotionModel, Shaping};
use super::dmp::forcing_target;
use super::phmm::{Phmm, Sequence, expect};
use super::{Gmr, LearningError, SettingFault, Skill};
use crate::demonstration::Trajectory;
use crate::math::SmoothingDerivative;

/// How parameters are inferred.
#[derive(Debug, Clone, PartialEq)]
pub struct InferenceSettings {
    /// How long the whole movement will take (s, > 0); `None`: as long as the demonstrations.
    pub duration_s: Option<f64>,
    /// Rate at which the model sees the movement (Hz, 0.1 to 1000): that of learning. Default 25.
    pub rate_hz: f64,
    /// Width of the window that differentiates the movement (s, 0.001 to 60). Default 0.5, as in learning.
    pub smoothing_window_s: f64,
    /// Degree of the polynomials in that window (2 to 6). Default 4.
    pub smoothing_degree: usize,
}

impl Default for InferenceSettings {
    fn default() -> Self {
        Self { duration_s: None, rate_hz: 25.0, smoothing_window_s: 0.5, smoothing_degree: 4 }
    }
}

/// How an inference ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InferenceStatus {
    /// The parameters stand still.
    Converged,
    /// All iterations were used.
    IterationLimit,
    /// The skill has no parameter that its demonstrations varied.
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
/// Fewer expected samples in a state are no observation of it.
const LEAST_COUNT: f64 = 0.5;
/// A deviation from the demonstrations lasts about this many states.
const STATES_PER_DEVIATION: f64 = 2.0;
/// How often a Gauss-Newton step that makes things worse is halved.
const MOST_HALVINGS: usize = 20;

/// Infers `theta_m` from the first part of a movement, which starts where and when `observed` does.
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
    let prior = Prior::of(&motion.parameters.ranges);
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

impl InferenceSettings {
    fn check(&self) -> Result<(), LearningError> {
        let mut faults = Vec::new();
        let mut check = |name: &str, value: f64, from: f64, to: f64, unit: &str| {
            faults.extend(SettingFault::outside(name, value, from, to, unit));
        };
        check("duration_s", self.duration_s.unwrap_or(1.0), 1e-3, 1e6, "s");
        check("rate_hz", self.rate_hz, 0.1, 1000.0, "Hz");
        check("smoothing_window_s", self.smoothing_window_s, 0.001, 60.0, "s");
        check("smoothing_degree", self.smoothing_degree as f64, 2.0, 6.0, "");
        if faults.is_empty() { Ok(()) } else { Err(LearningError::Settings(faults)) }
    }
}

/// The observed part: phase inputs, phases and the forcing targets for a goal at the origin.
struct Part {
    inputs: Vec<f64>,
    phases: Vec<f64>,
    targets: Vec<DVector<f64>>,
}

impl Part {
    fn of(motion: &MotionModel, observed: &Trajectory, settings: &InferenceSettings) -> Result<Self, LearningError> {
        let duration = settings.duration_s.unwrap_or(motion.duration_s);
        let seen = observed.duration_s();
        if seen > duration * (1.0 + 1e-6) {
            let hint = "observe less, or say how long the movement takes";
            return Err(LearningError::Request(format!("{seen:.3} s are observed, but the movement lasts {duration:.3} s: {hint}")));
        }
        // Differentiated at the rate it was recorded at, then thinned out to the rate of learning.
        let recorded = (observed.samples() - 1) as f64 / seen;
        let thinning = (recorded / settings.rate_hz).round().max(1.0);
        let uniform = observed.resampled(settings.rate_hz * thinning)?;
        let (samples, step) = (uniform.samples(), uniform.duration_s() / (uniform.samples() - 1) as f64);
        let wanted = ((settings.smoothing_window_s / step / 2.0).round() as usize) * 2 + 1;
        let window = wanted.max((settings.smoothing_degree + 2) | 1);
        // The last half window is left out: derivatives at an open end are many times noisier.
        let last = samples.saturating_sub(window / 2 + 1);
        if samples < window || last == 0 {
            let least = window as f64 * step;
            return Err(LearningError::Request(format!("{seen:.3} s are observed, but inference needs at least {least:.3} s")));
        }
        let filter = SmoothingDerivative::new(step, window, settings.smoothing_degree)?;
        let omega = motion.stiffness.sqrt() / duration;
        let positions = uniform.select(&motion.columns)?;
        let columns = positions.column_iter().map(|column| filter.apply(column.into_owned().as_slice()));
        let smooth = columns.collect::<Result<Vec<_>, _>>()?;
        let mut part = Self { inputs: Vec::new(), phases: Vec::new(), targets: Vec::new() };
        for t in (0..=last).step_by(thinning as usize) {
            let u = t as f64 * step / duration;
            let phase = (-motion.alpha * u).exp();
            let target = smooth.iter().map(|c| forcing_target([c.value[t], c.first[t], c.second[t]], c.value[0], 0.0, phase, omega));
            part.inputs.push(motion.phase_input.at(u, motion.alpha));
            part.phases.push(phase);
            part.targets.push(DVector::from_iterator(smooth.len(), target));
        }
        Ok(part)
    }
}

/// The demonstrated range of every parameter.
struct Prior {
    mean: DVector<f64>,
    /// One over the width (p); 0 where no range is known.
    inverse_width: DVector<f64>,
    /// Parameters that varied.
    active: Vec<usize>,
}

impl Prior {
    fn of(ranges: &[[f64; 2]]) -> Self {
        let p = ranges.len();
        let known = |j: usize| (ranges[j][1] - ranges[j][0]).is_finite();
        let mean = DVector::from_fn(p, |j, _| if known(j) { 0.5 * (ranges[j][0] + ranges[j][1]) } else { 0.0 });
        let active = (0..p).filter(|j| !known(*j) || ranges[*j][1] - ranges[*j][0] > 1e-9 * mean[*j].abs()).collect();
        let inverse_width = DVector::from_fn(p, |j, _| if known(j) { 1.0 / (ranges[j][1] - ranges[j][0]) } else { 0.0 });
        Self { mean, inverse_width, active }
    }

    /// The middle, then both ends of every range: bent features may have several optima.
    fn starts(&self) -> Vec<DVector<f64>> {
        let mut starts = vec![self.mean.clone()];
        for j in self.active.iter().filter(|j| self.inverse_width[**j] > 0.0) {
            for side in [-0.5, 0.5] {
                let mut start = self.mean.clone();
                start[*j] += side / self.inverse_width[*j];
                starts.push(start);
            }
        }
        starts
    }

    fn penalty(&self, theta: &DVector<f64>) -> f64 {
        self.active.iter().map(|j| ((theta[*j] - self.mean[*j]) * self.inverse_width[*j]).powi(2)).sum()
    }
}

/// One state's observation: its mean residual, how that moves with the features, and its precision.
struct Visit {
    residual: DVector<f64>,
    slope: DMatrix<f64>,
    precision: DMatrix<f64>,
}

struct Problem<'a> {
    skill: &'a Skill,
    motion: &'a MotionModel,
    phmm: &'a Phmm,
    part: Part,
    prior: Prior,
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

    /// The expectation step: what every visited state says at `theta`, and the log-likelihood.
    fn visits(&self, theta: &DVector<f64>) -> Result<(Vec<Visit>, f64), LearningError> {
        let (n, d) = (self.phmm.states(), self.motion.columns.len());
        let phi = self.motion.parameters.features.at(theta);
        let goal = self.motion.goal.at(&phi);
        let mut values = Vec::with_capacity(self.part.inputs.len() * (d + 1));
        for ((input, s), target) in self.part.inputs.iter().zip(&self.part.phases).zip(&self.part.targets) {
            values.push(*input);
            values.extend(target.iter().zip(goal.iter()).map(|(a, g)| a + (s - 1.0) * g));
        }
        let sequence = Sequence { values, dimension: d + 1, theta: phi };
        let degenerate = || LearningError::Model("a covariance is not positive definite".to_owned());
        let expectation = expect(self.phmm, &sequence).filter(|e| e.log_likelihood.is_finite()).ok_or_else(degenerate)?;
        let gmr = Gmr::new(&self.phmm.means, &self.phmm.covariances, 1)?;
        let mut visits = Vec::new();
        for i in 0..n {
            let (mut count, mut mean, mut phase) = (0.0, DVector::zeros(d + 1), 0.0);
            for t in 0..sequence.samples() {
                let g = expectation.responsibilities[t * n + i];
                count += g;
                phase += g * self.part.phases[t];
                for (m, x) in mean.iter_mut().zip(sequence.sample(t)) {
                    *m += g * x;
                }
            }
            if count >= LEAST_COUNT {
                visits.push(self.visit(i, count, &(mean / count), phase / count, &sequence.theta, &gmr).ok_or_else(degenerate)?);
            }
        }
        Ok((visits, expectation.log_likelihood))
    }

    fn visit(&self, state: usize, count: f64, mean: &DVector<f64>, phase: f64, phi: &DVector<f64>, gmr: &Gmr) -> Option<Visit> {
        let d = mean.len() - 1;
        let off = mean - self.phmm.mean_at(state, phi);
        let weights = &self.phmm.weights[state];
        let gain = gmr.gain(state);
        let slope = &self.motion.goal.weights * (phase - 1.0) - weights.rows(1, d) + gain * weights.rows(0, 1);
        let (doubt, correction) = self.motion.evidence.get(state).map_or((0.0, 1.0), |e| {
            let m = e.demonstrations;
            (e.ratio(phi), m / (m - 1.0 - phi.len() as f64).max(1.0))
        });
        let between = self.skill.compliance.between.get(state)?;
        let partial = off[0] * off[0] / self.phmm.covariances[state][(0, 0)];
        let repeated = between * (STATES_PER_DEVIATION * correction * (1.0 + doubt));
        let variance = repeated + gmr.conditional_covariance(state) * (1.0 / count + partial);
        let residual = off.rows(1, d) - gain * off.rows(0, 1);
        Some(Visit { residual: residual.column(0).into_owned(), slope, precision: Cholesky::new(variance)?.inverse() })
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
