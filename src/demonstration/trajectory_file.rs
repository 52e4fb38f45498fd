//! One trajectory in one file, CSV or Parquet by the extension.

use std::fs::File;
use std::path::Path;

use super::list::List;
use super::notes::Notes;
use super::table::{Layout, Table, is_parquet, is_samples};
use super::{DemonstrationError, Fault, Trajectory, csv, parquet, samples};

/// How samples are stored; both survive the round trip bit for bit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FileFormat {
    /// Text that every program reads.
    #[default]
    Csv,
    /// Columns of doubles, compressed: for large data.
    Parquet,
}

impl FileFormat {
    /// The extension of its files.
    #[must_use]
    pub fn extension(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Parquet => "parquet",
        }
    }
}

/// Reads the one trajectory of a `.csv`, `.tsv`, `.txt` or `.parquet` file with a column `time_s`.
///
/// # Errors
/// When the file cannot be opened; otherwise all faults at once, also when it holds several repetitions.
pub fn read_trajectory(path: &Path) -> Result<Trajectory, DemonstrationError> {
    let place = file_name(path)?;
    let table = Table::read(path, &place, Layout::default())?;
    let mut pieces = samples::pieces(table, &List::default(), &mut Notes::default()).map_err(DemonstrationError::Invalid)?;
    match (pieces.pop(), pieces.len()) {
        (Some(piece), 0) => Ok(piece.trajectory),
        (_, others) => invalid(&place, format!("{} repetitions", others + 1), "one: read the file as a dataset"),
    }
}

/// Writes a trajectory as the extension says (`.csv` or `.parquet`): beside, then renamed over what was there.
///
/// # Errors
/// Another extension, a column called `time_s`, or what the disk says; the old file is then as it was.
pub fn write_trajectory(path: &Path, trajectory: &Trajectory) -> Result<(), DemonstrationError> {
    let place = file_name(path)?;
    let format = match path.extension().and_then(|extension| extension.to_str()) {
        Some(extension) if extension.eq_ignore_ascii_case("csv") => FileFormat::Csv,
        Some(_) if is_parquet(path) => FileFormat::Parquet,
        _ => return invalid(&place, "an unknown extension".to_owned(), "a file name that ends with .csv or .parquet"),
    };
    let folder = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let beside = tempfile::Builder::new().prefix(".trajectory-").tempdir_in(folder).map_err(DemonstrationError::io(folder))?;
    let new = beside.path().join("new");
    write_new(&new, &place, trajectory, format)?;
    std::fs::rename(&new, path).map_err(DemonstrationError::io(path))
}

/// Writes a file that does not exist yet.
pub(super) fn write_new(path: &Path, place: &str, trajectory: &Trajectory, format: FileFormat) -> Result<(), DemonstrationError> {
    if trajectory.column_index("time_s").is_some() {
        return invalid(place, "a column called time_s beside the times".to_owned(), "another name for it");
    }
    match format {
        FileFormat::Csv => std::fs::write(path, csv::text(trajectory)).map_err(DemonstrationError::io(path)),
        FileFormat::Parquet => {
            let file = File::create(path).map_err(DemonstrationError::io(path))?;
            let refused = |error: ::parquet::errors::ParquetError| DemonstrationError::io(path)(std::io::Error::other(error));
            parquet::write(file, trajectory).map_err(refused)
        }
    }
}

fn file_name(path: &Path) -> Result<String, DemonstrationError> {
    match path.file_name().and_then(|name| name.to_str()).filter(|_| is_samples(path)) {
        Some(name) => Ok(name.to_owned()),
        None => invalid(&path.display().to_string(), "no file of samples".to_owned(), "a .csv or .parquet file"),
    }
}

fn invalid<T>(place: &str, found: String, expected: &str) -> Result<T, DemonstrationError> {
    Err(DemonstrationError::Invalid(vec![Fault::new(place, found, expected)]))
}
