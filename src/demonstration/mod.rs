//! What a person showed: trajectories with named columns, demonstrations with their parameters, and datasets on disk.
//!
//! Times are in s and rise. Every column is named `NAME_UNIT` in SI units (`x_m`, `fx_n`, `q1_rad`), except the quaternion
//! `qx, qy, qz, qw` (scalar last, unit norm) and `gripper` (0 closed, 1 open). Everything is checked where it enters; every fault of a
//! dataset is reported at once, with file, row and column.

mod align;
mod column_map;
mod csv;
mod dataset;
mod error;
mod list;
mod list_entries;
mod notes;
mod parameter_source;
mod parquet;
mod read;
mod resample;
mod roles;
mod samples;
mod sequences;
mod summary;
pub mod synthetic;
mod table;
mod to_csv;
mod trajectory;
mod trajectory_faults;
mod trajectory_file;
mod unit;
mod write;

pub use align::Aligned;
pub use dataset::{Dataset, Demonstration, Parameters};
pub use error::{DemonstrationError, Fault};
pub use parameter_source::ParameterSource;
pub use read::Import;
pub use summary::{ColumnSummary, DatasetSummary, DemonstrationSummary};
pub use trajectory::{GRIPPER_COLUMN, QUATERNION_COLUMNS, Trajectory};
pub use trajectory_file::{FileFormat, read_trajectory, write_trajectory};
