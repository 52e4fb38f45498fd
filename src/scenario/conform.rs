//! A typed tree against the table of keys: every type and range checked, every default filled in, every unknown key named.

use super::fault::{Code, ENOUGH, Fault};
use super::key::{Key, Kind, Preset, Shape};
use super::roots::Roots;
use super::schema::SCENARIO;
use super::source::{Origin, Sources};
use super::suggest::{did_you_mean, name_list};
use super::tree::{Entry, Node, Value};

/// Most tables in one list.
const MAX_ITEMS: usize = 1000;

/// Compares trees with shapes and collects what does not fit.
pub(super) struct Conform<'a> {
    pub sources: &'a Sources,
    pub roots: &'a Roots,
    pub faults: &'a mut Vec<Fault>,
}

impl Conform<'_> {
    /// The table with all keys of its shape, in the shape's order. What is absent or faulty is [`Value::Missing`].
    pub fn table(&mut self, typed: Node, shape: &Shape, path: &str) -> Node {
        let origin = typed.origin;
        let Value::Table(mut entries) = typed.value else {
            self.wrong_type(path, &typed, "a table");
            return Node::missing(origin);
        };
        let kind = kind_of(&entries, shape);
        let mut filled = Vec::new();
        for key in shape.keys_of(kind.as_deref()) {
            let entry = entries.iter().position(|entry| entry.key == key.name).map(|index| entries.remove(index));
            filled.push(self.entry(key, shape, entry, origin, path));
        }
        let kind_origin = filled.iter().find(|entry| entry.key == "kind").map_or(origin, |entry| entry.node.origin);
        for entry in entries {
            self.unknown(&entry, shape, kind.as_deref(), kind_origin, path);
        }
        Node::new(Value::Table(filled), origin)
    }

    fn entry(&mut self, key: &Key, shape: &Shape, typed: Option<Entry>, table: Origin, path: &str) -> Entry {
        let path = join(path, key.name);
        let (origin, node) = match typed {
            Some(entry) => (entry.origin, self.value(key, shape, entry.node, &path)),
            None => (table, self.absent(key, table, &path)),
        };
        Entry { key: key.name.to_owned(), origin, node }
    }

    /// What stands for a key that was not typed.
    fn absent(&mut self, key: &Key, table: Origin, path: &str) -> Node {
        let value = match key.preset {
            Preset::Required => {
                let fault = Fault::at(Code::MissingKey, table, format!("`{path}` is missing"));
                self.faults.push(fault.expected(format!("{}: {}", key.kind.describe(), key.meaning)));
                Value::Missing
            }
            Preset::Optional => Value::Missing,
            Preset::Flag(flag) => Value::Flag(flag),
            Preset::Count(count) => Value::Integer(count),
            Preset::Number(number) => Value::Number(number),
            Preset::Text(text) => Value::Text(text.to_owned()),
            Preset::Vector(numbers) => Value::List(numbers.iter().map(|&number| Node::new(Value::Number(number), table)).collect()),
            Preset::Empty => match key.kind {
                Kind::Section(shape) => return self.table(Node::new(Value::Table(Vec::new()), table), &shape, path),
                Kind::Numbers | Kind::Grid => Value::Table(Vec::new()),
                _ => Value::List(Vec::new()),
            },
        };
        Node::new(value, table)
    }

    fn value(&mut self, key: &Key, shape: &Shape, typed: Node, path: &str) -> Node {
        let origin = typed.origin;
        let value = match (&key.kind, typed.value) {
            // What could not be read is reported already.
            (_, Value::Missing) => Value::Missing,
            (Kind::Section(inner), value) => return self.table(Node::new(value, origin), inner, path),
            (Kind::List(inner), Value::List(items)) => Value::List(self.items(inner, items, path)),
            (Kind::Tag, Value::Text(kind)) => self.choice(&kind, shape.variants.iter().map(|variant| variant.kind), origin, path),
            (_, value) => self.plain_value(&key.kind, Node::new(value, origin), path),
        };
        Node::new(value, origin)
    }

    fn items(&mut self, shape: &Shape, mut items: Vec<Node>, path: &str) -> Vec<Node> {
        if let Some(first_too_many) = items.get(MAX_ITEMS) {
            let fault = Fault::at(Code::WrongLength, first_too_many.origin, format!("`{path}` has {} items", items.len()));
            self.faults.push(fault.expected(format!("at most {MAX_ITEMS}")));
            items.truncate(MAX_ITEMS);
        }
        let path_of = |(index, item): (usize, &Node)| match item.name() {
            Some(name) => format!("{path}.{name}"),
            None => format!("{path}.{index}"),
        };
        let paths: Vec<String> = items.iter().enumerate().map(path_of).collect();
        items.into_iter().zip(paths).map(|(item, path)| self.table(item, shape, &path)).collect()
    }

    /// One word out of some.
    pub fn choice<'b>(&mut self, word: &str, choices: impl Iterator<Item = &'b str> + Clone, origin: Origin, path: &str) -> Value {
        if choices.clone().any(|choice| choice == word) {
            return Value::Text(word.to_owned());
        }
        let fault = Fault::at(Code::UnknownName, origin, format!("`{path}` cannot be `{word}`"));
        self.faults.push(fault.expected(format!("one of {}", name_list(choices.clone()))).maybe_help(did_you_mean(word, choices)));
        Value::Missing
    }

    fn unknown(&mut self, entry: &Entry, shape: &Shape, kind: Option<&str>, kind_origin: Origin, path: &str) {
        let owners = || shape.variants.iter().filter(|variant| variant.keys.iter().any(|key| key.name == entry.key));
        if let Some(owner) = owners().next() {
            // A layer below spoke of another kind: the layer that chose this kind leaves those keys behind.
            if kind.is_none() || self.sources.rank(entry.origin) < self.sources.rank(kind_origin) {
                return;
            }
            let message = format!("`{}` means nothing for kind `{}`", join(path, &entry.key), kind.unwrap_or_default());
            let fault = Fault::at(Code::UnknownKey, entry.origin, message).expected(known(shape, kind));
            return self.faults.push(fault.help(format!("it belongs to kind `{}`", owner.kind)));
        }
        let fault = Fault::at(Code::UnknownKey, entry.origin, format!("unknown key `{}`", join(path, &entry.key)));
        if self.faults.len() > ENOUGH {
            return self.faults.push(fault);
        }
        let names = shape.keys_of(kind).map(|key| key.name);
        let help = owner_of(&entry.key, &SCENARIO, "").or_else(|| did_you_mean(&entry.key, names));
        self.faults.push(fault.expected(known(shape, kind)).maybe_help(help));
    }

    /// Reports a value of the wrong type.
    pub fn wrong_type(&mut self, path: &str, typed: &Node, expected: impl Into<String>) {
        if typed.value != Value::Missing {
            let message = format!("`{path}` is {}", typed.value.type_name());
            self.faults.push(Fault::at(Code::WrongType, typed.origin, message).expected(expected));
        }
    }
}

/// The `kind` that was typed, or the one that stands for it, if it is one of the shape's.
fn kind_of(entries: &[Entry], shape: &Shape) -> Option<String> {
    let preset = shape.keys.iter().find_map(|key| match (key.kind, key.preset) {
        (Kind::Tag, Preset::Text(text)) => Some(text),
        _ => None,
    });
    let typed = match entries.iter().find(|entry| entry.key == "kind") {
        Some(entry) => entry.node.as_text(),
        None => preset,
    };
    typed.filter(|kind| shape.variant(kind).is_some()).map(str::to_owned)
}

fn known(shape: &Shape, kind: Option<&str>) -> String {
    format!("one of {}", name_list(shape.keys_of(kind).map(|key| key.name)))
}

/// Help for a key that stands in the wrong table: where it belongs.
fn owner_of(name: &str, shape: &Shape, path: &str) -> Option<String> {
    let inner = |key: &Key| match &key.kind {
        Kind::Section(inner) => owner_of(name, inner, &join(path, key.name)),
        Kind::List(inner) => owner_of(name, inner, &format!("[{}]", join(path, key.name))),
        _ => None,
    };
    if shape.keys.iter().any(|key| key.name == name) {
        return Some(if path.is_empty() {
            "it belongs to the top of the file, before the first [table]".to_owned()
        } else {
            let whole = if path.starts_with('[') { String::new() } else { format!(": `{path}.{name}`") };
            format!("it belongs to [{path}]{whole}")
        });
    }
    let variant = shape.variants.iter().find(|variant| variant.keys.iter().any(|key| key.name == name));
    let of_variant = variant.map(|variant| format!("it belongs to [{path}] of kind `{}`", variant.kind));
    of_variant.or_else(|| shape.keys.iter().find_map(inner))
}

/// A dotted path as messages show it, and as `--set` takes it.
fn join(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }
}
