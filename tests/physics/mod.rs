//! The robot's mathematics and the simulated world, each against independent truth.

mod closed_forms;
mod collisions;
pub mod collisions_in_engine;
mod joint_torques;
mod moved_objects;
mod objects;
mod robot_arm;
mod robot_dynamics;
mod robot_inverse_kinematics;
mod robot_kinematics;
mod robot_meshes;
mod robot_official;
mod robot_urdf;
mod robot_wrench;
mod state_trace;
mod wrench;
