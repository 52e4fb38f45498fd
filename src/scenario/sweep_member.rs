//! One member of a sweep: which values its keys have, and the scenario that comes of them.

use super::diagnostic::InvalidScenario;
use super::load::Scenario;
use super::resolved::literal;
use super::tree::{Node, Value};

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

/// `KEY=VALUE` of a key that varies. A path is taken as it was filled in: it is seen from the current folder there, not from the file's.
pub(super) fn override_of(key: &str, typed: &Node, filled: &Node) -> String {
    let found = key.split('.').try_fold(filled, |node, step| node.step(step.trim()));
    let node = found.filter(|node| node.as_text().is_some()).unwrap_or(typed);
    format!("{}={}", key.trim(), literal(node))
}
