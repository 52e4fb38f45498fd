//! The recording for the rerun viewer: the only place that knows rerun.

mod blueprint_property;
mod camera;
mod chapters;
mod contact_figure;
mod convert;
pub mod entity_path;
mod events;
mod force_figure;
mod forcing_figure;
mod guide;
mod lanes;
mod layout;
mod live;
mod palette;
mod paths;
pub mod planar_entity;
mod planar_forcing;
mod planar_graph;
mod planar_guide;
mod planar_layout;
mod planar_map;
mod planar_recorder;
mod planar_write;
mod recorder;
mod replay_figure;
mod robot_figure;
mod scene_figure;
mod spread_figure;
mod state_figure;
mod task_states;
mod teaching_figure;
mod write;

pub use live::LiveRecording;
pub use planar_write::write_planar_recording;
pub use write::write_recording;
