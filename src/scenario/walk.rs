//! A walk over a filled tree, key by key.

use super::key::{Key, Kind, Shape};
use super::tree::Node;

/// Calls `visit` for every key of a table of that shape that has a value, and of the tables within it, in the order of the shape.
pub(super) fn walk<'a>(table: &'a Node, shape: &Shape, visit: &mut impl FnMut(&'static Key, &'a Node)) {
    let kind = table.get("kind").and_then(Node::as_text);
    for key in shape.keys_of(kind) {
        let Some(node) = table.get(key.name) else { continue };
        visit(key, node);
        match &key.kind {
            Kind::Section(inner) => walk(node, inner, visit),
            Kind::List(inner) => node.items().iter().for_each(|item| walk(item, inner, visit)),
            _ => {}
        }
    }
}
