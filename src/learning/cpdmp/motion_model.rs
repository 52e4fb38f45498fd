//! Everything about a skill's movement that does not depend on the moment: the spring, the phase, the forcing term for any parameter.

use nalgebra::DVector;

use super::ShapingFunction;
use crate::learning::dmp::{Lwr, PhaseInput};
use crate::learning::phmm::{Phmm, StateEvidence};
use crate::learning::{Gmr, LearningError, LinearMap, ParameterSpace};

/// What stands for the forcing term.
#[derive(Debug, Clone, PartialEq)]
pub enum Shaping {
    /// A parametric hidden Markov model over the phase input and the forcing term.
    Phmm(Phmm),
    /// Locally weighted regression, blind to parameters.
    Lwr(Lwr),
}

impl Shaping {
    /// The parametric model, unless it is the baseline.
    #[must_use]
    pub fn phmm(&self) -> Option<&Phmm> {
        match self {
            Self::Phmm(phmm) => Some(phmm),
            Self::Lwr(_) => None,
        }
    }
}

/// The motion of a skill.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionModel {
    /// `K` (-).
    pub stiffness: f64,
    /// `tau`, the mean duration of the demonstrations (s).
    pub duration_s: f64,
    /// `alpha` (-).
    pub alpha: f64,
    /// What the model sees of the phase.
    pub phase_input: PhaseInput,
    /// Time fraction from which the net forcing fades out (-); not used by the baseline.
    pub gate_start: f64,
    /// Columns of the motion (d).
    pub columns: Vec<String>,
    /// Parameters `theta_m` (p).
    pub parameters: ParameterSpace,
    /// `x0(phi(theta_m))` (d; unit of the columns).
    pub start: LinearMap,
    /// `g(phi(theta_m))` (d; unit of the columns).
    pub goal: LinearMap,
    /// The forcing term.
    pub shaping: Shaping,
    /// How well the demonstrations determine each state's mean (N); empty for the baseline and in files that do not say.
    pub evidence: Vec<StateEvidence>,
}

impl MotionModel {
    /// The forcing term `f(theta_m, .)` for `theta` (p).
    ///
    /// # Errors
    /// When the model's covariances are not positive definite.
    pub fn shaping_at(&self, theta: &DVector<f64>) -> Result<ShapingFunction, LearningError> {
        match &self.shaping {
            Shaping::Phmm(phmm) => {
                let phi = self.parameters.features.at(theta);
                let means: Vec<DVector<f64>> = (0..phmm.states()).map(|i| phmm.mean_at(i, &phi)).collect();
                let gmr = Gmr::new(&means, &phmm.covariances, 1)?;
                Ok(ShapingFunction::from_gmr(gmr, self.phase_input, self.alpha, self.gate_start))
            }
            Shaping::Lwr(lwr) => Ok(ShapingFunction::from_lwr(lwr.clone(), self.alpha)),
        }
    }

    /// The parametric model; `None` for the baseline.
    #[must_use]
    pub fn phmm(&self) -> Option<&Phmm> {
        match &self.shaping {
            Shaping::Phmm(phmm) => Some(phmm),
            Shaping::Lwr(_) => None,
        }
    }

    /// Number of states; 0 for the baseline.
    #[must_use]
    pub fn states(&self) -> usize {
        self.phmm().map_or(0, Phmm::states)
    }

    /// Which motion columns are positions in space: those in m, or all when none is.
    #[must_use]
    pub fn spatial_columns(&self) -> Vec<usize> {
        spatial_columns(&self.columns)
    }
}

/// The unit of a thousandth of the spatial columns, for showing the root of a statistic of theirs: `mm`, of joints `mrad`.
#[must_use]
pub fn spread_unit(columns: &[String]) -> &'static str {
    by_unit(columns, ["mm", "mrad", "1e-3 of the columns' units"])
}

/// The unit of a statistic of the spatial columns: `m^2`, of joints `rad^2`.
#[must_use]
pub fn squared_unit(columns: &[String]) -> &'static str {
    by_unit(columns, ["m^2", "rad^2", "columns' units squared"])
}

/// What stands for spatial columns in m, for those in rad, and for others.
fn by_unit(columns: &[String], [metres, radians, others]: [&'static str; 3]) -> &'static str {
    let ends = |unit: &str| spatial_columns(columns).iter().all(|j| columns[*j].ends_with(unit));
    match (ends("_m"), ends("_rad")) {
        (true, _) => metres,
        (_, true) => radians,
        _ => others,
    }
}

/// Indices of the columns in m, or of all when none is.
pub(crate) fn spatial_columns(columns: &[String]) -> Vec<usize> {
    let metres: Vec<usize> = (0..columns.len()).filter(|j| columns[*j].ends_with("_m")).collect();
    if metres.is_empty() { (0..columns.len()).collect() } else { metres }
}
