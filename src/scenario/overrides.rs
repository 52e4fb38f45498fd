//! `--set KEY=VALUE` and the flags that stand for a key: the layer above all files.

use std::path::PathBuf;

use super::fault::{Code, Fault};
use super::layer::merge;
use super::parse;
use super::source::{COMMAND_LINE, Origin, Source, SourceId, Sources};
use super::suggest::{did_you_mean, name_list};
use super::tree::{Entry, Node, Value, index_of};

/// Applies one override as typed after the flag `name` of the command line (`object.toy.radius_m=0.035`).
pub(super) fn set(tree: &mut Node, name: &str, typed: &str, sources: &mut Sources, faults: &mut Vec<Fault>) {
    let id = sources.add(of_command_line(name, typed));
    let outcome = read(typed, id, faults).and_then(|(path, value)| place(tree, &path, value));
    faults.extend(outcome.err());
}

/// Applies a flag that stands for one key: the value, and how it was typed.
pub(super) fn flag(
    tree: &mut Node,
    name: &str,
    path: &[&str],
    (value, typed): (Value, &str),
    sources: &mut Sources,
    faults: &mut Vec<Fault>,
) {
    let origin = Origin { source: sources.add(of_command_line(name, typed)), start: 0, end: typed.len() };
    let steps: Vec<Step<'_>> = path.iter().map(|&name| Step { name, origin }).collect();
    faults.extend(place(tree, &steps, Node::new(value, origin)).err());
}

/// Puts `value` where the dotted `key` leads; faults of the way are told at `origin`.
pub(super) fn put(tree: &mut Node, key: &str, origin: Origin, value: Node) -> Result<(), Fault> {
    let steps: Vec<Step<'_>> = key.split('.').map(|name| Step { name: name.trim(), origin }).collect();
    place(tree, &steps, value)
}

/// The dotted key of an override or a sweep in its one spelling: without blanks around its parts.
pub fn spelled(key: &str) -> String {
    key.split('.').map(str::trim).collect::<Vec<_>>().join(".")
}

/// The steps of a dotted key, items of lists by their numbers: the same for all spellings of one place in `tree`. What is not there stays as it
/// was typed.
pub(super) fn steps(tree: &Node, key: &str) -> Vec<String> {
    let mut at = Some(tree);
    let step = |name: &str| {
        let index = at.and_then(|node| index_of(node.items(), name));
        at = at.and_then(|node| node.step(name));
        index.map_or_else(|| name.to_owned(), |index| index.to_string())
    };
    key.split('.').map(str::trim).map(step).collect()
}

/// A text of the command line, typed after the flag `name`.
pub(super) fn of_command_line(name: &str, typed: &str) -> Source {
    Source { name: name.to_owned(), directory: PathBuf::new(), text: typed.into(), rank: COMMAND_LINE }
}

/// One step of a dotted path.
struct Step<'a> {
    name: &'a str,
    origin: Origin,
}

fn read<'a>(typed: &'a str, source: SourceId, faults: &mut Vec<Fault>) -> Result<(Vec<Step<'a>>, Node), Fault> {
    let whole = Origin { source, start: 0, end: typed.len() };
    let Some((key, text)) = typed.split_once('=') else {
        return Err(Fault::at(Code::Override, whole, "this override has no `=`").expected("KEY=VALUE, such as object.toy.radius_m=0.035"));
    };
    let mut start = 0;
    let mut path = Vec::new();
    for part in key.split('.') {
        let lead = part.len() - part.trim_start().len();
        let name = part.trim();
        path.push(Step { name, origin: Origin { source, start: start + lead, end: start + lead + name.len() } });
        start += part.len() + 1;
    }
    if let Some(step) = path.iter().find(|step| step.name.is_empty()) {
        return Err(
            Fault::at(Code::Override, step.origin, "a part of the key is empty").expected("KEY=VALUE, such as object.toy.radius_m=0.035")
        );
    }
    if path[0].name == "extends" {
        return Err(Fault::at(Code::Override, path[0].origin, "`extends` can only be set in a scenario file"));
    }
    Ok((path, value(text, source, key.len() + 1, faults)?))
}

/// The value: TOML, or a bare word, which is text. It starts `offset` bytes into its source.
pub(super) fn value(text: &str, source: SourceId, offset: usize, faults: &mut Vec<Fault>) -> Result<Node, Fault> {
    let lead = text.len() - text.trim_start().len();
    let word = text.trim();
    let origin = Origin { source, start: offset + lead, end: offset + lead + word.len() };
    if let Some(node) = parse::value(word, source, offset + lead, faults) {
        return Ok(Node::new(node.value, origin));
    }
    let bare = |c: char| c.is_alphanumeric() || "_-./:~".contains(c);
    if word.starts_with(|c: char| c.is_alphabetic() || "./~_".contains(c)) && word.chars().all(bare) {
        return Ok(Node::new(Value::Text(word.to_owned()), origin));
    }
    Err(Fault::at(Code::Override, origin, "this value cannot be read").expected("a number, true, false, a word, \"text\" or [a, list]"))
}

/// Puts `value` where `path` leads, making tables on the way.
fn place(tree: &mut Node, path: &[Step<'_>], value: Node) -> Result<(), Fault> {
    let Some((step, rest)) = path.split_first() else {
        let below = std::mem::replace(tree, Node::missing(value.origin));
        *tree = merge(below, value);
        return Ok(());
    };
    let type_name = tree.value.type_name();
    match &mut tree.value {
        Value::Table(entries) => place(entry(entries, step), rest, value),
        Value::List(items) => place(item(items, step)?, rest, value),
        Value::Missing => {
            tree.value = Value::Table(Vec::new());
            place(tree, path, value)
        }
        _ => Err(Fault::at(Code::Override, step.origin, format!("`{}` is looked for in {type_name}, which has no keys", step.name))),
    }
}

fn entry<'a>(entries: &'a mut Vec<Entry>, step: &Step<'_>) -> &'a mut Node {
    let index = entries.iter().position(|entry| entry.key == step.name).unwrap_or_else(|| {
        entries.push(Entry { key: step.name.to_owned(), origin: step.origin, node: Node::missing(step.origin) });
        entries.len() - 1
    });
    // The layer that typed a key last is the one that answers for it.
    entries[index].origin = step.origin;
    &mut entries[index].node
}

/// An item of a list.
fn item<'a>(items: &'a mut [Node], step: &Step<'_>) -> Result<&'a mut Node, Fault> {
    if let Some(index) = index_of(items, step.name) {
        return Ok(&mut items[index]);
    }
    let names: Vec<&str> = items.iter().filter_map(Node::name).collect();
    let expected =
        if names.is_empty() { format!("a number below {}", items.len()) } else { format!("one of {}", name_list(names.iter().copied())) };
    let fault = Fault::at(Code::UnknownName, step.origin, format!("this list has no item `{}`", step.name));
    Err(fault.expected(expected).maybe_help(did_you_mean(step.name, names)))
}
