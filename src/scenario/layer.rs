//! Layers: a scenario may extend another one, and the layer above wins.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::fault::{Code, Fault};
use super::parse;
use super::roots::{Roots, resolve};
use super::source::{self, Origin, Source, Sources};
use super::tree::{Entry, Node, Value};

/// Longest chain of `extends`.
const MAX_DEPTH: usize = 16;

/// Reads a scenario with everything it extends. `None` if its own file cannot be read.
pub(super) fn load(path: &Path, roots: &Roots, sources: &mut Sources, faults: &mut Vec<Fault>) -> Option<Node> {
    match source::read(path) {
        Ok(text) => Some(Chain { roots, sources, faults, trail: vec![path.to_path_buf()] }.layer(path, &text)),
        Err(fault) => {
            faults.push(fault);
            None
        }
    }
}

/// The way from the scenario to the file that is being read.
struct Chain<'a> {
    roots: &'a Roots,
    sources: &'a mut Sources,
    faults: &'a mut Vec<Fault>,
    trail: Vec<PathBuf>,
}

impl Chain<'_> {
    fn layer(&mut self, path: &Path, text: &str) -> Node {
        let directory = path.parent().unwrap_or(Path::new("")).to_path_buf();
        let rank = 1 - self.trail.len() as i32;
        let name = path.display().to_string();
        let id = self.sources.add(Source { name, directory, text: text.into(), rank });
        let mut tree = parse::document(text, id, self.faults);
        let Some(extends) = tree.take("extends") else { return tree };
        match self.base(&extends.node) {
            Ok(base) => merge(base, tree),
            Err(fault) => {
                self.faults.push(fault);
                tree
            }
        }
    }

    /// The scenario that the value of `extends` names, with everything it extends itself.
    fn base(&mut self, extends: &Node) -> Result<Node, Fault> {
        let fault = |code, message: String| Fault::at(code, extends.origin, message);
        let Some(typed) = extends.as_text() else {
            return Err(
                fault(Code::WrongType, format!("`extends` is {}", extends.value.type_name())).expected("the path of a scenario file")
            );
        };
        let path = self.sources.get(extends.origin.source).directory.join(typed);
        self.roots.check(&path).map_err(|resolved| outside_roots(extends.origin, &resolved))?;
        let seen = self.trail.iter().any(|earlier| resolve(earlier) == resolve(&path));
        self.trail.push(path.clone());
        if seen {
            return Err(fault(Code::Extends, format!("`extends` leads in a circle: {}", self.chain())));
        }
        if self.trail.len() > MAX_DEPTH {
            return Err(fault(Code::Extends, format!("more than {MAX_DEPTH} scenarios extend each other: {}", self.chain())));
        }
        let text = source::read(&path).map_err(|read| fault(Code::Extends, read.message).maybe_help(read.help))?;
        Ok(self.layer(&path, &text))
    }

    fn chain(&self) -> String {
        self.trail.iter().map(|path| path.display().to_string()).collect::<Vec<_>>().join(" -> ")
    }
}

/// The fault of a path that leads out of the folders that may be used.
pub(super) fn outside_roots(origin: Origin, resolved: &Path) -> Fault {
    Fault::at(Code::OutsideRoot, origin, format!("this file lies outside the folders that the scenario may use: {}", resolved.display()))
        .expected("a file below the scenario's folder or the current folder")
        .help(format!("allow it with --asset-root {}", resolved.parent().unwrap_or(resolved).display()))
}

/// `over` on top of `base`: tables key by key, lists of named tables name by name; everything else is replaced.
pub(super) fn merge(base: Node, over: Node) -> Node {
    let value = match (base.value, over.value) {
        (Value::Table(base), Value::Table(over)) => Value::Table(merge_tables(base, over)),
        (Value::List(base), Value::List(over)) if is_named(&base) && over.iter().any(|item| item.name().is_some()) => {
            Value::List(merge_named(base, over))
        }
        (_, over) => over,
    };
    Node::new(value, over.origin)
}

fn merge_tables(mut base: Vec<Entry>, over: Vec<Entry>) -> Vec<Entry> {
    let places: BTreeMap<String, usize> = base.iter().enumerate().map(|(index, entry)| (entry.key.clone(), index)).collect();
    for entry in over {
        match places.get(&entry.key) {
            Some(&index) => {
                let below = std::mem::replace(&mut base[index].node, Node::missing(entry.origin));
                base[index] = Entry { node: merge(below, entry.node), ..entry };
            }
            None => base.push(entry),
        }
    }
    base
}

/// A name that comes twice in `over` stays twice, for the check of names to find.
fn merge_named(mut base: Vec<Node>, over: Vec<Node>) -> Vec<Node> {
    let mut places: BTreeMap<String, usize> =
        base.iter().enumerate().filter_map(|(index, item)| Some((item.name()?.to_owned(), index))).collect();
    for item in over {
        match item.name().and_then(|name| places.remove(name)) {
            Some(index) => {
                let below = std::mem::replace(&mut base[index], Node::missing(item.origin));
                base[index] = merge(below, item);
            }
            None => base.push(item),
        }
    }
    base
}

fn is_named(items: &[Node]) -> bool {
    !items.is_empty() && items.iter().all(|item| item.name().is_some())
}
