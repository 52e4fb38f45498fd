//! The structural check of one element: links, geometry, materials, joints, and the numbers in them.

use roxmltree::Node;

use super::finding::Findings;
use super::outline::{Lines, child};
use super::vocabulary::SHAPES;

/// Edge, radius or length (m) above which a shape was probably given in millimetres.
const LARGEST_SHAPE: f64 = 20.0;
/// Angle beyond which a pose is probably told in degrees (rad): a turn, with room for rounded digits.
const FULL_TURN_RAD: f64 = 6.3;

/// Checks elements of one file, each with its line.
pub(super) struct Check<'a> {
    lines: &'a Lines<'a>,
    findings: &'a mut Findings,
}

impl<'a> Check<'a> {
    pub(super) fn new(lines: &'a Lines<'a>, findings: &'a mut Findings) -> Self {
        Self { lines, findings }
    }

    pub(super) fn error(&mut self, node: Node<'_, '_>, message: impl Into<String>, help: &str) {
        self.findings.error(&self.lines.place(node), described(node), message, help);
    }

    pub(super) fn warning(&mut self, node: Node<'_, '_>, message: impl Into<String>, help: &str) {
        self.findings.warning(&self.lines.place(node), described(node), message, help);
    }

    pub(super) fn robot(&mut self, robot: Node<'_, '_>) {
        for node in elements(robot) {
            match node.tag_name().name() {
                "link" => self.link(node),
                "joint" => self.joint(node),
                "material" => self.material(node),
                _ => {}
            }
        }
    }

    fn link(&mut self, link: Node<'_, '_>) {
        self.named(link);
        self.at_most_one(link, &["inertial"]);
        for node in elements(link) {
            match node.tag_name().name() {
                "inertial" => self.inertial(node),
                "visual" | "collision" => self.body_shape(node),
                _ => {}
            }
        }
    }

    fn body_shape(&mut self, node: Node<'_, '_>) {
        self.at_most_one(node, &["origin", "geometry", "material"]);
        self.origin(node);
        match child(node, "geometry") {
            Some(geometry) => self.geometry(geometry),
            None => self.error(node, "has no <geometry>", ""),
        }
        if let Some(material) = child(node, "material") {
            self.material(material);
        }
    }

    fn geometry(&mut self, geometry: Node<'_, '_>) {
        let is_shape = |node: &Node<'_, '_>| SHAPES.contains(&node.tag_name().name());
        let mut shapes = elements(geometry).filter(is_shape);
        let Some(shape) = shapes.next() else {
            let help = format!("give one of {}", SHAPES.join(", "));
            return self.error(geometry, "has no shape", &help);
        };
        if shapes.next().is_some() {
            self.error(geometry, "has more than one shape", "use one <visual> or <collision> for each");
        }
        match shape.tag_name().name() {
            "box" => self.size(shape, "size", 3),
            "sphere" => self.size(shape, "radius", 1),
            "mesh" => self.mesh(shape),
            _ => {
                self.size(shape, "radius", 1);
                self.size(shape, "length", 1);
            }
        }
    }

    fn size(&mut self, shape: Node<'_, '_>, attribute: &str, count: usize) {
        let Some(sizes) = self.required(shape, attribute, count) else {
            return;
        };
        if sizes.iter().any(|&size| size <= 0.0) {
            self.error(shape, format!("`{attribute}` must be greater than zero, not {sizes:?}"), "");
        } else if sizes.iter().any(|&size| size > LARGEST_SHAPE) {
            let message = format!("`{attribute}` of {sizes:?} m is larger than {LARGEST_SHAPE} m");
            self.warning(shape, message, "lengths are in metres: divide millimetres by 1000");
        }
    }

    fn mesh(&mut self, mesh: Node<'_, '_>) {
        if mesh.attribute("filename").is_none_or(|name| name.trim().is_empty()) {
            self.error(mesh, "has no `filename`", "");
        }
        if self.optional(mesh, "scale", 3).is_some_and(|scale| scale.contains(&0.0)) {
            self.error(mesh, "`scale` of zero makes the mesh flat", "");
        }
    }

    fn material(&mut self, material: Node<'_, '_>) {
        let Some(color) = child(material, "color") else {
            return;
        };
        let rgba = self.required(color, "rgba", 4);
        if rgba.is_some_and(|rgba| rgba.iter().any(|part| !(0.0..=1.0).contains(part))) {
            self.error(color, "`rgba` must lie between 0 and 1", "divide parts of 255 by 255");
        }
    }

    /// Checks the <origin> of an element, and returns its `xyz` where it has one.
    pub(super) fn origin(&mut self, node: Node<'_, '_>) -> Option<Vec<f64>> {
        let origin = child(node, "origin")?;
        let xyz = self.optional(origin, "xyz", 3);
        let rpy = self.optional(origin, "rpy", 3);
        if let Some(angle) = rpy.iter().flatten().find(|angle| angle.abs() > FULL_TURN_RAD) {
            self.warning(origin, format!("`rpy` turns by {angle} rad, which looks like degrees"), "angles are in radians");
        }
        if self.optional(origin, "quat_xyzw", 4).is_some() && origin.attribute("rpy").is_some() {
            self.error(origin, "has both `rpy` and `quat_xyzw`", "keep one");
        }
        xyz
    }

    pub(super) fn named(&mut self, node: Node<'_, '_>) {
        if node.attribute("name").is_none_or(|name| name.trim().is_empty()) {
            self.error(node, "has no `name`", "");
        }
    }

    pub(super) fn at_most_one(&mut self, node: Node<'_, '_>, names: &[&str]) {
        for name in names {
            if let Some(second) = elements(node).filter(|child| child.has_tag_name(*name)).nth(1) {
                self.error(second, format!("{} has more than one <{name}>", described(node)), "");
            }
        }
    }
}

pub(super) fn elements<'a, 'input: 'a>(node: Node<'a, 'input>) -> impl Iterator<Item = Node<'a, 'input>> {
    node.children().filter(Node::is_element)
}

/// How findings call an element: "link `hand`", or "<mass> of link `hand`".
fn described(node: Node<'_, '_>) -> String {
    let is_owner = |node: &Node<'_, '_>| ["link", "joint", "robot"].contains(&node.tag_name().name());
    let owner = node.ancestors().find(is_owner).unwrap_or(node);
    let kind = owner.tag_name().name();
    let owner_text = match owner.attribute("name") {
        Some(name) => format!("{kind} `{name}`"),
        None => format!("unnamed {kind}"),
    };
    if owner == node { owner_text } else { format!("<{}> of {owner_text}", node.tag_name().name()) }
}
