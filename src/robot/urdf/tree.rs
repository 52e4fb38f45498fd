//! The check that links and joints make one tree: every end exists, every link but one hangs on exactly one joint, nothing hangs on itself.

use std::collections::{BTreeMap, BTreeSet};

use super::finding::{Findings, Place};
use super::outline::{JointEntry, LinkEntry, Outline};
use crate::robot::nearest_name;

/// Checks the joined outlines of a robot and its attachments.
pub(super) fn check_tree(outline: &Outline, findings: &mut Findings, origin: &Place) {
    if outline.links.is_empty() {
        findings.error(origin, "robot", "has no <link>", "");
        return;
    }
    let links = unique(outline.links.iter().map(|link| ("link", link.name.as_str(), &link.place)), findings);
    unique(outline.joints.iter().map(|joint| ("joint", joint.name.as_str(), &joint.place)), findings);
    let joints = outline.joints.iter().map(|joint| (joint.name.as_str(), joint)).collect();
    for joint in &outline.joints {
        check_ends(joint, &links, findings);
        check_mimic(joint, &joints, findings);
    }
    let carried = check_parents(&outline.joints, findings);
    if !findings.has_error() {
        check_root(outline, &carried, findings, origin);
    }
}

/// Places by name; the second of a name is reported with the line of the first.
fn unique<'a>(named: impl Iterator<Item = (&'static str, &'a str, &'a Place)>, findings: &mut Findings) -> BTreeMap<&'a str, &'a Place> {
    let mut first = BTreeMap::new();
    for (kind, name, place) in named {
        if let Some(earlier) = first.get(name) {
            let message = format!("the name is taken at {earlier}");
            findings.error(place, format!("{kind} `{name}`"), message, "rename one");
        } else {
            first.insert(name, place);
        }
    }
    first
}

fn check_ends(joint: &JointEntry, links: &BTreeMap<&str, &Place>, findings: &mut Findings) {
    let element = format!("joint `{}`", joint.name);
    for (end, link) in [("parent", &joint.parent), ("child", &joint.child)] {
        if !link.is_empty() && !links.contains_key(link.as_str()) {
            let help = match nearest_name(link, links.keys().copied()) {
                Some(name) => format!("did you mean `{name}`?"),
                None => format!("remove the joint or add <link name=\"{link}\"/>"),
            };
            findings.error(&joint.place, element.as_str(), format!("{end} link `{link}` does not exist"), &help);
        }
    }
    if !joint.child.is_empty() && joint.parent == joint.child {
        findings.error(&joint.place, element, format!("joins link `{}` to itself", joint.child), "");
    }
}

fn check_mimic(joint: &JointEntry, joints: &BTreeMap<&str, &JointEntry>, findings: &mut Findings) {
    let Some(name) = joint.mimics.as_deref().filter(|_| joint.moves) else {
        return;
    };
    let (fault, help) = match joints.get(name) {
        None => ("does not exist", ""),
        Some(leader) if !leader.moves => ("is fixed", ""),
        Some(leader) if leader.mimics.is_some() => ("mimics a joint itself", "name the joint that leads both"),
        Some(_) => return,
    };
    let message = format!("mimics joint `{name}`, which {fault}");
    findings.error(&joint.place, format!("joint `{}`", joint.name), message, help);
}

/// The joint that carries each link.
fn check_parents<'a>(joints: &'a [JointEntry], findings: &mut Findings) -> BTreeMap<&'a str, &'a JointEntry> {
    let mut carried: BTreeMap<&str, &JointEntry> = BTreeMap::new();
    for joint in joints {
        if let Some(other) = carried.insert(&joint.child, joint) {
            let message = format!("has two parents: joint `{}` at {}, joint `{}` here", other.name, other.place, joint.name);
            findings.error(&joint.place, format!("link `{}`", joint.child), message, "a robot is a tree: remove one joint");
        }
    }
    carried
}

fn check_root(outline: &Outline, carried: &BTreeMap<&str, &JointEntry>, findings: &mut Findings, origin: &Place) {
    let is_root = |link: &&LinkEntry| !carried.contains_key(link.name.as_str());
    let roots: Vec<&LinkEntry> = outline.links.iter().filter(is_root).collect();
    if roots.len() > 1 {
        let names: Vec<String> = roots.iter().map(|link| format!("`{}` ({})", link.name, link.place)).collect();
        let message = format!("has {} roots, links that hang on no joint: {}", roots.len(), names.join(", "));
        findings.error(&roots[1].place, "robot", message, "join all but one to the rest");
    }
    let mut children: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for joint in &outline.joints {
        children.entry(&joint.parent).or_default().push(&joint.child);
    }
    let mut reached = BTreeSet::new();
    let mut open: Vec<&str> = roots.iter().map(|link| link.name.as_str()).collect();
    while let Some(link) = open.pop() {
        if reached.insert(link) {
            open.extend(children.get(link).into_iter().flatten());
        }
    }
    let lost = outline.links.iter().filter(|link| !reached.contains(link.name.as_str()));
    let lost: Vec<&str> = lost.map(|link| link.name.as_str()).collect();
    if let Some(&first) = lost.first() {
        let place = carried.get(first).map_or(origin, |joint| &joint.place);
        let message = format!("links {} hang on each other in a cycle", lost.join(", "));
        findings.error(place, "robot", message, "a robot is a tree: remove one joint");
    }
}
