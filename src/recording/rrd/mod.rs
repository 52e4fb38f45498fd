//! The recording for the rerun viewer: the only place that knows rerun.

mod blueprint_property;
mod contact_figure;
mod convert;
pub mod entity_path;
mod events;
mod force_figure;
mod forcing_figure;
mod guide;
mod lanes;
mod layout;
mod palette;
mod paths;
mod recorder;
mod replay_figure;
mod robot_figure;
mod scene_figure;
mod spread_figure;
mod state_figure;
mod task_states;
mod teaching_figure;
mod write;

pub use write::write_recording;
