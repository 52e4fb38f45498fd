//! What the arm is: its bodies and joints, where they are, how they move, and what its efforts tell of contact.
//!
//! A description (URDF) becomes a [`RobotModel`]; a [`SerialChain`] is one arm of it. Chains are constant; each computation runs in buffers
//! that are made once ([`ChainState`], [`InverseKinematics`], [`WrenchEstimator`]) and allocates nothing.
//!
//! ```
//! use cpdmp::robot::{SerialChain, baxter};
//!
//! let model = baxter().model;
//! let arm = SerialChain::new(&model, baxter::BASE_LINK, baxter::LEFT_TOOL)?;
//! let mut state = arm.state();
//! arm.forward_kinematics(&[0.0; 7], &mut state);
//! assert!(state.tip_pose().translation.x > 0.8);
//! # Ok::<(), cpdmp::robot::ChainError>(())
//! ```
//!
//! Conventions. Poses are `a_from_b`. Twists, wrenches and Jacobian rows are linear before angular, along the axes of the chain's base
//! frame, at the tip point. SI units and radians throughout.

pub mod baxter;
mod chain;
mod chain_link;
mod dynamics;
mod follow;
mod inverse_kinematics;
mod joint_command;
mod kinematics;
mod lump;
mod model;
mod nearest;
mod urdf;
mod wrench_estimate;

pub use baxter::{bare_baxter, baxter, baxter_with_hook, electric_gripper, hook};
pub use chain::{ChainError, ChainState, SerialChain};
pub use follow::FollowSettings;
pub use inverse_kinematics::{IkOutcome, IkSettings, InverseKinematics, pose_error};
pub use joint_command::JointCommand;
pub use model::{Body, Frame, Geometry, Joint, JointKind, Mimic, RobotModel, Shape};
pub use nearest::nearest_name;
pub use urdf::{Attachment, Finding, LoadOptions, Loaded, Severity, UrdfError, collision_mesh_files, load, parse};
pub use wrench_estimate::{EffortModel, JointReading, Wrench, WrenchEstimator};
