//! Where the parts of a scenario were typed, for those who speak about them after the run.

use super::diagnostic::line_and_column;
use super::source::Sources;
use super::tree::Node;
use crate::check::Place;

/// Where the named parts of a scenario were typed. What came from the command line has no place.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Places(Vec<(String, Place)>);

/// The lists whose entries have names.
const NAMED: [&str; 3] = ["criterion", "object", "allowed_contact"];

impl Places {
    /// The places of a filled tree.
    pub(super) fn of(filled: &Node, sources: &Sources) -> Self {
        let named = |list: &str| {
            let entries = filled.tables(list).iter();
            let found = entries.filter_map(|table| Some((format!("{list}.{}", table.name()?), place(table.get("name")?, sources)?)));
            found.collect::<Vec<_>>()
        };
        Self(NAMED.into_iter().flat_map(named).collect())
    }

    /// Where the name of the part `key` stands, which is called as in `--set`: `criterion.toy_in_basket`, `object.toy`.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<&Place> {
        self.0.iter().find(|(known, _)| known == key).map(|(_, place)| place)
    }
}

fn place(node: &Node, sources: &Sources) -> Option<Place> {
    if sources.is_override(node.origin) {
        return None;
    }
    let source = sources.get(node.origin.source);
    let (line, column) = line_and_column(&source.text, node.origin.start.min(source.text.len()));
    Some(Place { file: source.name.clone(), line, column })
}
