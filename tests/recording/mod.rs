//! What is kept of a run: the files hold what the records say, bit for bit where they hold numbers, and failures are told.

#[cfg(feature = "rerun")]
pub mod beside;
mod contacts;
mod documented;
#[cfg(feature = "rerun")]
mod live_recording;
pub mod made_up_run;
#[cfg(feature = "rerun")]
mod motion_plot;
mod path_log;
#[cfg(feature = "rerun")]
mod planar_recording;
#[cfg(feature = "rerun")]
pub mod read_rrd;
#[cfg(feature = "rerun")]
mod recording_file;
#[cfg(feature = "rerun")]
mod scene;
mod step_log;
