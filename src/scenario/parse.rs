//! TOML text to a tree of values with their places; all faults of the text at once.

use toml::Spanned;
use toml::de::{DeInteger, DeTable, DeValue};

use super::fault::{Code, Fault};
use super::source::{Origin, SourceId};
use super::tree::{Entry, Node, Value};

/// Longest text (bytes) of which every syntax error is told; of a longer one the first, because each costs a kilobyte and some time.
const ALL_ERRORS_UP_TO: usize = 1 << 15;

/// Reads a whole document.
pub(super) fn document(text: &str, source: SourceId, faults: &mut Vec<Fault>) -> Node {
    let (table, errors) = match DeTable::parse(text) {
        Ok(table) => (table, Vec::new()),
        Err(_) if text.len() <= ALL_ERRORS_UP_TO => DeTable::parse_recoverable(text),
        Err(error) => (Spanned::new(0..0, DeTable::new()), vec![error]),
    };
    let place = Place { source, offset: 0 };
    for error in &errors {
        faults.push(syntax_fault(error, place, text.len()));
    }
    let origin = Origin { source, start: 0, end: 0 };
    Node::new(Value::Table(place.entries(table.into_inner(), faults)), origin)
}

/// Reads one value that starts `offset` bytes into its source; `None` when the text is no TOML value.
pub(super) fn value(text: &str, source: SourceId, offset: usize, faults: &mut Vec<Fault>) -> Option<Node> {
    let value = DeValue::parse(text).ok()?;
    Some(Place { source, offset }.node(value, faults))
}

fn syntax_fault(error: &toml::de::Error, place: Place, length: usize) -> Fault {
    let span = error.span().unwrap_or(length..length);
    Fault::at(Code::Syntax, place.origin(span), format!("this is not TOML: {}", error.message()))
}

/// Turns spans of the parser into origins.
#[derive(Clone, Copy)]
struct Place {
    source: SourceId,
    offset: usize,
}

impl Place {
    fn origin(self, span: std::ops::Range<usize>) -> Origin {
        Origin { source: self.source, start: span.start + self.offset, end: span.end + self.offset }
    }

    /// Entries in the order in which they were typed.
    fn entries(self, table: DeTable<'_>, faults: &mut Vec<Fault>) -> Vec<Entry> {
        let mut entries: Vec<Entry> = table
            .into_iter()
            .map(|(key, value)| Entry {
                origin: self.origin(key.span()),
                key: key.into_inner().into_owned(),
                node: self.node(value, faults),
            })
            .collect();
        entries.sort_by_key(|entry| entry.origin.start);
        entries
    }

    fn node(self, spanned: Spanned<DeValue<'_>>, faults: &mut Vec<Fault>) -> Node {
        let origin = self.origin(spanned.span());
        let value = match spanned.into_inner() {
            DeValue::String(text) => Value::Text(text.into_owned()),
            DeValue::Integer(integer) => integer_value(&integer, origin, faults),
            DeValue::Float(float) => match float.as_str().parse::<f64>() {
                Ok(number) => Value::Number(number),
                Err(_) => Value::Missing,
            },
            DeValue::Boolean(flag) => Value::Flag(flag),
            DeValue::Datetime(_) => Value::Date,
            DeValue::Array(items) => Value::List(items.into_iter().map(|item| self.node(item, faults)).collect()),
            DeValue::Table(table) => Value::Table(self.entries(table, faults)),
        };
        Node::new(value, origin)
    }
}

fn integer_value(integer: &DeInteger<'_>, origin: Origin, faults: &mut Vec<Fault>) -> Value {
    match i64::from_str_radix(integer.as_str(), integer.radix()) {
        Ok(number) => Value::Integer(number),
        Err(_) => {
            faults.push(Fault::at(Code::OutOfRange, origin, format!("the whole number {integer} does not fit into 64 bits")));
            Value::Missing
        }
    }
}
