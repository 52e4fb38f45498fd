//! A dataset from its folder: `dataset.toml` and one CSV file per demonstration.

use std::path::{Component, Path};

use toml::{Table, Value};

use super::{Dataset, Demonstration, DemonstrationError, Fault, ParameterSource, Parameters, csv};

const LIST: &str = "dataset.toml";
const SCHEMA_VERSION: i64 = 1;

impl Dataset {
    /// Reads the dataset in a folder.
    ///
    /// # Errors
    /// When `dataset.toml` cannot be opened; otherwise every fault of the list and of all demonstrations at once.
    pub fn read(folder: &Path) -> Result<Self, DemonstrationError> {
        let path = folder.join(LIST);
        let text = std::fs::read_to_string(&path).map_err(DemonstrationError::io(&path))?;
        let table: Table = match text.strip_prefix('\u{feff}').unwrap_or(&text).parse() {
            Ok(table) => table,
            Err(error) => return Err(DemonstrationError::Invalid(vec![Fault::new(LIST, error.to_string().trim_end(), "TOML")])),
        };
        let mut list = List { faults: Vec::new() };
        list.check_version(&table);
        list.check_keys(&table, "", &["schema_version", "motion", "wrench", "demonstration"]);
        let motion = list.names(&table, "motion");
        let wrench = list.names(&table, "wrench");
        let demonstrations = list.demonstrations(&table, folder);
        let dataset = Self { motion, wrench, parameter_source: ParameterSource::Given, demonstrations };
        let mut faults = list.faults;
        if faults.is_empty()
            && let Err(DemonstrationError::Invalid(more)) = dataset.check()
        {
            faults = more;
        }
        if faults.is_empty() { Ok(dataset) } else { Err(DemonstrationError::Invalid(faults)) }
    }
}

/// Reads keys of `dataset.toml` and notes what is wrong with them.
struct List {
    faults: Vec<Fault>,
}

impl List {
    fn fault(&mut self, key: &str, found: impl Into<String>, expected: impl Into<String>) {
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

    fn check_keys(&mut self, table: &Table, inside: &str, known: &[&str]) {
        for key in table.keys().filter(|key| !known.contains(&key.as_str())) {
            self.fault(&format!("{inside}{key}"), "an unknown key", format!("one of {}", known.join(", ")));
        }
    }

    /// A list of column names; absent means empty.
    fn names(&mut self, table: &Table, key: &str) -> Vec<String> {
        let Some(value) = table.get(key) else { return Vec::new() };
        let names = value.as_array().and_then(|list| list.iter().map(|name| name.as_str().map(str::to_owned)).collect());
        names.unwrap_or_else(|| {
            self.fault(key, value.to_string(), "a list of column names such as [\"x_m\", \"y_m\"]");
            Vec::new()
        })
    }

    fn demonstrations(&mut self, table: &Table, folder: &Path) -> Vec<Demonstration> {
        let entries = match table.get("demonstration") {
            Some(Value::Array(entries)) => entries.as_slice(),
            None => &[],
            Some(other) => {
                self.fault("demonstration", other.type_str(), "tables, each headed [[demonstration]]");
                &[]
            }
        };
        let read = entries.iter().enumerate().map(|(i, entry)| self.demonstration(entry, i, folder));
        let demonstrations: Vec<Demonstration> = read.collect::<Vec<_>>().into_iter().flatten().collect();
        for (i, demonstration) in demonstrations.iter().enumerate() {
            if demonstrations[..i].iter().any(|other| other.name == demonstration.name) {
                self.fault("demonstration", format!("{} twice", demonstration.name), "every file once");
            }
        }
        demonstrations
    }

    fn demonstration(&mut self, entry: &Value, index: usize, folder: &Path) -> Option<Demonstration> {
        let key = format!("demonstration {}", index + 1);
        let Some(table) = entry.as_table() else {
            self.fault(&key, entry.type_str(), "a table with file, theta_m, theta_f");
            return None;
        };
        self.check_keys(table, &format!("{key}, "), &["file", "theta_m", "theta_f"]);
        let theta_m = self.parameters(table, &key, "theta_m");
        let theta_f = self.parameters(table, &key, "theta_f");
        let Some(file) = table.get("file").and_then(Value::as_str) else {
            self.fault(&key, "no file name", "file = \"NAME.csv\"");
            return None;
        };
        let plain = Path::new(file).components().all(|part| matches!(part, Component::Normal(_)));
        if !plain || !file.ends_with(".csv") {
            self.fault(&key, format!("file = \"{file}\""), "a .csv file inside the dataset's folder");
            return None;
        }
        match csv::read(&folder.join(file), file) {
            Ok(trajectory) => {
                let name = file.trim_end_matches(".csv").to_owned();
                Some(Demonstration { name, trajectory, theta_m, theta_f })
            }
            Err(DemonstrationError::Invalid(faults)) => {
                self.faults.extend(faults);
                None
            }
            Err(error @ DemonstrationError::Io { .. }) => {
                self.fault(&key, error.to_string(), "a file that can be read");
                None
            }
        }
    }

    /// Parameters sorted by name; absent means none.
    fn parameters(&mut self, table: &Table, key: &str, name: &str) -> Parameters {
        let entries = match table.get(name) {
            Some(Value::Table(entries)) => entries,
            None => return Vec::new(),
            Some(other) => {
                self.fault(&format!("{key}, {name}"), other.to_string(), "a table such as { block_height_m = 0.17 }");
                return Vec::new();
            }
        };
        let mut parameters = Vec::new();
        for (parameter, value) in entries {
            match value {
                Value::Float(number) if number.is_finite() => parameters.push((parameter.clone(), *number)),
                Value::Integer(number) => parameters.push((parameter.clone(), *number as f64)),
                other => self.fault(&format!("{key}, {name}.{parameter}"), other.to_string(), "a finite number"),
            }
        }
        parameters.sort_by(|a, b| a.0.cmp(&b.0));
        parameters
    }
}
