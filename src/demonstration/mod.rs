//! What a person showed: trajectories with named columns, demonstrations with their parameters, and datasets on disk.
//!
//! Times are in s and rise. Every column is named `NAME_UNIT` in SI units (`x_m`, `fx_n`, `q1_rad`), except the quaternion
//! `qx, qy, qz, qw` (scalar last, unit norm) and `gripper` (0 closed, 1 open). Everything is checked where it enters; every fault of a
//! dataset is reported at once, with file, row and column.

mod align;
mod csv;
mod dataset;
mod error;
mod parameter_source;
mod read;
mod resample;
pub mod synthetic;
mod trajectory;
mod trajectory_faults;
mod write;

pub use align::Aligned;
pub use dataset::{Dataset, Demonstration, Parameters};
pub use error::{DemonstrationError, Fault};
pub use parameter_source::ParameterSource;
pub use trajectory::{GRIPPER_COLUMN, QUATERNION_COLUMNS, Trajectory};
