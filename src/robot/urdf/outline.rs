//! The links and joints of one file with the lines they stand on: what the tree is checked by, and where later findings point.

use roxmltree::Node;

use super::finding::Place;

/// Links and joints in file order.
#[derive(Debug, Default)]
pub(super) struct Outline {
    pub links: Vec<LinkEntry>,
    pub joints: Vec<JointEntry>,
}

/// A link: its name, where it stands, and where its geometry does.
#[derive(Debug)]
pub(super) struct LinkEntry {
    pub name: String,
    pub place: Place,
    pub visuals: Vec<Place>,
    pub collisions: Vec<Place>,
}

/// A joint: its name, its ends, and the joint that it follows.
#[derive(Debug)]
pub(super) struct JointEntry {
    pub name: String,
    pub place: Place,
    pub parent: String,
    pub child: String,
    pub moves: bool,
    pub mimics: Option<String>,
}

/// Turns nodes of a parsed file into places in it.
pub(super) struct Lines<'a> {
    file: &'a str,
    /// Byte offset of the start of each line after the first.
    starts: Vec<usize>,
}

impl<'a> Lines<'a> {
    pub(super) fn new(file: &'a str, text: &str) -> Self {
        let newlines = text.bytes().enumerate().filter(|&(_, byte)| byte == b'\n');
        Self { file, starts: newlines.map(|(offset, _)| offset + 1).collect() }
    }

    pub(super) fn place(&self, node: Node<'_, '_>) -> Place {
        let line = 1 + self.starts.partition_point(|&start| start <= node.range().start);
        Place { file: self.file.to_owned(), line: u32::try_from(line).ok() }
    }
}

impl Outline {
    pub(super) fn read(robot: Node<'_, '_>, lines: &Lines<'_>) -> Self {
        let named = |name| robot.children().filter(move |node| node.has_tag_name(name));
        Self {
            links: named("link").map(|node| LinkEntry::read(node, lines)).collect(),
            joints: named("joint").map(|node| JointEntry::read(node, lines)).collect(),
        }
    }

    /// Adds an attachment, mounted by `mount`.
    pub(super) fn merge(&mut self, part: Self, mount: JointEntry) {
        self.joints.push(mount);
        self.links.extend(part.links);
        self.joints.extend(part.joints);
    }
}

impl LinkEntry {
    fn read(node: Node<'_, '_>, lines: &Lines<'_>) -> Self {
        let places = |name| {
            let children = node.children().filter(move |child| child.has_tag_name(name));
            children.map(|child| lines.place(child)).collect()
        };
        Self { name: attribute(node, "name"), place: lines.place(node), visuals: places("visual"), collisions: places("collision") }
    }
}

impl JointEntry {
    fn read(node: Node<'_, '_>, lines: &Lines<'_>) -> Self {
        let end = |name| child(node, name).map_or_else(String::new, |end| attribute(end, "link"));
        Self {
            name: attribute(node, "name"),
            place: lines.place(node),
            parent: end("parent"),
            child: end("child"),
            moves: node.attribute("type") != Some("fixed"),
            mimics: child(node, "mimic").map(|mimic| attribute(mimic, "joint")),
        }
    }
}

pub(super) fn child<'a, 'input>(node: Node<'a, 'input>, name: &str) -> Option<Node<'a, 'input>> {
    node.children().find(|child| child.has_tag_name(name))
}

/// The attribute's text, empty when absent (the structure check reports that).
pub(super) fn attribute(node: Node<'_, '_>, name: &str) -> String {
    node.attribute(name).unwrap_or_default().to_owned()
}
