//! A learned skill: everything needed to move, for any parameter, start, goal and duration.

mod check;
mod checksum;
mod file;
mod request;
mod schema;
mod schema_parts;

use nalgebra::DVector;

use super::cpdmp::{Compliance, ComplianceWindow, ForceModel, MotionModel, Predictive, compliance_windows, segments};
use super::{GripperProfile, LearningError, OrientationProfile};
use crate::demonstration::ParameterSource;

pub use file::skill_schema;
pub use request::Request;
pub(super) use request::selection;

/// A learned compliant parametric dynamic movement primitive.
#[derive(Debug, Clone, PartialEq)]
pub struct Skill {
    /// Where `theta_m` comes from: given, or read off the start and goal that are asked for.
    pub parameter_source: ParameterSource,
    /// The movement.
    pub motion: MotionModel,
    /// The wrench expected along it, when demonstrations had one.
    pub force: Option<ForceModel>,
    /// Which of the motion model's states comply.
    pub compliance: Compliance,
    /// The orientation along the movement, when demonstrations had one.
    pub orientation: Option<OrientationProfile>,
    /// The gripper along the movement, when demonstrations had one.
    pub gripper: Option<GripperProfile>,
    /// Where the skill comes from: free text by key, sorted.
    pub provenance: Vec<(String, String)>,
    /// Log-likelihood (with log prior) per iteration of the models that were fitted, by name: `motion`, `force`.
    pub histories: Vec<(String, Vec<f64>)>,
}

impl Skill {
    /// The windows in which the movement yields, as time fractions, for parameters `theta_m`.
    ///
    /// # Errors
    /// When parameters are missing or unknown.
    pub fn compliance_windows(&self, theta_m: &[(String, f64)]) -> Result<Vec<ComplianceWindow>, LearningError> {
        let theta = self.motion.parameters.resolve(theta_m)?;
        let mut shaping = self.motion.shaping_at(&theta)?;
        Ok(compliance_windows(&segments(&mut shaping), &self.compliance.beta))
    }

    /// How far parameters lie outside what was demonstrated, as a fraction of its range (-); see
    /// [`super::ParameterSpace::extrapolation`].
    ///
    /// # Errors
    /// When parameters are missing or unknown.
    pub fn extrapolation(&self, theta_m: &[(String, f64)]) -> Result<f64, LearningError> {
        Ok(self.motion.parameters.extrapolation(&self.motion.parameters.resolve(theta_m)?))
    }

    /// How much less is known about the movement at these parameters than demonstrations repeat it (-); see
    /// [`MotionModel::extrapolation_ratio`]. `None` when the skill does not hold the evidence.
    ///
    /// # Errors
    /// When parameters are missing or unknown, or the model is degenerate.
    pub fn extrapolation_ratio(&self, theta_m: &[(String, f64)]) -> Result<Option<f64>, LearningError> {
        self.motion.extrapolation_ratio(&self.motion.parameters.resolve(theta_m)?)
    }

    /// What is expected of the forcing term at these parameters and a time fraction, and how far to trust it; see
    /// [`MotionModel::predictive`]. `None` when the skill does not hold the evidence.
    ///
    /// # Errors
    /// When parameters are missing or unknown, or the model is degenerate.
    pub fn predictive(&self, theta_m: &[(String, f64)], fraction: f64) -> Result<Option<Predictive>, LearningError> {
        self.motion.predictive(&self.motion.parameters.resolve(theta_m)?, fraction)
    }

    /// The start `x0` and goal `g` (d each) at `theta` (p).
    #[must_use]
    pub fn ends_at(&self, theta: &DVector<f64>) -> (DVector<f64>, DVector<f64>) {
        let phi = self.motion.parameters.features.at(theta);
        (self.motion.start.at(&phi), self.motion.goal.at(&phi))
    }
}
