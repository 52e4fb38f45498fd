//! A file as it stands: named columns of numbers, and every cell that is not a number.

use std::path::Path;

use super::{DemonstrationError, Fault, csv, parquet};

/// The largest file that is read (bytes): weeks of 100 Hz, and far less than the memory of a small computer.
const MOST_BYTES: u64 = 256 << 20;

/// The most cells of one file: what [`MOST_BYTES`] of numbers with eight digits hold, and 0.4 GB in memory.
pub(super) const MOST_CELLS: usize = 50_000_000;

/// How a text file is laid out; `None` means recognised.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Layout {
    pub(super) delimiter: Option<char>,
    pub(super) header: Option<bool>,
}

/// One column: `values` has NaN where `odd` keeps (index of the sample, what stood there).
#[derive(Debug, Clone, Default)]
pub(super) struct Column {
    pub(super) name: String,
    pub(super) values: Vec<f64>,
    pub(super) odd: Vec<(usize, String)>,
}

impl Column {
    /// What stands at a sample, as a label of a sequence.
    pub(super) fn label(&self, index: usize) -> String {
        match self.odd.binary_search_by_key(&index, |(at, _)| *at) {
            Ok(found) => self.odd[found].1.clone(),
            Err(_) => self.values[index].to_string(),
        }
    }

    /// Whether no cell is a number.
    pub(super) fn is_text(&self) -> bool {
        !self.odd.is_empty() && self.odd.len() == self.values.len()
    }
}

/// The columns of one file, all of one length.
#[derive(Debug, Clone, Default)]
pub(super) struct Table {
    /// How faults call the file.
    pub(super) place: String,
    pub(super) columns: Vec<Column>,
    /// Line of every sample, counted from 1.
    pub(super) rows: Vec<usize>,
    /// Whether the columns are named by the file.
    pub(super) header: bool,
}

impl Table {
    /// Reads a CSV or Parquet file.
    pub(super) fn read(path: &Path, place: &str, layout: Layout) -> Result<Self, DemonstrationError> {
        let about = std::fs::metadata(path).map_err(DemonstrationError::io(path))?;
        let invalid = |found: String, expected: String| Err(DemonstrationError::Invalid(vec![Fault::new(place, found, expected)]));
        if !about.is_file() {
            return invalid("no regular file".to_owned(), "a CSV or Parquet file".to_owned());
        }
        if about.len() > MOST_BYTES {
            return invalid(format!("{} MiB", about.len() >> 20), format!("at most {} MiB: split the file", MOST_BYTES >> 20));
        }
        let bytes = std::fs::read(path).map_err(DemonstrationError::io(path))?;
        let table = if is_parquet(path) { parquet::read(&bytes, path, place) } else { csv::read(&bytes, place, layout) }?;
        let mut faults = Vec::new();
        for (i, column) in table.columns.iter().enumerate() {
            if table.columns[..i].iter().any(|other| other.name == column.name) {
                faults.push(Fault::new(place, "the same name twice", "every column name once").in_column(&column.name));
            }
        }
        if faults.is_empty() { Ok(table) } else { Err(DemonstrationError::Invalid(faults)) }
    }

    pub(super) fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|column| column.name == name)
    }

    pub(super) fn names(&self) -> String {
        self.columns.iter().map(|column| column.name.as_str()).collect::<Vec<_>>().join(", ")
    }
}

/// Whether a file is Parquet by its name.
pub(super) fn is_parquet(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("parquet"))
}

/// Whether a file holds samples by its name.
pub(super) fn is_samples(path: &Path) -> bool {
    let extensions = ["csv", "tsv", "txt", "parquet"];
    path.extension().and_then(|e| e.to_str()).is_some_and(|e| extensions.contains(&e.to_ascii_lowercase().as_str()))
}
