//! A dataset from whatever a person has: a folder with or without a list, or one file.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};

use super::doubts::doubts;
use super::list::{LIST, List};
use super::list_entries::Entry;
use super::notes::{Notes, about};
use super::samples::{self, Piece};
use super::table::{Table, is_samples};
use super::{Dataset, Demonstration, DemonstrationError, Fault, ParameterSource, Parameters, roles};

/// The most files and demonstrations of one dataset, and the most faults that are collected.
const MOST: usize = 10_000;

/// A dataset, and in words what was done to get it: repetitions found, units converted, columns left out, gaps, flips of sign.
#[derive(Debug, Clone)]
pub struct Import {
    /// The demonstrations.
    pub dataset: Dataset,
    /// One sentence each, in the order of the files; empty when everything was taken as it stands.
    pub notes: Vec<String>,
    /// What may be another thing than it was taken for.
    pub warnings: Vec<String>,
}

impl Dataset {
    /// Reads a dataset: a folder with `dataset.toml`, a `.toml` file of that format, a folder of CSV and Parquet files, or one such file.
    ///
    /// # Errors
    /// When the path cannot be opened; otherwise every fault of the list and of all demonstrations at once.
    pub fn read(path: &Path) -> Result<Self, DemonstrationError> {
        Ok(Self::import(path)?.dataset)
    }

    /// As [`Self::read`], with notes on what was done to the data.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn import(path: &Path) -> Result<Import, DemonstrationError> {
        let kind = std::fs::metadata(path).map_err(DemonstrationError::io(path))?;
        let inside = path.join(LIST);
        let parent = path.parent().unwrap_or(Path::new("")).to_owned();
        let (folder, mut list) = if kind.is_dir() {
            let list = if inside.exists() { List::read(&inside)? } else { List::default() };
            (path.to_owned(), list)
        } else if path.extension().is_some_and(|extension| extension == "toml") {
            (parent, List::read(path)?)
        } else if let Some(file) = path.file_name().and_then(|name| name.to_str()).filter(|_| is_samples(path)) {
            (parent, List { file: Some(file.to_owned()), ..List::default() })
        } else {
            let found = format!("`{}`", path.display());
            return Err(DemonstrationError::Invalid(vec![Fault::new(
                "dataset",
                found,
                "a folder, or a .toml, .csv, .tsv, .txt or .parquet file",
            )]));
        };
        let faults = std::mem::take(&mut list.faults);
        Reader { folder, list, faults, notes: Notes::default(), files: BTreeMap::new() }.dataset()
    }
}

/// Collects demonstrations and faults; every file is read once.
struct Reader {
    folder: PathBuf,
    list: List,
    faults: Vec<Fault>,
    notes: Notes,
    files: BTreeMap<String, Vec<Piece>>,
}

impl Reader {
    fn dataset(mut self) -> Result<Import, DemonstrationError> {
        let entries = match std::mem::take(&mut self.list.entries) {
            entries if entries.is_empty() => self.every_file()?,
            entries => entries,
        };
        let mut demonstrations = Vec::new();
        for entry in &entries {
            demonstrations.extend(self.demonstrations(entry));
            if demonstrations.len() > MOST {
                self.fault("demonstration", format!("more than {MOST} demonstrations"), format!("at most {MOST}"));
                break;
            }
        }
        let mut names = BTreeSet::new();
        for demonstration in &demonstrations {
            if !names.insert(demonstration.name.as_str()) {
                let expected = "every file and sequence once, and names that differ in more than the extension";
                self.faults.push(Fault::new(LIST, format!("{} twice", demonstration.name), expected));
            }
        }
        let (motion, wrench) = roles::columns(&self.list, &demonstrations, &mut self.notes, &mut self.faults);
        let dataset = Dataset { motion, wrench, parameter_source: ParameterSource::Given, demonstrations };
        let dataset = dataset.with_parameter_source(self.list.source);
        if self.faults.is_empty()
            && let Err(DemonstrationError::Invalid(more)) = dataset.check()
        {
            self.faults = more;
        }
        if self.faults.is_empty() {
            about(&dataset, &mut self.notes);
            let warnings = doubts(&dataset, self.list.motion.is_some());
            Ok(Import { dataset, notes: self.notes.in_words(), warnings })
        } else {
            self.faults.truncate(MOST);
            Err(DemonstrationError::Invalid(self.faults))
        }
    }

    /// One entry per file, sorted by name.
    fn every_file(&mut self) -> Result<Vec<Entry>, DemonstrationError> {
        let entry = |name: String| Entry { key: "file".to_owned(), file: Some(name), ..Entry::default() };
        if let Some(name) = &self.list.file {
            return Ok(vec![entry(name.clone())]);
        }
        // The path of a list without a folder is that of the working directory.
        let folder = if self.folder.as_os_str().is_empty() { Path::new(".") } else { &self.folder };
        let mut names = Vec::new();
        for file in std::fs::read_dir(folder).map_err(DemonstrationError::io(folder))? {
            let file = file.map_err(DemonstrationError::io(folder))?.file_name();
            names.extend(file.to_str().filter(|name| is_samples(Path::new(name)) && !name.starts_with('.')).map(str::to_owned));
        }
        names.sort();
        if names.is_empty() || names.len() > MOST {
            let found = format!("{} CSV or Parquet files in {}", names.len(), folder.display());
            self.faults.push(Fault::new("dataset", found, "no demonstration: 1 to 10000 files, one for each or with a sequence column"));
            names.clear();
        }
        Ok(names.into_iter().map(entry).collect())
    }

    fn demonstrations(&mut self, entry: &Entry) -> Vec<Demonstration> {
        let Some(file) = entry.file.clone().or_else(|| self.list.file.clone()) else {
            self.fault(&entry.key, "no file name", "file = \"NAME.csv\"");
            return Vec::new();
        };
        let plain = Path::new(&file).components().all(|part| matches!(part, Component::Normal(_)));
        if !plain || !is_samples(Path::new(&file)) {
            self.fault(&entry.key, format!("file = \"{file}\""), "a .csv, .tsv, .txt or .parquet file inside the dataset's folder");
            return Vec::new();
        }
        if !self.files.contains_key(&file) {
            let pieces = self.pieces(&file);
            self.files.insert(file.clone(), pieces);
        }
        let pieces = self.files.get(&file).map_or(&[][..], Vec::as_slice);
        let stem = Path::new(&file).with_extension("").to_string_lossy().replace(['/', '\\'], "_");
        let several = pieces.len() > 1;
        // Repetitions without a label are counted from 1.
        let label = |(i, piece): (usize, &Piece)| piece.label.clone().or(several.then(|| (i + 1).to_string()));
        let labelled: Vec<(Option<String>, &Piece)> = pieces.iter().enumerate().map(|one| (label(one), one.1)).collect();
        let asked = |label: &Option<String>| entry.sequence.is_none() || same_label(entry.sequence.as_deref(), label.as_deref());
        let named = |(label, piece): &(Option<String>, &Piece)| demonstration(&stem, label.clone(), piece, entry);
        let taken: Vec<Demonstration> = labelled.iter().filter(|(label, _)| asked(label)).map(named).collect();
        if taken.is_empty() && !labelled.is_empty() {
            let labels = labelled.iter().filter_map(|(label, _)| label.clone()).collect::<Vec<_>>().join(", ");
            let found = format!("sequence {}, which {file} does not have", entry.sequence.as_deref().unwrap_or_default());
            let expected =
                if labels.is_empty() { "no sequence: the file holds one repetition".to_owned() } else { format!("one of [{labels}]") };
            self.fault(&entry.key, found, expected);
        }
        taken
    }

    fn pieces(&mut self, file: &str) -> Vec<Piece> {
        let read = Table::read(&self.folder.join(file), file, self.list.layout);
        match read.map(|table| samples::pieces(table, &self.list, &mut self.notes)) {
            Ok(Ok(pieces)) => return pieces,
            Ok(Err(faults)) | Err(DemonstrationError::Invalid(faults)) => self.faults.extend(faults),
            Err(error @ DemonstrationError::Io { .. }) => self.fault("file", error.to_string(), "a file that can be read"),
        }
        Vec::new()
    }

    fn fault(&mut self, key: &str, found: impl Into<String>, expected: impl Into<String>) {
        self.faults.push(Fault::new(&format!("{LIST}, {key}"), found, expected));
    }
}

fn demonstration(stem: &str, label: Option<String>, piece: &Piece, entry: &Entry) -> Demonstration {
    let plain = |c: char| if c.is_alphanumeric() || "_-.".contains(c) { c } else { '_' };
    let label = label.map_or_else(String::new, |label| format!("_{label}"));
    let theta = |own: &Parameters, given: &Parameters| if given.is_empty() { own.clone() } else { given.clone() };
    Demonstration {
        name: format!("{stem}{label}").chars().map(plain).collect(),
        trajectory: piece.trajectory.clone(),
        theta_m: theta(&piece.theta_m, &entry.theta_m),
        theta_f: theta(&piece.theta_f, &entry.theta_f),
    }
}

/// Whether two labels are the same text or the same number.
fn same_label(asked: Option<&str>, label: Option<&str>) -> bool {
    let number = |label: Option<&str>| label.and_then(|label| label.parse::<f64>().ok());
    asked == label || number(asked).is_some_and(|asked| number(label) == Some(asked))
}
