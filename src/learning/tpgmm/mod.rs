//! Task-parameterised Gaussian mixtures (S. Calinon, "A tutorial on task-parameterized movement learning and retrieval", Intelligent
//! Service Robotics 9(1), 2016): the rival of the parametric hidden Markov model.
//!
//! ```text
//! x'_j = A_j^-1 (x - b_j)                                     each sample as every frame j of its demonstration sees it
//! p(x) = sum_i pi_i prod_j N(x'_j; mu_ij, Sigma_ij)           learned by expectation maximisation
//! N(mu_i, Sigma_i) ~ prod_j N(A_j mu_ij + b_j, A_j Sigma_ij A_j^T)            for new frames
//! y(u) by Gaussian mixture regression over the product's components
//! ```
//!
//! The first variable is the phase input, which every frame sees alike. The mixture generalises by where its frames are put, so it knows of
//! a task only what its frames tell; where they tell enough, it extrapolates with them.

mod expectation_maximisation;
mod fit;
mod frame;
mod model;
mod problem;
mod settings;

pub use fit::{TpGmmFit, TpGmmStartReport, fit, fit_while};
pub use frame::{Frame, FramedSequence};
pub use model::TpGmm;
pub use settings::{TpGmmSettings, TpGmmStart};
