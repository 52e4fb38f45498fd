//! Values that are no tables of fixed keys: numbers, texts, lists of them, paths.

use std::ops::RangeInclusive;
use std::path::Path;

use super::conform::Conform;
use super::fault::{Code, Fault};
use super::key::{Kind, Length, PathTo};
use super::layer::outside_roots;
use super::measure::{Measure, plain};
use super::source::Origin;
use super::suggest::{other_unit, typed_with_unit};
use super::tree::{Entry, Node, Value};

/// The robots that the program brings along.
pub(super) const BUILTIN_ROBOTS: [&str; 1] = ["builtin:baxter"];

impl Conform<'_> {
    /// The value of a key, if it fits its kind; [`Value::Missing`] and a fault if it does not.
    pub fn plain_value(&mut self, kind: &Kind, typed: Node, path: &str) -> Value {
        match (kind, &typed.value) {
            (Kind::Flag, Value::Flag(_)) | (Kind::Text, Value::Text(_)) => typed.value,
            (Kind::Quantity(_), Value::Text(name)) if is_name(name) => typed.value,
            (Kind::NumberOrWord(_, word) | Kind::CountOrWord(_, _, word), Value::Text(text)) if text == word => typed.value,
            (Kind::Number(measure) | Kind::Quantity(measure) | Kind::NumberOrWord(measure, _), _) => {
                self.number(kind, measure, &typed, path)
            }
            (Kind::Count(min, max) | Kind::CountOrWord(min, max, _), Value::Integer(count)) => {
                self.count(kind, *min..=*max, *count, typed.origin, path)
            }
            (Kind::Vector(measure, length), Value::List(items)) => {
                self.length(*length, items.len(), typed.origin, path);
                Value::List(self.numbers(measure, items, path))
            }
            (Kind::Windows(measure), Value::List(items)) => {
                Value::List(items.iter().map(|item| self.window(measure, item, path)).collect())
            }
            (Kind::Name, Value::Text(name)) => self.name(name, typed.origin, path),
            (Kind::Choice(choices), Value::Text(word)) => self.choice(word, choices.iter().copied(), typed.origin, path),
            (Kind::Reference(_), Value::Text(_)) => typed.value,
            (Kind::References(_) | Kind::Texts, Value::List(items)) => Value::List(self.texts(items, path)),
            (Kind::Path(to), Value::Text(text)) => self.path(*to, text, typed.origin, path),
            (Kind::Folders, Value::List(items)) => {
                let folder = |item: &Node| self.plain_value(&Kind::Path(PathTo::Folder), item.clone(), path);
                let values: Vec<Value> = items.iter().map(folder).collect();
                Value::List(values.into_iter().zip(items).map(|(value, item)| Node::new(value, item.origin)).collect())
            }
            (Kind::Numbers, Value::Table(entries)) => Value::Table(entries.iter().map(|entry| self.free_number(entry, path)).collect()),
            (Kind::Grid, Value::Table(entries)) => Value::Table(entries.iter().map(|entry| self.free_numbers(entry, path)).collect()),
            (Kind::Values, Value::List(items)) => {
                self.not_empty(items.len(), &typed, kind, path);
                typed.value
            }
            (Kind::Ranges, Value::Table(entries)) => {
                let ranges = self.ranges(entries, "", path);
                self.not_empty(ranges.len(), &typed, kind, path);
                Value::Table(ranges)
            }
            _ => {
                self.wrong_type(path, &typed, kind.describe());
                Value::Missing
            }
        }
    }

    /// What varies in nothing varies nothing.
    fn not_empty(&mut self, found: usize, typed: &Node, kind: &Kind, path: &str) {
        if found == 0 {
            let fault = Fault::at(Code::WrongLength, typed.origin, format!("`{path}` has no entries"));
            self.faults.push(fault.expected(kind.describe()));
        }
    }

    /// Ranges under dotted keys; a dotted key without quotes is a table in a table, and means the same.
    fn ranges(&mut self, entries: &[Entry], above: &str, path: &str) -> Vec<Entry> {
        let mut flat = Vec::new();
        for entry in entries {
            let key = if above.is_empty() { entry.key.clone() } else { format!("{above}.{}", entry.key) };
            if let Value::Table(inner) = &entry.node.value {
                flat.extend(self.ranges(inner, &key, path));
                continue;
            }
            let path = format!("{path}.{key}");
            let range = self.window(&Measure::ANY, &entry.node, &path);
            if let [min, max] = range.as_numbers()[..]
                && min > max
            {
                let fault =
                    Fault::at(Code::Order, entry.node.origin, format!("`{path}` begins at {} and ends at {}", plain(min), plain(max)));
                self.faults.push(fault.expected("[min, max]"));
            }
            flat.push(Entry { key, origin: entry.origin, node: range });
        }
        flat
    }

    fn number(&mut self, kind: &Kind, measure: &Measure, typed: &Node, path: &str) -> Value {
        let Some(number) = typed.as_number() else {
            let help = typed.as_text().and_then(|text| typed_with_unit(text, measure));
            let message = format!("`{path}` is {}", typed.value.type_name());
            if typed.value != Value::Missing {
                let fault = Fault::at(Code::WrongType, typed.origin, message);
                self.faults.push(fault.expected(kind.describe()).maybe_help(help));
            }
            return Value::Missing;
        };
        if measure.accepts(number) {
            return Value::Number(number);
        }
        let message = format!("`{path}` is {}", shown(number));
        let expected = if matches!(kind, Kind::NumberOrWord(..)) { kind.describe() } else { measure.describe() };
        let fault = Fault::at(Code::OutOfRange, typed.origin, message).expected(expected);
        self.faults.push(fault.maybe_help(other_unit(number, measure)));
        Value::Missing
    }

    fn count(&mut self, kind: &Kind, range: RangeInclusive<i64>, count: i64, origin: Origin, path: &str) -> Value {
        if range.contains(&count) {
            return Value::Integer(count);
        }
        let fault = Fault::at(Code::OutOfRange, origin, format!("`{path}` is {count}"));
        self.faults.push(fault.expected(kind.describe()));
        Value::Missing
    }

    fn numbers(&mut self, measure: &Measure, items: &[Node], path: &str) -> Vec<Node> {
        let kind = Kind::Number(*measure);
        items.iter().map(|item| Node::new(self.number(&kind, measure, item, path), item.origin)).collect()
    }

    fn length(&mut self, length: Length, found: usize, origin: Origin, path: &str) {
        let fits = match length {
            Length::Exactly(count) => found == count,
            Length::AtLeast(count) => found >= count,
        };
        if !fits {
            let fault = Fault::at(Code::WrongLength, origin, format!("`{path}` has {found} entries"));
            self.faults.push(fault.expected(length.describe()));
        }
    }

    fn window(&mut self, measure: &Measure, item: &Node, path: &str) -> Node {
        Node::new(self.plain_value(&Kind::Vector(*measure, Length::Exactly(2)), item.clone(), path), item.origin)
    }

    fn name(&mut self, name: &str, origin: Origin, path: &str) -> Value {
        if is_name(name) {
            return Value::Text(name.to_owned());
        }
        let fault = Fault::at(Code::WrongType, origin, format!("`{path}` is {name:?}, which cannot be a name"));
        self.faults.push(fault.expected(Kind::Name.describe()));
        Value::Missing
    }

    fn texts(&mut self, items: &[Node], path: &str) -> Vec<Node> {
        for item in items.iter().filter(|item| item.as_text().is_none()) {
            self.wrong_type(path, item, "a list of names");
        }
        items.iter().filter(|item| item.as_text().is_some()).cloned().collect()
    }

    /// A number under a name that the scenario chooses.
    fn free_number(&mut self, entry: &Entry, path: &str) -> Entry {
        self.name(&entry.key, entry.origin, path);
        let value = self.number(&Kind::Number(Measure::ANY), &Measure::ANY, &entry.node, &format!("{path}.{}", entry.key));
        Entry { node: Node::new(value, entry.node.origin), ..entry.clone() }
    }

    fn free_numbers(&mut self, entry: &Entry, path: &str) -> Entry {
        let kind = Kind::Vector(Measure::ANY, Length::AtLeast(1));
        let value = self.plain_value(&kind, entry.node.clone(), &format!("{path}.{}", entry.key));
        Entry { node: Node::new(value, entry.node.origin), ..entry.clone() }
    }

    /// A path, resolved against the folder of the text in which it was typed.
    fn path(&mut self, to: PathTo, text: &str, origin: Origin, path: &str) -> Value {
        if to == PathTo::Robot && text.starts_with("builtin:") {
            return self.choice(text, BUILTIN_ROBOTS.into_iter(), origin, path);
        }
        let resolved = self.sources.get(origin.source).directory.join(Path::new(text));
        if let (false, Err(outside)) = (self.sources.is_override(origin), self.roots.check(&resolved)) {
            self.faults.push(outside_roots(origin, &outside));
        } else if !resolved.exists() {
            let fault = Fault::at(Code::Unreadable, origin, format!("`{path}` names {}, which does not exist", resolved.display()));
            self.faults.push(fault.expected(Kind::Path(to).describe()));
        }
        Value::Text(resolved.display().to_string())
    }
}

/// Whether a text can name something: it also names folders and parts of dotted keys.
fn is_name(text: &str) -> bool {
    (1..=64).contains(&text.len()) && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-')
}

fn shown(number: f64) -> String {
    if number.is_finite() { plain(number) } else { format!("{number:?}, which is not a finite number").replace("NaN", "nan") }
}
