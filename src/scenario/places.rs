//! Where the parts of a scenario were typed, for those who speak about them after it was read.

use std::sync::Arc;

use super::diagnostic::{Diagnostic, diagnose, line_and_column};
use super::fault::{Code, Fault};
use super::source::{Origin, Sources};
use super::tree::{Node, Value};
use crate::check::Place;

/// Where the parts of a scenario were typed.
#[derive(Clone, Debug)]
pub struct Places(Arc<(Node, Sources)>);

impl Places {
    /// The places of a filled tree.
    pub(super) fn of(filled: Node, sources: Sources) -> Self {
        Self(Arc::new((filled, sources)))
    }

    /// Where the name of the part `key` stands, which is called as in `--set`: `criterion.toy_in_basket`, `object.toy`. What came from the
    /// command line has no place.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<Place> {
        let (found, whole) = self.find(key)?;
        let named = whole.then(|| found.get("name").map_or(found.origin, |name| name.origin))?;
        let sources = &self.0.1;
        if sources.is_override(named) {
            return None;
        }
        let source = sources.get(named.source);
        let (line, column) = line_and_column(&source.text, named.start.min(source.text.len()));
        Some(Place { file: source.name.clone(), line, column })
    }

    /// What only the robot or the scene shows to be wrong, at the parts of the scenario from which it comes: each is a key with what is wrong. A key
    /// that was not typed stands for the nearest part around it that was. Those of which no part was typed are given back.
    #[must_use]
    pub fn diagnose<'a>(&self, faults: impl IntoIterator<Item = (Option<&'a str>, String)>) -> (Vec<Diagnostic>, Vec<String>) {
        let (mut placed, mut unplaced) = (Vec::new(), Vec::new());
        for (key, message) in faults {
            match key.and_then(|key| self.find(key)) {
                Some((node, _)) => placed.push(Fault::at(Code::Scene, name_of(node), message)),
                None => unplaced.push(message),
            }
        }
        (diagnose(placed, &self.0.1), unplaced)
    }

    /// The part `key`, whose steps are keys, names in lists of named tables and numbers in other lists; or the nearest around it, and whether it is
    /// the part itself.
    fn find(&self, key: &str) -> Option<(&Node, bool)> {
        let mut at: Option<&Node> = None;
        for step in key.split('.') {
            match at.unwrap_or(&self.0.0).step(step) {
                Some(next) => at = Some(next),
                // A list as a whole stands for none of its parts.
                None => return at.filter(|node| !matches!(node.value, Value::List(_))).map(|node| (node, false)),
            }
        }
        at.map(|node| (node, true))
    }
}

/// A named table is best shown where its name stands.
fn name_of(node: &Node) -> Origin {
    node.get("name").map_or(node.origin, |name| name.origin)
}
