//! `[columns]` of `dataset.toml`: other people's names, units and quaternion orders brought to those of this project.

use toml::{Table as Toml, Value};

use super::list::LIST;
use super::notes::Notes;
use super::table::{Column, Table};
use super::{Fault, QUATERNION_COLUMNS, unit};

/// One target column and where it comes from.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Mapping {
    target: String,
    source: Source,
    /// Unit of the source, if it was given, and its factor to SI.
    unit: Option<(String, f64)>,
}

impl Mapping {
    fn in_words(&self) -> String {
        let unit = self.unit.as_ref().map_or_else(String::new, |(unit, factor)| format!(" in {unit} (times {factor})"));
        format!("{} from {}{unit}", self.target, self.source.in_words())
    }
}

/// A column of the file, by name or by its place counted from 0.
#[derive(Debug, Clone, PartialEq)]
enum Source {
    Name(String),
    Place(usize),
}

impl Source {
    fn typed(value: &Value) -> Option<Self> {
        match value {
            Value::String(name) => Some(Self::Name(name.clone())),
            Value::Integer(place) => usize::try_from(*place).ok().map(Self::Place),
            _ => None,
        }
    }

    fn find(&self, table: &Table) -> Option<usize> {
        match self {
            Self::Name(name) => table.columns.iter().position(|column| column.name == *name),
            Self::Place(place) => (*place < table.columns.len()).then_some(*place),
        }
    }

    fn in_words(&self) -> String {
        match self {
            Self::Name(name) => format!("`{name}`"),
            Self::Place(place) => format!("{place} (counted from 0)"),
        }
    }
}

/// Reads `[columns]`.
pub(super) fn typed(table: &Toml, faults: &mut Vec<Fault>) -> Vec<Mapping> {
    let mut fault = |key: &str, found: String, expected: &str| faults.push(Fault::new(&format!("{LIST}, {key}"), found, expected));
    let entries = match table.get("columns") {
        None => return Vec::new(),
        Some(Value::Table(entries)) => entries,
        Some(other) => {
            fault("columns", other.type_str().to_owned(), "a table [columns] with lines such as x_m = \"px\"");
            return Vec::new();
        }
    };
    let mut mappings = Vec::new();
    for (target, value) in entries {
        let read = if target == "quaternion" { quaternion(value) } else { single(target, value).map(|mapping| vec![mapping]) };
        match read {
            Ok(read) => mappings.extend(read),
            Err(expected) => fault(&format!("columns.{target}"), value.to_string(), &expected),
        }
    }
    mappings
}

fn single(target: &str, value: &Value) -> Result<Mapping, String> {
    let expected = || "\"px\", a place from 0, or { from = \"px\", unit = \"mm\" }".to_owned();
    let (from, unit) = match value {
        Value::Table(table) => {
            if table.keys().any(|key| key != "from" && key != "unit") {
                return Err(expected());
            }
            let unit = table.get("unit").map(|unit| unit.as_str().ok_or_else(expected)).transpose()?;
            (table.get("from").ok_or_else(expected)?, unit)
        }
        other => (other, None),
    };
    let source = Source::typed(from).ok_or_else(expected)?;
    let unit = unit.map(|name| unit::factor(name, target).map(|factor| (name.to_owned(), factor))).transpose()?;
    Ok(Mapping { target: target.to_owned(), source, unit })
}

fn quaternion(value: &Value) -> Result<Vec<Mapping>, String> {
    let expected = || "{ from = [\"qw\", \"qx\", \"qy\", \"qz\"], order = \"wxyz\" }, or the order \"xyzw\"".to_owned();
    let table = value.as_table().filter(|t| t.keys().all(|key| key == "from" || key == "order")).ok_or_else(expected)?;
    let order = match table.get("order").and_then(Value::as_str) {
        Some("xyzw") => [0, 1, 2, 3],
        Some("wxyz") => [3, 0, 1, 2],
        _ => return Err(expected()),
    };
    let from = table.get("from").and_then(Value::as_array).filter(|from| from.len() == 4).ok_or_else(expected)?;
    let sources = from.iter().map(Source::typed).collect::<Option<Vec<_>>>().ok_or_else(expected)?;
    let mapping = |(source, place): (Source, usize)| Mapping { target: QUATERNION_COLUMNS[place].to_owned(), source, unit: None };
    Ok(sources.into_iter().zip(order).map(mapping).collect())
}

/// The table with the mapped columns first; what has no mapping follows under its own name, if it has one. Notes say what was done.
pub(super) fn applied(table: Table, mappings: &[Mapping], notes: &mut Notes) -> Result<Table, Vec<Fault>> {
    let (mut columns, mut used) = (Vec::new(), vec![false; table.columns.len()]);
    let (mut told, mut faults) = (Vec::new(), Vec::new());
    for mapping in mappings {
        let Some(place) = mapping.source.find(&table) else {
            let (found, place) = (format!("no column {}", mapping.source.in_words()), format!("{}, {LIST}, columns", table.place));
            faults.push(Fault::new(&place, found, format!("one of {}", table.names())).in_column(&mapping.target));
            continue;
        };
        used[place] = true;
        columns.push(converted(&table.columns[place], mapping));
        told.push(mapping.in_words());
    }
    if !told.is_empty() {
        notes.add(&table.place, format!("columns {}", told.join(", ")));
    }
    let rest = || table.columns.iter().zip(&used).filter(|(_, used)| !**used).map(|(column, _)| column);
    if table.header {
        for column in rest() {
            if mappings.iter().any(|mapping| mapping.target == column.name) {
                let expected = "a target of its own for every column, or an entry under [columns] that renames this one";
                faults.push(Fault::new(&table.place, "a column that another one is mapped to", expected).in_column(&column.name));
            }
            columns.push(column.clone());
        }
    } else if rest().count() > 0 {
        let left_out: Vec<&str> = rest().map(|column| column.name.as_str()).collect();
        notes.add(&table.place, format!("columns {} (counted from 0) have no name and are left out", left_out.join(", ")));
    }
    if !table.header && mappings.is_empty() {
        let expected = "a header such as time_s,x_m,y_m, or header = false and [columns] with places such as x_m = 1";
        faults.push(Fault::new(&table.place, "numbers in the first line", expected).at_row(1));
    }
    if faults.is_empty() { Ok(Table { columns, ..table }) } else { Err(faults) }
}

fn converted(column: &Column, mapping: &Mapping) -> Column {
    let factor = mapping.unit.as_ref().map_or(1.0, |(_, factor)| *factor);
    let values = column.values.iter().map(|value| value * factor).collect();
    Column { name: mapping.target.clone(), values, odd: column.odd.clone() }
}
