//! Readers of a run that keep it: the recording for the rerun viewer, and the step log for analysis.
//!
//! Both are written from a [`RunOutcome`](crate::simulation::RunOutcome) when it is over, so they cannot change or delay a run. The step
//! log (`steps.parquet`) is the archive: exact numbers, documented columns. The recording (`recording.rrd`, cargo feature `rerun`) is the
//! view: everything in it is named in `entity_path`, and the layout that it opens with is inside the file.

mod error;
#[cfg(feature = "rerun")]
mod rrd;
mod step_columns;
mod step_log;

pub use error::RecordingError;
#[cfg(feature = "rerun")]
pub use rrd::{entity_path, write_recording};
pub use step_columns::{StepColumn, step_columns};
pub use step_log::{STEP_LOG_VERSION, write_step_log};
