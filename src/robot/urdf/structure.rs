//! The structural check of a robot description: everything that can be said of one element with its line, all of it in one pass.
//!
//! Libraries that read URDF stop at the first fault, name no line, and let much through (urdf-rs 0.10 drops tokens that are no numbers
//! and overflows the stack on deeply nested elements). So this check comes first and they only see what it let through.

use roxmltree::{Document, Node};

use super::elements::Check;
use super::finding::{Findings, Place};
use super::outline::{Lines, Outline};
use super::vocabulary::check_words;

/// Largest file read (bytes): fifty times Baxter's.
pub(super) const MAX_FILE_BYTES: usize = 4 * 1024 * 1024;
/// Deepest nesting of elements: URDF needs 5, extensions for simulators about 10.
const MAX_DEPTH: usize = 64;
/// Checks one file and outlines it; nothing when it is no robot description at all.
pub(super) fn check(text: &str, file: &str, findings: &mut Findings) -> Option<Outline> {
    let whole = Place { file: file.to_owned(), line: None };
    if text.len() > MAX_FILE_BYTES {
        findings.error(&whole, "file", format!("larger than {MAX_FILE_BYTES} bytes"), "");
        return None;
    }
    let document = match Document::parse(text) {
        Ok(document) => document,
        Err(fault) => {
            let place = Place { line: Some(fault.pos().row), ..whole };
            findings.error(&place, "file", format!("not well-formed XML: {fault}"), "");
            return None;
        }
    };
    let lines = Lines::new(file, text);
    let robot = document.root_element();
    let mut check = Check::new(&lines, findings);
    if !robot.has_tag_name("robot") {
        let message = format!("the outermost element is <{}>, not <robot>", robot.tag_name().name());
        check.error(robot, message, "give a URDF file; expand xacro files first");
        return None;
    }
    if let Some(deep) = first_too_deep(robot) {
        check.error(deep, format!("elements are nested deeper than {MAX_DEPTH}"), "");
        return None;
    }
    check.robot(robot);
    check_words(robot, &lines, findings);
    Some(Outline::read(robot, &lines))
}

fn first_too_deep<'a, 'input>(robot: Node<'a, 'input>) -> Option<Node<'a, 'input>> {
    let mut open = vec![(robot, 1)];
    while let Some((node, depth)) = open.pop() {
        if depth > MAX_DEPTH {
            return Some(node);
        }
        open.extend(node.children().filter(Node::is_element).map(|child| (child, depth + 1)));
    }
    None
}
