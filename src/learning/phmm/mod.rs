//! Parametric hidden Markov models (12): Gaussians whose means move linearly with task parameters, learned by expectation maximisation.
//!
//! ```text
//! mu_i(theta) = W_i theta + mean_i          Sigma_i independent of theta                                     (12)
//! Z_i = [W_i mean_i],  Omega_k = [theta_k; 1]
//! Z_i = (sum gamma x Omega^T)(sum gamma Omega Omega^T)^-1,  then Sigma_i with the new means
//! ```
//!
//! The paper's inverse does not exist when a state sees too few parameter values, which its own fixed `theta_f` does. Here `theta` is
//! standardised and centred per state, directions no data determine are left as they were (zero from the start), and a weak prior
//! `W = 0` guards against over-fitting. Sequences stay separate: joining them would invent transitions from ends to starts. All
//! probabilities are logarithms; every iteration raises the objective to rounding, or the fit stops and says so.

mod baum_welch;
mod emission;
mod empty_states;
mod evidence;
mod fit;
mod forward_backward;
mod kmeans;
mod log_recursion;
mod maximisation;
mod model;
mod prediction;
mod scaled_recursion;
mod settings;
mod standardisation;
mod starts;
mod state_chain;
mod statistics;

pub(in crate::learning) use standardisation::mean_and_spread;

pub use baum_welch::FitStatus;
pub use evidence::StateEvidence;
pub use fit::{Fit, StartReport, fit, fit_while, refine};
pub use forward_backward::{Expectation, expect};
pub use kmeans::k_means;
pub use maximisation::{Penalty, maximise_state};
pub use model::{Phmm, Sequence};
pub(in crate::learning) use prediction::prediction_error;
pub use settings::{CovarianceMode, PhmmSettings, Start, Topology};
pub use state_chain::{StateChain, TransitionEdge, TransitionGraph, TransitionNode};
pub use statistics::{Group, gather};
