//! `dataset.toml` as typed: every key with its type, nothing read from other files yet.

use std::path::Path;

use toml::{Table, Value};

use super::column_map::{self, Mapping};
use super::list_entries::Entry;
use super::table::Layout;
use super::{DemonstrationError, Fault, ParameterSource};

/// The name of the list inside a dataset's folder.
pub(super) const LIST: &str = "dataset.toml";

const SCHEMA_VERSION: i64 = 1;

/// The largest list that is read (bytes): tens of thousands of demonstrations.
const MOST_BYTES: u64 = 4 << 20;

const KEYS: [&str; 13] = [
    "schema_version",
    "motion",
    "wrench",
    "demonstration",
    "columns",
    "delimiter",
    "header",
    "rate_hz",
    "file",
    "sequence",
    "theta",
    "theta_m",
    "theta_f",
];

/// What the list says; a folder without a list has the default.
#[derive(Debug, Default)]
pub(super) struct List {
    pub(super) faults: Vec<Fault>,
    pub(super) motion: Option<Vec<String>>,
    pub(super) wrench: Option<Vec<String>>,
    pub(super) entries: Vec<Entry>,
    pub(super) columns: Vec<Mapping>,
    pub(super) layout: Layout,
    /// Rate of files without time (Hz).
    pub(super) rate_hz: Option<f64>,
    pub(super) file: Option<String>,
    /// Name of the column that tells repetitions apart.
    pub(super) sequence: Option<String>,
    pub(super) source: ParameterSource,
    /// Columns that hold the parameters.
    pub(super) theta_m: Vec<String>,
    pub(super) theta_f: Vec<String>,
}

impl List {
    pub(super) fn read(path: &Path) -> Result<Self, DemonstrationError> {
        let invalid = |found: String, expected: &str| Err(DemonstrationError::Invalid(vec![Fault::new(LIST, found, expected)]));
        let about = std::fs::metadata(path).map_err(DemonstrationError::io(path))?;
        if !about.is_file() || about.len() > MOST_BYTES {
            return invalid(format!("{} bytes, or no regular file", about.len()), "a text file of at most 4 MiB");
        }
        let bytes = std::fs::read(path).map_err(DemonstrationError::io(path))?;
        let Ok(text) = std::str::from_utf8(&bytes) else { return invalid("bytes that are not UTF-8".to_owned(), "TOML in UTF-8") };
        match text.strip_prefix('\u{feff}').unwrap_or(text).parse::<Table>() {
            Ok(table) => Ok(Self::typed(&table)),
            Err(error) => invalid(error.to_string().trim_end().to_owned(), "TOML"),
        }
    }

    fn typed(table: &Table) -> Self {
        let mut list = Self::default();
        list.check_version(table);
        list.check_keys(table, "", &KEYS);
        list.motion = list.names(table, "motion");
        list.wrench = list.names(table, "wrench");
        list.theta_m = list.names(table, "theta_m").unwrap_or_default();
        list.theta_f = list.names(table, "theta_f").unwrap_or_default();
        list.file = list.text(table, "", "file");
        list.sequence = list.text(table, "", "sequence");
        list.layout = list.layout(table);
        list.rate_hz = list.rate(table);
        list.source = list.source(table);
        list.columns = column_map::typed(table, &mut list.faults);
        list.entries = list.entries(table);
        list.check_parameters();
        list
    }

    pub(super) fn fault(&mut self, key: &str, found: impl Into<String>, expected: impl Into<String>) {
        self.faults.push(Fault::new(&format!("{LIST}, {key}"), found, expected));
    }

    fn check_version(&mut self, table: &Table) {
        match table.get("schema_version") {
            Some(Value::Integer(SCHEMA_VERSION)) => {}
            Some(Value::Integer(newer)) if *newer > SCHEMA_VERSION => {
                self.fault("schema_version", newer.to_string(), "1: this file needs a newer cpdmp");
            }
            Some(other) => self.fault("schema_version", other.to_string(), "1"),
            None => self.fault("schema_version", "nothing", "schema_version = 1"),
        }
    }

    pub(super) fn check_keys(&mut self, table: &Table, inside: &str, known: &[&str]) {
        for key in table.keys().filter(|key| !known.contains(&key.as_str())) {
            self.fault(&format!("{inside}{key}"), "an unknown key", format!("one of {}", known.join(", ")));
        }
    }

    /// A list of column names.
    fn names(&mut self, table: &Table, key: &str) -> Option<Vec<String>> {
        let value = table.get(key)?;
        let names = value.as_array().and_then(|list| list.iter().map(|name| name.as_str().map(str::to_owned)).collect());
        if names.is_none() {
            self.fault(key, value.to_string(), "a list of column names such as [\"x_m\", \"y_m\"]");
        }
        names
    }

    pub(super) fn text(&mut self, table: &Table, inside: &str, key: &str) -> Option<String> {
        match table.get(key)? {
            Value::String(text) => Some(text.clone()),
            other => {
                self.fault(&format!("{inside}{key}"), other.to_string(), "text in quotes");
                None
            }
        }
    }

    fn layout(&mut self, table: &Table) -> Layout {
        let delimiter = self.text(table, "", "delimiter").and_then(|word| match word.as_str() {
            "," => Some(','),
            ";" => Some(';'),
            "tab" | "\t" => Some('\t'),
            "whitespace" | " " => Some(' '),
            _ => {
                self.fault("delimiter", format!("`{word}`"), "one of `,`, `;`, `tab`, `whitespace`");
                None
            }
        });
        let header = table.get("header").and_then(|value| {
            if !value.is_bool() {
                self.fault("header", value.to_string(), "true or false");
            }
            value.as_bool()
        });
        Layout { delimiter, header }
    }

    fn rate(&mut self, table: &Table) -> Option<f64> {
        let value = table.get("rate_hz")?;
        let rate = value.as_float().or(value.as_integer().map(|rate| rate as f64)).filter(|rate| *rate > 0.0 && rate.is_finite());
        if rate.is_none() {
            self.fault("rate_hz", value.to_string(), "a positive rate (Hz)");
        }
        rate
    }

    fn source(&mut self, table: &Table) -> ParameterSource {
        let Some(word) = self.text(table, "", "theta") else { return ParameterSource::Given };
        ParameterSource::from_word(&word).unwrap_or_else(|| {
            let known = ParameterSource::ALL.map(ParameterSource::word).join(", ");
            self.fault("theta", format!("`{word}`"), format!("one of {known}"));
            ParameterSource::Given
        })
    }

    /// Parameters come from one place only.
    fn check_parameters(&mut self) {
        let given = self.entries.iter().any(|entry| !entry.theta_m.is_empty());
        let read = self.source != ParameterSource::Given;
        if usize::from(given) + usize::from(read) + usize::from(!self.theta_m.is_empty()) > 1 {
            let expected = "one of: theta = \"start\" …, theta_m = [columns], or theta_m with every [[demonstration]]";
            self.fault("theta_m", "motion parameters from several places", expected);
        }
        if !self.theta_f.is_empty() && self.entries.iter().any(|entry| !entry.theta_f.is_empty()) {
            self.fault("theta_f", "force parameters from several places", "theta_f = [columns], or theta_f with every [[demonstration]]");
        }
    }
}
