//! What happened while a skill was learned, for people and for reports.

use nalgebra::DVector;

use super::cpdmp::{Shaping, Statistic, compliance_windows, segments};
use super::phmm::{Fit, FitStatus, StartReport};
use super::selection::Choices;
use super::{EndsReport, LearningError, Skill};

/// How one model was fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct FitReport {
    /// Log-likelihood in user units plus log prior, before each iteration and after the last.
    pub log_likelihood: Vec<f64>,
    /// How the chosen start ended.
    pub status: FitStatus,
    /// All starts.
    pub starts: Vec<StartReport>,
    /// Number of states.
    pub states: usize,
}

impl FitReport {
    pub(super) fn of(fit: &Fit) -> Self {
        Self { log_likelihood: fit.history.clone(), status: fit.status, starts: fit.starts.clone(), states: fit.model.states() }
    }
}

/// One state of the motion model, at the mean parameters of the demonstrations.
#[derive(Debug, Clone, PartialEq)]
pub struct StateReport {
    /// Its number, counted from 0.
    pub index: usize,
    /// Time fractions between which it is the most responsible state; `None` when it never is.
    pub active: Option<[f64; 2]>,
    /// Its mean: the phase input, then the forcing term per column.
    pub mean: Vec<f64>,
    /// The statistic that is held against the threshold (m^2).
    pub value_m2: f64,
    /// -1 when it complies, 0 when it is stiff.
    pub beta: f64,
}

/// How demonstrations were made ready for learning.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Preparation {
    /// Samples per second that the models learned from (Hz).
    pub rate_hz: f64,
    /// Shortest and longest window over which movements were smoothed and differentiated (s): at the rate at which each was recorded.
    pub window_s: [f64; 2],
    /// Degree of the polynomials in it.
    pub degree: usize,
}

/// What happened while a skill was learned.
#[derive(Debug, Clone, PartialEq)]
pub struct LearningReport {
    /// How the demonstrations were resampled and smoothed.
    pub preparation: Preparation,
    /// The motion model; `None` for the baseline.
    pub motion: Option<FitReport>,
    /// The force model, when there is one.
    pub force: Option<FitReport>,
    /// The motion model's states, in order.
    pub states: Vec<StateReport>,
    /// Which statistic decides about compliance.
    pub statistic: Statistic,
    /// `sigma` (m^2); infinite when no threshold separates the states.
    pub threshold_m2: f64,
    /// Windows in which the skill complies (s, start and end, at the learned duration and the mean parameters).
    pub windows_s: Vec<[f64; 2]>,
    /// Estimated variance of sensor noise in the forcing term, per motion column (squared unit of the column).
    pub forcing_noise: Vec<f64>,
    /// The largest shift in time of each demonstration by the alignment (s); empty without one.
    pub alignment_shifts_s: Vec<f64>,
    /// What the demonstrations chose of the motion model.
    pub motion_choices: Choices,
    /// What the demonstrations chose of the force model.
    pub force_choices: Choices,
    /// How the end that the parameters leave open is predicted, when the parameters are the start or the goal themselves.
    pub ends: Option<EndsReport>,
    /// What a person should know: rank, compliance of none or all, gaps.
    pub warnings: Vec<String>,
}

impl LearningReport {
    /// Reads the states and windows of a skill at parameters `theta` (p).
    pub(super) fn of(
        skill: &Skill,
        theta: &DVector<f64>,
        fits: [Option<&Fit>; 2],
        (preparation, forcing_noise): (Preparation, Vec<f64>),
        warnings: Vec<String>,
    ) -> Result<Self, LearningError> {
        let phi = skill.motion.parameters.features.at(theta);
        let mut shaping = skill.motion.shaping_at(theta)?;
        let segments = segments(&mut shaping);
        let duration = skill.motion.duration_s;
        let states = match &skill.motion.shaping {
            Shaping::Phmm(phmm) => (0..phmm.states())
                .map(|i| {
                    let mut active = segments.iter().filter(|s| s.state == i).peekable();
                    let start = active.peek().map(|s| s.start);
                    StateReport {
                        index: i,
                        active: start.zip(active.last()).map(|(start, last)| [start, last.end]),
                        mean: phmm.mean_at(i, &phi).iter().copied().collect(),
                        value_m2: skill.compliance.values_m2[i],
                        beta: skill.compliance.beta[i],
                    }
                })
                .collect(),
            Shaping::Lwr(_) => Vec::new(),
        };
        let windows = compliance_windows(&segments, &skill.compliance.beta);
        let [motion, force] = fits.map(|fit| fit.map(FitReport::of));
        Ok(Self {
            preparation,
            motion,
            force,
            states,
            statistic: skill.compliance.statistic,
            threshold_m2: skill.compliance.threshold_m2,
            windows_s: windows.iter().map(|w| [w.start * duration, w.end * duration]).collect(),
            forcing_noise,
            alignment_shifts_s: Vec::new(),
            motion_choices: Choices::default(),
            force_choices: Choices::default(),
            ends: None,
            warnings,
        })
    }
}
