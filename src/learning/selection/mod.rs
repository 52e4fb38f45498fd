//! What demonstrations that were left out say: how well a skill predicts movements it has not seen, and which settings predict them best.
//!
//! Whole parameter values are left out, so that a movement is never predicted from another one of the same task: values of `theta_m` for
//! movements, of `theta_f` for wrenches. Errors compare positions and wrenches at equal time fractions, in the unit of the columns.

mod choice;
mod cross_validation;
mod folds;
mod movement_error;
mod reproduction;
mod ridge;
mod states;
mod wrench_error;

pub use choice::{Choices, Selection, choose};
pub use cross_validation::{CrossValidation, HeldOut, HeldOutForce, cross_validate};
pub use folds::folds;
pub use movement_error::{ErrorSize, MovementError};
pub use reproduction::{Reproduction, reproduction};
pub use ridge::{RIDGES, RidgeCandidate, RidgeChoice, choose_ridge};
pub use states::{StatesCandidate, StatesChoice, StatesCriterion, StatesSearch, choose_states, free_parameters};
pub use wrench_error::{wrench_error, wrench_error_over};
