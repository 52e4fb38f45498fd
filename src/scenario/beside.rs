//! `[[beside]]`: what is executed beside the scenario's run. An entry is the scenario with other values of some keys, so it is read, checked and
//! explained exactly as a scenario with `--set` is; but lessons, robot and scene are the run's.

use super::build;
use super::fault::{Code, Fault, Severity};
use super::load::fill;
use super::overrides::{self, spelled};
use super::roots::Roots;
use super::source::Sources;
use super::tree::Node;
use crate::simulation::Variation;

/// Most entries: so many names fit into the titles and keys of a page.
const MOST: usize = 2;

/// What `tree`, which is `filled` for the run itself, varies beside it. Nothing is said of entries while something is wrong with the run.
pub(super) fn variations(tree: &Node, filled: &Node, sources: &mut Sources, roots: &Roots, faults: &mut Vec<Fault>) -> Vec<Variation> {
    if faults.iter().any(|fault| fault.severity == Severity::Error) {
        return Vec::new();
    }
    let entries = filled.tables("beside");
    if let Some(beyond) = entries.get(MOST) {
        let fault = Fault::at(Code::WrongLength, beyond.origin, format!("{} entries of [[beside]]", entries.len()));
        faults.push(fault.expected(format!("at most {MOST}, which can be told apart")).help("make another scenario for the others"));
        return Vec::new();
    }
    entries.iter().filter_map(|entry| variation(tree, (filled, entry), sources, roots, faults)).collect()
}

fn variation(
    tree: &Node,
    (filled, entry): (&Node, &Node),
    sources: &mut Sources,
    roots: &Roots,
    faults: &mut Vec<Fault>,
) -> Option<Variation> {
    let (name, changes) = (entry.text("name").to_owned(), entry.texts("set"));
    let mut found = what_is_not_its_own(entry);
    let mut changed = tree.clone();
    ["beside", "sweep"].iter().for_each(|key| _ = changed.take(key));
    for typed in &changes {
        overrides::set(&mut changed, &format!("beside.{name}"), typed, sources, &mut found);
    }
    let changed = fill(changed, sources, roots, &mut found);
    // What the run is warned of is told once.
    found.retain(|fault| fault.severity == Severity::Error);
    let space = |scenario: &Node| scenario.section("learning").text("space").to_owned();
    if found.is_empty() && space(&changed) != space(filled) {
        let fault = Fault::at(Code::Conflict, entry.origin, format!("`{name}` learns in another space than the run"));
        found.push(fault.expected("the same `learning.space`: the lessons are the run's").help("make it a scenario of its own"));
    }
    let usable = found.is_empty();
    faults.extend(found);
    usable.then(|| Variation { name, changes, experiment: build::experiment(&changed) })
}

/// Keys that would change what is shared with the run; no key at all.
fn what_is_not_its_own(entry: &Node) -> Vec<Fault> {
    let typed = entry.section("set");
    let own = |typed: &str| {
        let key = spelled(typed.split('=').next().unwrap_or_default());
        let first = key.split('.').next().unwrap_or_default();
        ["learning", "coupling", "execution"].contains(&first) || key == "human.help" || key.starts_with("human.help.")
    };
    let strange = typed.items().iter().filter(|item| !item.as_text().is_some_and(own)).map(|item| {
        let message = "this changes more than how the same lessons are learned and executed";
        Fault::at(Code::Conflict, item.origin, message)
            .expected("a key of learning, coupling, execution or human.help")
            .help("make it a scenario of its own, which `extends` this one")
    });
    let empty = typed.items().is_empty().then(|| {
        Fault::at(Code::WrongLength, entry.origin, "this entry of [[beside]] changes nothing, so it would show the run again")
            .expected("set = [\"KEY=VALUE\", …]")
    });
    strange.chain(empty).collect()
}
