//! A scenario as a tree of values, each of which knows where it was typed.

use super::source::Origin;

/// A value and where it was typed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    pub value: Value,
    pub origin: Origin,
}

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    /// Not there, or of no use because of a fault that is already reported.
    Missing,
    Flag(bool),
    Integer(i64),
    Number(f64),
    Text(String),
    /// A date or a time; no key takes one.
    Date,
    List(Vec<Node>),
    Table(Vec<Entry>),
}

/// One key of a table with its value.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    pub key: String,
    /// Where the key was typed.
    pub origin: Origin,
    pub node: Node,
}

impl Value {
    /// What messages call a value of this type.
    pub fn type_name(&self) -> &'static str {
        match self {
            Self::Missing => "nothing",
            Self::Flag(_) => "true or false",
            Self::Integer(_) => "a whole number",
            Self::Number(_) => "a number",
            Self::Text(_) => "text",
            Self::Date => "a date",
            Self::List(_) => "a list",
            Self::Table(_) => "a table",
        }
    }
}

impl Node {
    /// A node.
    pub fn new(value: Value, origin: Origin) -> Self {
        Self { value, origin }
    }

    /// A place that holds nothing.
    pub fn missing(origin: Origin) -> Self {
        Self { value: Value::Missing, origin }
    }

    /// The entries of a table; none of anything else.
    pub fn entries(&self) -> &[Entry] {
        if let Value::Table(entries) = &self.value { entries } else { &[] }
    }

    /// The entry `key` of a table.
    pub fn entry(&self, key: &str) -> Option<&Entry> {
        self.entries().iter().find(|entry| entry.key == key)
    }

    /// The value of the key `key` of a table, unless it is missing.
    pub fn get(&self, key: &str) -> Option<&Node> {
        self.entry(key).map(|entry| &entry.node).filter(|node| node.value != Value::Missing)
    }

    /// The items of a list; none of anything else.
    pub fn items(&self) -> &[Node] {
        if let Value::List(items) = &self.value { items } else { &[] }
    }

    /// The part that one step of a dotted key leads to: a key of a table, an item of a list by its name or by its number from 0.
    pub fn step(&self, name: &str) -> Option<&Node> {
        self.get(name).or_else(|| self.items().get(index_of(self.items(), name)?))
    }

    /// The text, if it is one.
    pub fn as_text(&self) -> Option<&str> {
        if let Value::Text(text) = &self.value { Some(text) } else { None }
    }

    /// The number, if it is one.
    pub fn as_number(&self) -> Option<f64> {
        match self.value {
            Value::Number(number) => Some(number),
            Value::Integer(integer) => Some(integer as f64),
            _ => None,
        }
    }

    /// The `name` of a table, if it has one.
    pub fn name(&self) -> Option<&str> {
        self.get("name").and_then(Node::as_text)
    }

    /// The numbers of a list.
    pub fn as_numbers(&self) -> Vec<f64> {
        self.items().iter().filter_map(Node::as_number).collect()
    }

    /// Takes the value of the key `key` out of a table.
    pub fn take(&mut self, key: &str) -> Option<Entry> {
        let Value::Table(entries) = &mut self.value else { return None };
        let index = entries.iter().position(|entry| entry.key == key)?;
        Some(entries.remove(index))
    }
}

/// The number of the item that is called by its name, or by its number from 0.
pub(super) fn index_of(items: &[Node], name: &str) -> Option<usize> {
    let by_name = items.iter().position(|item| item.name() == Some(name));
    by_name.or_else(|| name.parse().ok().filter(|&index: &usize| index < items.len()))
}
