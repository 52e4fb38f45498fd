//! What can be wrong with demonstrations: where, what was found, what was expected.

use std::collections::BTreeMap;
use std::fmt;
use std::path::PathBuf;

/// One thing that is wrong, and how it should be.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Fault {
    /// File name, or the key inside `dataset.toml`; empty for data in memory.
    pub place: String,
    /// Line of the file, counted from 1 with the header as line 1; for data in memory the sample, counted from 0.
    pub row: Option<usize>,
    /// Name of the column.
    pub column: Option<String>,
    /// What was found.
    pub found: String,
    /// What was expected, or how to mend it.
    pub expected: String,
}

impl Fault {
    /// A fault that belongs to a whole file, key or trajectory.
    pub(super) fn new(place: &str, found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self { place: place.to_owned(), row: None, column: None, found: found.into(), expected: expected.into() }
    }

    pub(super) fn at_row(mut self, row: usize) -> Self {
        self.row = Some(row);
        self
    }

    pub(super) fn in_column(mut self, column: &str) -> Self {
        self.column = Some(column.to_owned());
        self
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut place: Vec<String> = Vec::new();
        if !self.place.is_empty() {
            place.push(self.place.clone());
        }
        place.extend(self.row.map(|row| format!("row {row}")));
        place.extend(self.column.as_ref().map(|column| format!("column {column}")));
        if !place.is_empty() {
            write!(f, "{}: ", place.join(", "))?;
        }
        write!(f, "found {}, expected {}", self.found, self.expected)
    }
}

/// Why demonstrations could not be read, written or built.
#[derive(Debug, thiserror::Error)]
pub enum DemonstrationError {
    /// The data are not usable; every fault that was found.
    #[error("{}", listed(.0))]
    Invalid(Vec<Fault>),
    /// The file system refused.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
}

impl DemonstrationError {
    /// Every fault of unusable data; none when the file system refused.
    #[must_use]
    pub fn faults(&self) -> &[Fault] {
        match self {
            Self::Invalid(faults) => faults,
            Self::Io { .. } => &[],
        }
    }

    pub(super) fn io(path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.into();
        move |source| Self::Io { path, source }
    }
}

/// How many lines of faults are written out; the rest is counted.
const LINES_SHOWN: usize = 20;
/// From how many faults on one mistake in many rows, such as decimal commas, is told in one line.
const SAME_MISTAKE: usize = 4;

fn listed(faults: &[Fault]) -> String {
    let (mut groups, mut of_mistake): (Vec<Vec<&Fault>>, _) = (Vec::new(), BTreeMap::new());
    for fault in faults {
        let mistake = (&fault.place, &fault.column, &fault.expected);
        let group = if fault.row.is_some() { *of_mistake.entry(mistake).or_insert(groups.len()) } else { groups.len() };
        if group == groups.len() {
            groups.push(Vec::new());
        }
        groups[group].push(fault);
    }
    let mut lines: Vec<String> = groups.iter().flat_map(|group| told(group)).collect();
    if lines.len() > LINES_SHOWN {
        let more = lines.len() - LINES_SHOWN;
        lines.truncate(LINES_SHOWN);
        lines.push(format!("and {more} more"));
    }
    lines.join("\n")
}

/// Faults of one kind in one column or file: each, or the first and how many more there are.
fn told(group: &[&Fault]) -> Vec<String> {
    match group {
        [first, .., last] if group.len() >= SAME_MISTAKE => {
            let until = last.row.map_or(String::new(), |row| format!(", the last in row {row}"));
            let of = if first.column.is_some() { "column" } else { "file" };
            vec![format!("{first} (and {} more such in this {of}{until})", group.len() - 1)]
        }
        _ => group.iter().map(ToString::to_string).collect(),
    }
}
