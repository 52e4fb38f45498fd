//! The words of a robot description: which elements and attributes may stand where, and what becomes of each.

use roxmltree::Node;

use super::finding::Findings;
use super::outline::Lines;
use crate::robot::nearest_name;

/// What may stand in one element.
struct Rule {
    element: &'static str,
    attributes: &'static [&'static str],
    children: &'static [&'static str],
}

const fn rule(element: &'static str, attributes: &'static [&'static str], children: &'static [&'static str]) -> Rule {
    Rule { element, attributes, children }
}

/// Elements of URDF 1.2 (wiki.ros.org/urdf/XML). Those without a rule may hold anything.
const RULES: &[Rule] = &[
    rule("robot", &["name", "version"], &["link", "joint", "material", "gazebo", "transmission", "ros2_control"]),
    rule("link", &["name", "type"], &["inertial", "visual", "collision"]),
    rule("inertial", &["name"], &["origin", "mass", "inertia"]),
    rule("visual", &["name"], &["origin", "geometry", "material"]),
    rule("collision", &["name"], &["origin", "geometry", "material", "verbose"]),
    rule("geometry", &[], SHAPES),
    rule("box", &["size"], &[]),
    rule("sphere", &["radius"], &[]),
    rule("cylinder", &["radius", "length"], &[]),
    rule("capsule", &["radius", "length"], &[]),
    rule("mesh", &["filename", "scale"], &[]),
    rule("material", &["name"], &["color", "texture"]),
    rule("color", &["rgba"], &[]),
    rule("origin", &["xyz", "rpy", "quat_xyzw"], &[]),
    rule("mass", &["value"], &[]),
    rule("inertia", &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"], &[]),
    rule(
        "joint",
        &["name", "type"],
        &["origin", "parent", "child", "axis", "limit", "dynamics", "mimic", "calibration", "safety_controller"],
    ),
    rule("parent", &["link"], &[]),
    rule("child", &["link"], &[]),
    rule("axis", &["xyz"], &[]),
    rule("limit", &["lower", "upper", "effort", "velocity", "acceleration", "deceleration", "jerk"], &[]),
    rule("dynamics", &["damping", "friction"], &[]),
    rule("mimic", &["joint", "multiplier", "offset"], &[]),
];

/// Elements that give a shape.
pub(super) const SHAPES: &[&str] = &["box", "cylinder", "capsule", "sphere", "mesh"];

/// Elements that URDF knows and this simulation leaves out. `gazebo`, `transmission` and `ros2_control` say nothing about the mechanics
/// and pass without a word.
const NOT_SIMULATED: &[&str] = &["calibration", "safety_controller", "texture", "gravity"];

/// Warns of elements and attributes that nothing reads, with the nearest known word; once per word, however often it stands there.
pub(super) fn check_words(robot: Node<'_, '_>, lines: &Lines<'_>, findings: &mut Findings) {
    let mut unread: Vec<Unread> = Vec::new();
    let mut open = vec![robot];
    while let Some(node) = open.pop() {
        let Some(rule) = RULES.iter().find(|rule| node.has_tag_name(rule.element)) else {
            continue;
        };
        for attribute in node.attributes().filter(|attribute| attribute.namespace().is_none()) {
            if !rule.attributes.contains(&attribute.name()) {
                Unread::count(&mut unread, "attribute", attribute.name(), rule, rule.attributes, node);
            }
        }
        let first_child = open.len();
        for child in node.children().filter(Node::is_element) {
            let name = child.tag_name().name();
            if NOT_SIMULATED.contains(&name) || !rule.children.contains(&name) {
                Unread::count(&mut unread, "element", name, rule, rule.children, child);
            } else {
                open.push(child);
            }
        }
        open[first_child..].reverse();
    }
    for word in unread {
        word.report(lines, findings);
    }
}

/// A word that nothing reads, with the first node where it stands.
struct Unread<'a, 'input> {
    kind: &'static str,
    name: String,
    inside: &'static Rule,
    known: &'static [&'static str],
    node: Node<'a, 'input>,
    times: usize,
}

impl<'a, 'input> Unread<'a, 'input> {
    fn count(
        unread: &mut Vec<Self>,
        kind: &'static str,
        name: &str,
        inside: &'static Rule,
        known: &'static [&'static str],
        node: Node<'a, 'input>,
    ) {
        let same = |word: &&mut Self| word.kind == kind && word.name == name && word.inside.element == inside.element;
        match unread.iter_mut().find(same) {
            Some(word) => word.times += 1,
            None => unread.push(Self { kind, name: name.to_owned(), inside, known, node, times: 1 }),
        }
    }

    fn report(&self, lines: &Lines<'_>, findings: &mut Findings) {
        let Self { kind, name, inside, times, .. } = self;
        let often = if *times > 1 { format!(" ({times} times, here first)") } else { String::new() };
        let element = format!("<{}>", inside.element);
        let place = lines.place(self.node);
        if NOT_SIMULATED.contains(&name.as_str()) {
            let message = format!("`{name}` is not simulated{often}");
            findings.warning(&place, element, message, "");
            return;
        }
        let help = match nearest_name(name, self.known.iter().copied()) {
            Some(word) => format!("did you mean `{word}`?"),
            None => format!("known here: {}", self.known.join(", ")),
        };
        findings.warning(&place, element, format!("unknown {kind} `{name}` is ignored{often}"), &help);
    }
}
