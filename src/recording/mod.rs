//! Readers of a run that keep it: the recording for the rerun viewer, and the step log for analysis.
//!
//! Both are written from a [`RunOutcome`](crate::simulation::RunOutcome), or a [`PlanarOutcome`](crate::planar::PlanarOutcome), when the
//! run is over, so they cannot change or delay it; a `LiveRecording` is another view of it that grows beside the run. The step log (`steps.parquet`; `paths.parquet` of a planar run) is the archive: exact
//! numbers, documented columns. The recording (`recording.rrd`, cargo feature `rerun`) is the view: everything in it is named in
//! `entity_path` (`planar_entity` for a planar run), and the layout that it opens with is inside the file.

mod error;
mod path_log;
#[cfg(feature = "rerun")]
mod rrd;
mod state_log;
mod step_columns;
mod step_log;
mod step_reader;
mod step_table;
mod table_file;

pub use error::RecordingError;
pub use path_log::{LoggedPath, PATH_COLUMNS, PATH_LOG_VERSION, write_path_log};
#[cfg(feature = "rerun")]
pub use rrd::{LiveRecording, close_recording, entity_path, planar_entity, write_planar_recording, write_recording};
pub use state_log::{STATE_COLUMNS, STATE_LOG_VERSION, read_state_log, write_state_log};
pub use step_columns::{StepColumn, step_columns};
pub use step_log::{STEP_LOG_VERSION, write_step_log};
pub use step_reader::read_step_log;
