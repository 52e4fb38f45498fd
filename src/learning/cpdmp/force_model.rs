//! The wrench that is expected along the movement, `F_des(theta_f, s)`.

use nalgebra::DVector;

use crate::learning::dmp::PhaseInput;
use crate::learning::phmm::{Phmm, StateEvidence};
use crate::learning::{Gmr, LearningError, ParameterSpace};

/// The forces of a skill. `theta_f` may be empty or the same in all demonstrations.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceModel {
    /// Columns of the wrench (w).
    pub columns: Vec<String>,
    /// Parameters `theta_f`.
    pub parameters: ParameterSpace,
    /// What the model sees of the phase.
    pub phase_input: PhaseInput,
    /// The model over the phase input and the wrench.
    pub phmm: Phmm,
    /// How well the demonstrations determine each state's mean (N); empty in files that do not say.
    pub evidence: Vec<StateEvidence>,
}

impl ForceModel {
    /// The regression `F_des(theta_f, .)` for `theta` over the phase input.
    ///
    /// # Errors
    /// When the model's covariances are not positive definite.
    pub fn regression_at(&self, theta: &DVector<f64>) -> Result<Gmr, LearningError> {
        let phi = self.parameters.features.at(theta);
        let means: Vec<DVector<f64>> = (0..self.phmm.states()).map(|i| self.phmm.mean_at(i, &phi)).collect();
        Gmr::new(&means, &self.phmm.covariances, 1)
    }
}
