//! The wrench at the tool from joint efforts: what a robot without a force sensor at its wrist can know.
//!
//! With M a + h = tau + Jᵀ F and F the wrench that the environment applies to the tool, the efforts that the model asks for without
//! contact, tau_model = M a + h, exceed the measured ones by what the environment does: tau_model - tau = Jᵀ F. In least squares
//!
//! ```text
//! F = (J Jᵀ + lambda² I)⁻¹ J (tau_model - tau)
//! ```
//!
//! which is exact for lambda = 0 when the model is, and blind to nothing but singular directions.

use nalgebra::{Cholesky, Matrix6, Vector3, Vector6};

use super::chain::{ChainState, SerialChain};

/// A force and a torque about the tip point, along base axes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Wrench {
    /// Force (N).
    pub force: Vector3<f64>,
    /// Torque about the tip point (N m).
    pub torque: Vector3<f64>,
}

/// What the estimate takes the arm's own motion to need.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EffortModel {
    /// Gravity, Coriolis and inertia: exact, if velocities and accelerations are.
    FullDynamics,
    /// Gravity alone, as Baxter's own estimate: what the arm needs to speed up and turn appears as a false wrench.
    GravityOnly,
}

/// How the arm moves and what its joints exert, n entries each.
#[derive(Debug, Clone, Copy)]
pub struct JointReading<'a> {
    /// Positions (rad or m).
    pub q: &'a [f64],
    /// Velocities (rad/s or m/s).
    pub v: &'a [f64],
    /// Accelerations (rad/s² or m/s²).
    pub a: &'a [f64],
    /// Efforts that the joints exert, after friction and damping (N m or N).
    pub effort: &'a [f64],
}

/// Estimates the wrench that the environment applies to the tool. Estimating does not allocate.
#[derive(Debug, Clone)]
pub struct WrenchEstimator {
    /// What the arm's own motion is taken to need.
    pub model: EffortModel,
    /// lambda², squared metres and radians mixed. 0: exact inverse. A few 1e-3 keep noise bounded where the smallest singular value of J
    /// falls below 0.05, and cut the wrench there.
    pub damping: f64,
    residual: Vec<f64>,
}

impl WrenchEstimator {
    /// An estimator for `chain`.
    pub fn new(chain: &SerialChain, model: EffortModel, damping: f64) -> Self {
        Self { model, damping, residual: vec![0.0; chain.joint_count()] }
    }

    /// The wrench that the environment applies to the tool at the tip point, base axes, under `gravity` (m/s²).
    ///
    /// Nothing when J Jᵀ + lambda² I cannot be inverted: a singular posture without damping.
    ///
    /// # Panics
    /// If a slice has not n entries or `state` belongs to a chain of another length.
    pub fn estimate(
        &mut self,
        chain: &SerialChain,
        reading: &JointReading<'_>,
        gravity: &Vector3<f64>,
        state: &mut ChainState,
    ) -> Option<Wrench> {
        let JointReading { q, v, a, effort } = *reading;
        assert_eq!(effort.len(), chain.joint_count(), "one effort per joint");
        match self.model {
            EffortModel::FullDynamics => chain.inverse_dynamics(q, v, a, gravity, state, &mut self.residual),
            EffortModel::GravityOnly => chain.gravity_torques(q, gravity, state, &mut self.residual),
        }
        self.residual.iter_mut().zip(effort).for_each(|(model, measured)| *model -= measured);
        chain.forward_kinematics(q, state);
        let gram = state.jacobian_gram() + Matrix6::from_diagonal_element(self.damping);
        let columns = state.jacobian().column_iter().zip(&self.residual);
        let moment = columns.fold(Vector6::zeros(), |sum, (column, &residual)| sum + column * residual);
        let solved = Cholesky::new(gram)?.solve(&moment);
        Some(Wrench { force: solved.fixed_rows::<3>(0).into(), torque: solved.fixed_rows::<3>(3).into() })
    }
}
