//! Rows 9 to 12 of the fault table: a malformed robot given with `--robot`. None is taken silently, none makes the program panic, and every
//! message names the file and a line of the element that is wrong. rapier3d-urdf 0.36.1 panicked on two of the 26 and took nineteen.

use crate::cli::{Folder, GOOD, Said};

/// A robot that is taken without a word.
const BAXTER: &str = include_str!("../../assets/baxter/baxter.urdf");

/// Where a piece of it is replaced.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    Link,
    Joint,
    File,
}

use Part::{File, Joint, Link};

impl Part {
    /// The part's first and last byte in the sound robot.
    fn range(self) -> std::ops::Range<usize> {
        let (begin, end) = match self {
            Link => ("<link name=\"left_upper_elbow\">", "</link>"),
            Joint => ("<joint name=\"left_e0\"", "</joint>"),
            File => return 0..BAXTER.len(),
        };
        let start = BAXTER.find(begin).expect("there");
        start..start + BAXTER[start..].find(end).expect("there") + end.len()
    }
}

const CYLINDER: &str = r#"<cylinder radius="0.06" length="0.107"/>"#;
const LIMIT: &str = r#"<limit lower="-3.05417993878" upper="3.05417993878" effort="50" velocity="1.5"/>"#;
const CENTER: &str = r#"xyz="-0.00276 0.00132 0.18086""#;
const MASS: &str = r#"value="4.31272""#;
const BOX: &str = r#"size="0.07 0.12 0.11""#;

/// The 26: what is replaced by what, the exit code, and what must be told.
#[rustfmt::skip]
const MALFORMED: [(Part, &str, &str, i32, &str); 26] = [
    (Joint, r#"<child link="left_upper_elbow"/>"#, r#"<child link="nowhere"/>"#, 3, "child link `nowhere` does not exist"),
    (Joint, r#"<parent link="left_lower_shoulder"/>"#, r#"<parent link="left_upper_elbow"/>"#, 3, "to itself"),
    (Joint, r#"type="revolute""#, r#"type="revolut""#, 3, "unknown type `revolut`"),
    (File, "</robot>", "", 3, "not well-formed XML"),
    (Link, CENTER, r#"xyz="0 0 abc""#, 3, "\"abc\", which is no number"),
    (Link, CENTER, r#"xyz="0 0.1""#, 3, "must hold 3 numbers, not 2"),
    (Link, MASS, r#"value="4,31272""#, 3, "write a decimal point"),
    (File, "</robot>", r#"<link name="torso"/></robot>"#, 3, "link `torso`: the name is taken at b.urdf:"),
    (File, "</robot>", r#"<joint name="k" type="fixed"><parent link="left_hand"/><child link="base"/></joint></robot>"#, 3, "in a cycle"),
    (File, "</robot>", r#"<joint name="k" type="fixed"><parent link="base"/><child link="left_hand"/></joint></robot>"#, 3, "has two parents"),
    (Link, MASS, r#"value="-4.31272""#, 3, "mass is negative"),
    (Link, MASS, r#"value="NaN""#, 3, "must be finite, not NaN"),
    (Link, "ixx=\"0.0", "ixx=\"-0.0", 3, "not positive definite: principal moments"),
    (Link, "izz=\"0.0", "izz=\"0.5", 3, "exceeds the sum of the others"),
    (Link, MASS, r#"value="0""#, 3, "no mass, yet an inertia"),
    (Link, CYLINDER, r#"<mesh filename="none.stl"/>"#, 3, "mesh `none.stl` is missing"),
    (Link, CYLINDER, r#"<mesh filename="package://nowhere/none.stl"/>"#, 3, "no directory called `nowhere`"),
    (Link, CYLINDER, r#"<mesh filename="/etc/passwd"/>"#, 3, "only package:// and paths beside the file are read"),
    (Link, "radius=\"0.06\"", "radius=\"-0.06\"", 3, "must be greater than zero"),
    (Link, BOX, r#"size="0.07 NaN 0.11""#, 3, "must be finite, not NaN"),
    (Joint, LIMIT, r#"<limit lower="3" upper="-3" effort="50" velocity="1.5"/>"#, 3, "lower (3) is greater than upper (-3)"),
    (Joint, r#"xyz="0 0 1""#, r#"xyz="0 0 0""#, 3, "the axis has no direction"),
    (Joint, LIMIT, "", 3, "has no <limit>"),
    (File, BAXTER, "<robot name=\"b\"/>", 3, "has no <link>"),
    (Link, "<visual>", "<visul/><visual>", 0, "did you mean `visual`?"),
    (Link, BOX, r#"size="70 120 110""#, 0, "lengths are in metres: divide millimetres by 1000"),
];

/// The robot with the last place of `old` in the part replaced by `new`, and the lines on which the part then stands.
fn malformed(part: Part, old: &str, new: &str) -> (String, std::ops::RangeInclusive<usize>) {
    let range = part.range();
    let at = range.start + BAXTER[range.clone()].rfind(old).expect("it is there");
    let text = format!("{}{new}{}", &BAXTER[..at], &BAXTER[at + old.len()..]);
    let end = range.end + new.len() - old.len();
    let line = |byte: usize| text[..byte.min(text.len())].matches('\n').count() + 1;
    let lines = line(range.start)..=line(end);
    (text, lines)
}

fn validate(robot: &[u8]) -> Said {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("b.urdf", robot)]);
    let said = folder.call(&["validate", "a.toml", "--robot", "b.urdf"]);
    assert_eq!(folder.names(), ["a.toml", "b.urdf"], "nothing is written");
    said
}

#[test]
fn the_sound_robot_is_taken_without_a_word() {
    let said = validate(BAXTER.as_bytes());
    assert_eq!((said.code, said.stderr.as_str()), (Some(0), ""));
}

#[test]
fn rows_9_to_12_none_of_the_26_malformed_robots_is_taken_silently() {
    for (part, old, new, code, told) in MALFORMED {
        let (text, lines) = malformed(part, old, new);
        let said = validate(text.as_bytes());
        assert_eq!(said.code, Some(code), "{told}: {}{}", said.stdout, said.stderr);
        assert!(!said.stderr.contains("internal error"), "{told}: {}", said.stderr);
        // A warning is one line; an error is a paragraph with its place, words and help.
        let paragraph = said.stderr.split("\n\n").find(|part| part.contains(told)).unwrap_or_else(|| panic!("{told}: {}", said.stderr));
        let message = paragraph.lines().find(|line| line.contains(told) && line.contains("b.urdf")).unwrap_or(paragraph);
        let place = message.split("b.urdf").nth(1).unwrap_or_else(|| panic!("no place in {message}"));
        let line: String = place.strip_prefix(':').unwrap_or_default().chars().take_while(char::is_ascii_digit).collect();
        // A robot without links is wrong as a whole, and has no other line.
        let line: usize = line.parse().unwrap_or_else(|_| usize::from(told == "has no <link>"));
        assert!(lines.contains(&line), "{told}: line {line} is not in {lines:?}: {message}");
    }
}

#[test]
fn a_moving_link_without_inertia_is_refused() {
    let link = &BAXTER[Link.range()];
    let inertial = &link[link.find("<inertial>").expect("there")..link.find("</inertial>").expect("there") + "</inertial>".len()];
    let said = validate(malformed(Link, inertial, "").0.as_bytes());
    assert_eq!(said.code, Some(3));
    assert!(said.stderr.contains("link `left_upper_elbow`: moves on joint `left_e0`, but neither it nor"), "{}", said.stderr);
}

#[test]
fn programs_are_told_what_is_odd_about_a_robot() {
    let (text, _) = malformed(Link, BOX, r#"size="70 120 110""#);
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("b.urdf", text.as_bytes())]);
    let said = folder.call(&["validate", "a.toml", "--robot", "b.urdf", "--format", "json"]);
    let answer: serde_json::Value = serde_json::from_str(&said.stdout).expect("JSON");
    let found = answer["diagnostics"].as_array().expect("a list");
    assert_eq!((found.len(), &found[0]["file"], &found[0]["severity"]), (1, &"b.urdf".into(), &"warning".into()), "{answer}");
    assert!(found[0]["line"].is_u64(), "{answer}");
}

/// Masses in grams, inertias in other units and centres in millimetres are possible, but no robot's: a warning names the line.
#[test]
fn masses_that_no_matter_has_are_warned_about() {
    let (mut tiny, lines) = malformed(Link, MASS, MASS);
    for axis in ["xx", "xy", "xz", "yy", "yz", "zz"] {
        let range = Link.range();
        let at = range.start + tiny[range].find(&format!("i{axis}=\"")).expect("there") + 5;
        let end = at + tiny[at..].find('"').expect("it ends");
        let number: f64 = tiny[at..end].parse().expect("a number");
        tiny.replace_range(at..end, &format!("{:e}", number * 1e-4));
    }
    for (text, told) in [
        (malformed(Link, MASS, r#"value="4312.72""#).0, "denser than any matter"),
        (tiny, "denser than any matter"),
        (malformed(Link, CENTER, r#"xyz="-2.76 1.32 180.86""#).0, "180.886 m from the link's origin"),
    ] {
        let said = validate(text.as_bytes());
        assert_eq!(said.code, Some(0), "{}", said.stderr);
        let warned = lines.clone().any(|line| said.stderr.contains(&format!("b.urdf:{line}:")));
        assert!(warned && said.stderr.contains(told), "{told}, in lines {lines:?}: {}", said.stderr);
    }
}

#[test]
fn row_8_robots_that_are_bombs_or_no_text_are_refused() {
    let deep = format!("<robot name=\"r\">{}{}</robot>", "<gazebo>".repeat(100_000), "</gazebo>".repeat(100_000));
    let bomb = "<!DOCTYPE r [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;&a;\">]><robot name=\"&b;\"/>";
    let large = format!("{BAXTER}{}", " ".repeat(8 << 20));
    let nul = BAXTER.replacen("torso", "tor\0so", 1);
    let latin: Vec<u8> = [BAXTER.as_bytes(), b"<!-- \xff -->"].concat();
    let files: [(&[u8], &str); 6] = [
        (deep.as_bytes(), "nested deeper"),
        (bomb.as_bytes(), "DTD"),
        (large.as_bytes(), "at most"),
        (nul.as_bytes(), "not well-formed"),
        (&latin, "invalid utf-8"),
        (b"", "not well-formed"),
    ];
    for (bytes, told) in files {
        let said = validate(bytes);
        assert!(said.code == Some(3) && said.stderr.contains(told), "{told}: {:?} {}", said.code, said.stderr);
    }
    let windows = format!("\u{feff}{}", BAXTER.replace('\n', "\r\n"));
    assert_eq!(validate(windows.as_bytes()).code, Some(0), "a byte order mark and Windows line ends are no fault");
}

#[test]
fn row_10_a_mesh_outside_the_robots_folder_is_refused() {
    let (text, _) = malformed(Link, CYLINDER, "<mesh filename=\"../../../../../../etc/passwd\"/>");
    let said = validate(text.as_bytes());
    assert!(said.code == Some(3) && said.stderr.contains("outside"), "{}", said.stderr);
}
