//! Decisions: what the arm is told, from nothing but what it measures. This room never sees the simulated world, so that the same controllers
//! could drive a real arm.

mod arm_model;
mod command;
mod feedback;
mod hold;
mod impedance;
mod joint_tracking;
mod observation;
mod pose_tracking;
mod skill_controller;
mod trajectory_controller;
mod wrench_observer;
mod zero_gravity;

pub use arm_model::{ArmModel, ArmModelError};
pub use command::{Command, Controller, Telemetry};
pub use feedback::Feedback;
pub use hold::HoldPosture;
pub use impedance::ImpedanceSettings;
pub use joint_tracking::PostureTracker;
pub use observation::Observation;
pub use pose_tracking::PoseTracker;
pub use skill_controller::{ControllerSnapshot, Follower, SkillController, UnmeasuredWrench, WRENCH_COLUMNS};
pub use trajectory_controller::{ToolPath, TrajectoryController};
pub use wrench_observer::WrenchObserver;
pub use zero_gravity::ZeroGravity;
