//! The path log `paths.parquet` of planar runs: every point of every path as one row.

use std::fs::File;
use std::path::Path;

use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::errors::ParquetError;

use super::RecordingError;
use super::table_file::{self, Kind, write_next};

/// Version of the path log's columns, under the key `cpdmp.version` of the file.
pub const PATH_LOG_VERSION: u32 = 1;

/// The columns of a path log: name and meaning.
pub const PATH_COLUMNS: [(&str, &str); 5] = [
    ("method", "what made the path; `demonstration` for what was shown"),
    ("setting", "the setting that it is for, as in report.json, or the name of the demonstration"),
    ("time_fraction", "elapsed fraction of the movement, from 0 to 1"),
    ("x_m", "place along x (m)"),
    ("y_m", "place along y (m)"),
];

/// One path.
#[derive(Clone, Debug, PartialEq)]
pub struct LoggedPath<'a> {
    /// What made it.
    pub method: &'a str,
    /// The setting that it is for.
    pub setting: &'a str,
    /// Places (m), equally timed.
    pub points_m: &'a [[f64; 2]],
}

/// Writes paths to a Parquet file with [`PATH_COLUMNS`], one row group per path, in their order. Equal paths give equal bytes.
///
/// # Errors
/// When the file cannot be created or written.
pub fn write_path_log(path: &Path, paths: &[LoggedPath<'_>]) -> Result<(), RecordingError> {
    let file = File::create(path).map_err(|source| RecordingError::Io { path: path.to_owned(), source })?;
    write(file, paths).map_err(|source| RecordingError::Parquet { path: path.to_owned(), source })
}

fn write(file: File, paths: &[LoggedPath<'_>]) -> Result<(), ParquetError> {
    let kind = |name: &str| if matches!(name, "method" | "setting") { Kind::Text } else { Kind::Real };
    let mut writer = table_file::open(file, "path", PATH_LOG_VERSION, &PATH_COLUMNS.map(|(name, meaning)| (name, meaning, kind(name))))?;
    for path in paths {
        let rows = path.points_m.len();
        let last = rows.saturating_sub(1).max(1) as f64;
        let mut group = writer.next_row_group()?;
        for word in [path.method, path.setting] {
            write_next::<ByteArrayType>(&mut group, &vec![ByteArray::from(word); rows])?;
        }
        write_next::<DoubleType>(&mut group, &(0..rows).map(|row| row as f64 / last).collect::<Vec<_>>())?;
        for axis in 0..2 {
            write_next::<DoubleType>(&mut group, &path.points_m.iter().map(|point| point[axis]).collect::<Vec<_>>())?;
        }
        group.close()?;
    }
    writer.close()?;
    Ok(())
}
