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

mod estimate;
mod observation;
mod observed_part;
mod prior;
mod settings;

pub use estimate::{Inference, InferenceStatus, infer};
pub use settings::InferenceSettings;
