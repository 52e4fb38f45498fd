//! A skill in motion: step by step in a control loop, or all at once as a path.

mod coupling;
mod drive;
mod expectation;
mod generate;
mod movement;
mod settings;
mod skill_execution;
mod skill_state;
mod snapshot;
mod step_input;
mod turning;

pub use coupling::wrench_columns;
pub use generate::{TaskSpaceState, generate, task_space_states};
pub use settings::{ExecutionSettings, PhaseStopping};
pub use skill_execution::SkillExecution;
pub use skill_state::SkillState;
pub use snapshot::ExecutionSnapshot;
pub use step_input::{Measured, StepInput};
