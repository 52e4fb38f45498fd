//! The resolved scenario: every key with its value and its meaning, defaults included, as TOML that can be run again.

use std::fmt::Write;
use std::path::Path;

use super::key::{Key, Kind, Shape};
use super::measure::Measure;
use super::roots::resolve;
use super::schema::SCENARIO;
use super::tree::{Node, Value};

/// The filled scenario as TOML.
pub(super) fn write(scenario: &Node) -> String {
    let mut text = String::from("# Resolved by cpdmp: every key of the scenario, with the defaults written out.\n");
    table(&mut text, scenario, &SCENARIO, "");
    text
}

/// Keys with plain values first, then the tables within, as TOML asks.
fn table(text: &mut String, node: &Node, shape: &Shape, path: &str) {
    let kind = node.get("kind").and_then(Node::as_text);
    for key in shape.keys_of(kind).filter(|key| !is_table(key)) {
        line(text, key, node.get(key.name));
    }
    for key in shape.keys_of(kind).filter(|key| is_table(key)) {
        let Some(value) = node.get(key.name) else { continue };
        let path = if path.is_empty() { key.name.to_owned() } else { format!("{path}.{}", key.name) };
        match &key.kind {
            Kind::List(inner) => {
                for item in value.items() {
                    heading(text, &format!("[[{path}]]"), key.meaning);
                    table(text, item, inner, &path);
                }
            }
            Kind::Section(inner) => {
                heading(text, &format!("[{path}]"), key.meaning);
                table(text, value, inner, &path);
            }
            _ => {
                heading(text, &format!("[{path}]"), key.meaning);
                for entry in value.entries() {
                    push(text, format_args!("{} = {}\n", entry.key, literal(&entry.node)));
                }
            }
        }
    }
}

fn is_table(key: &Key) -> bool {
    matches!(key.kind, Kind::Section(_) | Kind::List(_) | Kind::Numbers | Kind::Grid)
}

fn heading(text: &mut String, brackets: &str, meaning: &str) {
    push(text, format_args!("\n{brackets}  # {meaning}\n"));
}

fn line(text: &mut String, key: &Key, value: Option<&Node>) {
    let about = format!("{}{}", key.meaning, range(&key.kind));
    match value {
        None => push(text, format_args!("# {} is not set: {about}\n", key.name)),
        Some(node) => {
            let typed = match key.kind {
                Kind::Path(_) => path_literal(node),
                Kind::Folders => format!("[{}]", node.items().iter().map(path_literal).collect::<Vec<_>>().join(", ")),
                _ => literal(node),
            };
            push(text, format_args!("{:<40} # {about}\n", format!("{} = {typed}", key.name)));
        }
    }
}

fn range(kind: &Kind) -> String {
    let of = |measure: &Measure| format!(" ({})", measure.describe());
    match kind {
        Kind::NumberOrWord(measure, word) => format!(" ({}, or \"{word}\")", measure.describe()),
        Kind::Number(measure) | Kind::Quantity(measure) | Kind::Vector(measure, _) | Kind::Windows(measure) => of(measure),
        Kind::Count(min, max) if min < max && *max < i64::MAX => format!(" ({min} … {max})"),
        Kind::CountOrWord(min, max, word) => format!(" ({min} … {max}, or \"{word}\")"),
        Kind::Choice(choices) => format!(" ({})", choices.join(", ")),
        _ => String::new(),
    }
}

/// A relative path would lead elsewhere from the run folder.
fn path_literal(node: &Node) -> String {
    match node.as_text() {
        Some(text) if !text.starts_with("builtin:") => text_literal(&resolve(Path::new(text)).display().to_string()),
        _ => literal(node),
    }
}

/// A value as TOML.
pub(super) fn literal(node: &Node) -> String {
    match &node.value {
        Value::Flag(flag) => flag.to_string(),
        Value::Integer(integer) => integer.to_string(),
        Value::Number(number) => format!("{number:?}"),
        Value::Text(text) => text_literal(text),
        Value::List(items) => format!("[{}]", items.iter().map(literal).collect::<Vec<_>>().join(", ")),
        Value::Table(entries) => {
            let told = entries.iter().filter(|entry| entry.node.value != Value::Missing);
            format!(
                "{{ {} }}",
                told.map(|entry| format!("{} = {}", key_literal(&entry.key), literal(&entry.node))).collect::<Vec<_>>().join(", ")
            )
        }
        Value::Missing | Value::Date => "\"\"".to_owned(),
    }
}

fn key_literal(key: &str) -> String {
    let is_bare = !key.is_empty() && key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    if is_bare { key.to_owned() } else { text_literal(key) }
}

fn text_literal(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

fn push(text: &mut String, line: std::fmt::Arguments<'_>) {
    text.write_fmt(line).expect("writing to a string does not fail");
}
