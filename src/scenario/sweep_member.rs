//! One member of a sweep: which values its keys have, and the scenario that comes of them.

use super::diagnostic::InvalidScenario;
use super::load::Scenario;
use super::resolved::literal;
use super::tree::{Entry, Node, Value};

/// One member of a sweep.
#[derive(Clone, Debug)]
pub struct Member {
    /// Its number, from 0.
    pub index: u64,
    /// The keys that vary, with this member's values. The seed is in the scenario.
    pub settings: Vec<(String, Setting)>,
    /// The same as overrides for `cpdmp run --set`, with paths as they are seen from the current folder.
    pub overrides: Vec<String>,
    /// What is run.
    pub scenario: Scenario,
}

/// The value of a key that varies.
#[derive(Clone, Debug, PartialEq)]
pub enum Setting {
    /// True or false.
    Flag(bool),
    /// A whole number.
    Whole(i64),
    /// A number.
    Number(f64),
    /// A text; a list as TOML.
    Text(String),
}

/// Why a member cannot be run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("member {index} ({settings}): {invalid}")]
pub struct InvalidMember {
    /// Its number, from 0.
    pub index: u64,
    /// Its values, as `KEY=VALUE, …`.
    pub settings: String,
    /// What is wrong with the scenario that comes of them.
    pub invalid: InvalidScenario,
}

impl Setting {
    pub(super) fn of(node: &Node) -> Self {
        match &node.value {
            Value::Flag(flag) => Self::Flag(*flag),
            Value::Integer(whole) => Self::Whole(*whole),
            Value::Number(number) => Self::Number(*number),
            Value::Text(text) => Self::Text(text.clone()),
            _ => Self::Text(literal(node)),
        }
    }
}

/// `KEY=VALUE` of a key that varies. Paths in it are taken as they were filled in: they are seen from the current folder there, not from the file's.
pub(super) fn override_of(key: &str, typed: &Node, filled: &Node) -> String {
    let found = key.split('.').try_fold(filled, |node, step| node.step(step.trim()));
    let node = found.map_or_else(|| typed.clone(), |filled| with_texts_of(typed, filled));
    format!("{}={}", key.trim(), literal(&node))
}

/// What was typed, with every text as it was filled in.
fn with_texts_of(typed: &Node, filled: &Node) -> Node {
    let value = match (&typed.value, &filled.value) {
        (Value::Text(_), Value::Text(text)) => Value::Text(text.clone()),
        (Value::Table(entries), _) => {
            let entry = |entry: &Entry| {
                let node = filled.get(&entry.key).map_or_else(|| entry.node.clone(), |filled| with_texts_of(&entry.node, filled));
                Entry { node, ..entry.clone() }
            };
            Value::Table(entries.iter().map(entry).collect())
        }
        (Value::List(items), Value::List(others)) if items.len() == others.len() => {
            Value::List(items.iter().zip(others).map(|(item, other)| with_texts_of(item, other)).collect())
        }
        (value, _) => value.clone(),
    };
    Node::new(value, typed.origin)
}
