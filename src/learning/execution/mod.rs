//! A skill in motion: step by step in a control loop, or all at once as a path.

mod coupling;
mod expectation;
mod generate;
mod settings;
mod skill_execution;
mod skill_state;

pub use generate::{TaskSpaceState, generate, task_space_states};
pub use settings::ExecutionSettings;
pub use skill_execution::SkillExecution;
pub use skill_state::SkillState;
