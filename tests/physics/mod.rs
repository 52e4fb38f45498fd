//! The simulated world against closed forms.

mod closed_forms;
mod joint_torques;
mod wrench;
