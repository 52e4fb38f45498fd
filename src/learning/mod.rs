//! What was learned: from demonstrations to a skill, and from a skill to motion.
//!
//! ```text
//! Dataset ─learn→ Skill { motion model f(theta_m, s), force model F_des(theta_f, s), compliance beta_i, orientation, gripper }
//! Skill ─SkillExecution::step(StepInput)→ SkillState { position, velocity, orientation, gripper, expected wrench }
//! ```
//!
//! Equation numbers are those of E. Ugur and H. Girgin, "Compliant Parametric Dynamic Movement Primitives", Robotica 38(3), 2020.
//! Rooms inside: [`dmp`] (the primitive and its baseline), [`phmm`] (the parametric hidden Markov model), [`cpdmp`] (what joins them).

pub mod cpdmp;
pub mod dmp;
mod error;
mod execution;
mod gmr;
mod gripper;
mod learn;
mod linear_map;
mod orientation;
mod parameters;
pub mod phmm;
mod prepare;
mod report;
mod settings;
mod skill;
mod warnings;

pub use error::{LearningError, SettingFault};
pub use execution::{
    ExecutionSettings, Measured, PhaseStopping, SkillExecution, SkillState, StepInput, TaskSpaceState, generate, task_space_states,
};
pub use gmr::Gmr;
pub use gripper::GripperProfile;
pub use learn::{Learned, learn};
pub use linear_map::LinearMap;
pub use orientation::OrientationProfile;
pub use parameters::ParameterSpace;
pub use report::{FitReport, LearningReport, StateReport};
pub use settings::{LearningSettings, ShapingKind};
pub use skill::Skill;
