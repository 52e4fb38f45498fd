//! What a person showed: trajectories with named columns, demonstrations with their parameters, and datasets on disk.
//!
//! Times are in s and rise. Every column is named `NAME_UNIT` in SI units (`x_m`, `fx_n`, `q1_rad`), except the quaternion
//! `qx, qy, qz, qw` (scalar last, unit norm) and `gripper` (0 closed, 1 open). Everything is checked where it enters; every fault of a
//! dataset is reported at once, with file, row and column.
//!
//! # What [`Dataset::read`] takes
//! - a folder with `dataset.toml`, or the path of such a `.toml` file;
//! - a folder of `.csv`, `.tsv`, `.txt` and `.parquet` files: each is a demonstration, or several;
//! - one such file.
//!
//! Without a list, `f?_n` and `t?_nm` are the wrench, and all other columns that are not time, quaternion, gripper or sequence are the
//! motion. Time is `time_s`; `time`, `t` and `timestamp` are taken as s, `time_ms`, `time_us` and `time_ns` are converted. Repetitions
//! in one file are told apart by a column (`sequence`, `demo`, `episode`, `trial`, `run` … of integers or text), or by time that falls
//! back to its start. Text files may have commas, semicolons, tabs or blanks between cells; lines that start with `#` are skipped;
//! decimal commas are refused. [`Dataset::import`] also says in words what was done.
//!
//! # `dataset.toml`
//! Only `schema_version` must be there.
//! ```toml
//! schema_version = 1
//! motion = ["x_m", "y_m", "z_m"]            # columns of the motion model (1 to 32); default: by their names
//! wrench = ["fx_n", "fy_n", "fz_n"]         # columns of the force model; default: none, without `motion` by their names
//! file = "all.csv"                          # the file of all demonstrations; default: every file of the folder
//! sequence = "demo_id"                      # the column that tells repetitions apart
//! rate_hz = 100.0                           # for files without time
//! delimiter = ";"                           # "," ";" "tab" "whitespace"; default: recognised
//! header = true                             # false: columns are named under [columns] by their place
//! theta_f = ["mass_kg"]                     # parameters from columns that are constant in a repetition; the same for theta_m
//! # theta = "start"                         # or theta_m from the motion: "start", "goal", "start_relative_to_goal"
//!
//! [columns]                                 # this dataset's name = that of the file
//! time_s = { from = "stamp", unit = "ms" }  # unit of the source; the target's is in its name
//! x_m = { from = "px", unit = "mm" }        # m km cm mm um in, rad mrad deg, s min ms us ns, kg g, N kN mN, Nm mNm Nmm, 1 percent
//! y_m = "py"
//! z_m = 3                                   # a place, counted from 0
//! quaternion = { from = ["qw", "q1", "q2", "q3"], order = "wxyz" }
//!
//! [[demonstration]]                         # default: every file and sequence
//! file = "height_17_a.csv"                  # default: the file above
//! sequence = 3                              # value of the sequence column; default: all of the file
//! theta_m = { block_height_m = 0.17 }       # or given here, the same for theta_f
//! ```
//! Parameters come from one place: `theta`, `theta_m` at the top, or `theta_m` of every demonstration. [`Dataset::write`] writes the
//! first form or the last, and reads back bit for bit.

mod align;
mod align_features;
mod column_map;
mod csv;
mod dataset;
mod doubts;
mod error;
mod list;
mod list_entries;
mod list_schema;
mod notes;
mod parameter_source;
mod parquet;
mod parquet_pages;
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
pub use list_schema::dataset_schema;
pub use parameter_source::ParameterSource;
pub use read::Import;
pub(crate) use resample::MOST_SAMPLES;
pub use summary::{ColumnSummary, DatasetSummary, DemonstrationSummary};
pub use trajectory::{GRIPPER_COLUMN, QUATERNION_COLUMNS, Trajectory};
pub use trajectory_file::{FileFormat, read_trajectory, write_trajectory};
