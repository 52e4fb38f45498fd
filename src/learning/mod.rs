//! What was learned: from demonstrations to a skill, and from a skill to motion.
//!
//! ```text
//! Dataset ─learn→ Skill { motion model f(theta_m, s), force model F_des(theta_f, s), compliance beta_i, orientation, gripper }
//! Skill ─SkillExecution::step(StepInput)→ SkillState { position, velocity, orientation, gripper, expected wrench }
//! ```
//!
//! Equation numbers are those of E. Ugur and H. Girgin, "Compliant Parametric Dynamic Movement Primitives", Robotica 38(3), 2020.
//! Rooms inside: [`dmp`] (the primitive and its baseline), [`phmm`] (the parametric hidden Markov model), [`cpdmp`] (what joins them),
//! [`tpgmm`] (the rival).

mod alignment;
mod automatic;
pub mod cpdmp;
pub mod dmp;
mod ends;
mod error;
mod execution;
mod features;
mod gmr;
mod gripper;
mod infer;
mod learn;
mod linear_map;
mod magnitudes;
mod orientation;
mod parameters;
mod parts;
mod patience;
pub mod phmm;
mod prepare;
mod report;
pub mod selection;
mod settings;
mod skill;
pub mod tpgmm;
mod warnings;

pub use ends::{EndRule, EndsReport};
pub use error::{LearningError, SettingFault};
pub use execution::{
    ExecutionSettings, ExecutionSnapshot, Measured, PhaseStopping, SkillExecution, SkillState, StepInput, TaskSpaceState, generate,
    task_space_states, wrench_columns,
};
pub use features::{FeatureMap, Features, Standard};
pub use gmr::Gmr;
pub use gripper::GripperProfile;
pub use infer::{Inference, InferenceSettings, InferenceStatus, infer};
pub use learn::{Learned, learn, learn_from, learn_while};
pub use linear_map::LinearMap;
pub use orientation::OrientationProfile;
pub use parameters::{Combination, ParameterSpace};
pub use patience::MayGoOn;
pub(crate) use patience::{FOR_EVER, go_on};
pub use prepare::motion_sequences;
pub use report::{FitReport, LearningReport, Preparation, StateReport};
pub use settings::{LearningSettings, ShapingKind};
use skill::selection as parameter_selection;
pub use skill::{Request, Skill, skill_schema};
