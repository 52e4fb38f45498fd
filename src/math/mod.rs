//! Numbers: the mathematics every other room stands on. Nothing here knows robots, files or demonstrations.
//!
//! Conventions: matrices are rows x columns; quaternions are unit and act from the left; covariances are symmetric positive definite
//! (SPD) and are checked where they enter. Probabilities are kept as natural logarithms until the last moment.

mod derivative;
mod error;
mod gaussian;
mod least_squares;
mod log_domain;
mod minimum_jerk;
mod orientation;
mod outline;
mod random;
mod spectral;

pub use derivative::{Derivatives, SmoothingDerivative};
pub use error::MathError;
pub use gaussian::Gaussian;
pub use least_squares::{LeastSquares, solve_normal_equations, solve_weighted};
pub use log_domain::{log_sum_exp, softmax_in_place};
pub use minimum_jerk::{MinimumJerk, minimum_jerk, smooth_step};
pub use orientation::{continuous_log, exp_map, log_map, mean_quaternion, right_jacobian, same_hemisphere, slerp};
pub use outline::{covariance_outline, ellipse_outline};
pub use random::{standard_normal, stream, uniform};
pub use spectral::{clamp_eigenvalues, eigenvalue_range, symmetric_pseudo_inverse};
