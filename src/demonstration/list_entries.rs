//! The `[[demonstration]]` entries of `dataset.toml`, as typed.

use toml::{Table, Value};

use super::Parameters;
use super::list::List;

/// One `[[demonstration]]`.
#[derive(Debug, Default)]
pub(super) struct Entry {
    /// How faults call it.
    pub(super) key: String,
    pub(super) file: Option<String>,
    pub(super) sequence: Option<String>,
    pub(super) theta_m: Parameters,
    pub(super) theta_f: Parameters,
}

impl List {
    pub(super) fn entries(&mut self, table: &Table) -> Vec<Entry> {
        let entries = match table.get("demonstration") {
            Some(Value::Array(entries)) => entries.as_slice(),
            None => &[],
            Some(other) => {
                self.fault("demonstration", other.type_str(), "tables, each headed [[demonstration]]");
                &[]
            }
        };
        entries.iter().enumerate().filter_map(|(i, entry)| self.entry(entry, &format!("demonstration {}", i + 1))).collect()
    }

    fn entry(&mut self, entry: &Value, key: &str) -> Option<Entry> {
        let Some(table) = entry.as_table() else {
            self.fault(key, entry.type_str(), "a table with file, sequence, theta_m, theta_f");
            return None;
        };
        let inside = format!("{key}, ");
        self.check_keys(table, &inside, &["file", "sequence", "theta_m", "theta_f"]);
        let theta_m = self.parameters(table, key, "theta_m");
        let theta_f = self.parameters(table, key, "theta_f");
        let file = self.text(table, &inside, "file");
        let sequence = match table.get("sequence") {
            None => None,
            Some(Value::Integer(label)) => Some(label.to_string()),
            Some(_) => self.text(table, &inside, "sequence"),
        };
        Some(Entry { key: key.to_owned(), file, sequence, theta_m, theta_f })
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
