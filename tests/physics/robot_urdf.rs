//! Contract: a malformed robot description is refused, or at least remarked on, with the line; none is accepted silently, none panics.
//!
//! rapier3d-urdf 0.36.1 panicked on two of these and took twenty without a word.

use std::path::Path;

use cpdmp::robot::{Attachment, LoadOptions, Severity, baxter, electric_gripper, load, parse};
use nalgebra::Isometry3;

use crate::physics::robot_arm::official_path;

/// A sound robot of two links; line 2 holds link `a`, lines 3 to 7 link `b`, lines 8 to 13 the joint.
const SOUND: &str = r#"<robot name="two">
  <link name="a"/>
  <link name="b">
    <inertial><origin xyz="0 0 0.1"/><mass value="1.5"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
    <collision><geometry><cylinder radius="0.05" length="0.2"/></geometry></collision>
    <visual><geometry><box size="0.1 0.1 0.2"/></geometry><material name="m"><color rgba="1 0 0 1"/></material></visual>
  </link>
  <joint name="j" type="revolute">
    <parent link="a"/>
    <child link="b"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="10" velocity="2"/>
  </joint>
</robot>"#;

use Severity::{Error, Warning};

/// What to replace by what in the sound robot, and the finding that must follow: its severity, line, and words in it.
const FAULTS: &[(&str, &str, Severity, u32, &str)] = &[
    (r#"<child link="b"/>"#, r#"<child link="c"/>"#, Error, 8, "child link `c` does not exist"),
    (r#"<parent link="a"/>"#, r#"<parent link="b"/>"#, Error, 8, "to itself"),
    ("</robot>", r#"<link name="a"/></robot>"#, Error, 14, "the name is taken at two.urdf:2"),
    ("</robot>", r#"<link name="c"/></robot>"#, Error, 14, "2 roots"),
    (
        "</robot>",
        r#"<joint name="k" type="fixed"><parent link="b"/><child link="a"/></joint></robot>"#,
        Error,
        14,
        "links a, b hang on each other in a cycle",
    ),
    (
        "</robot>",
        r#"<link name="c"/><joint name="k" type="fixed"><parent link="a"/><child link="c"/></joint>
        <joint name="l" type="fixed"><parent link="c"/><child link="b"/></joint></robot>"#,
        Error,
        15,
        "two parents: joint `j` at two.urdf:8",
    ),
    (
        "</robot>",
        r#"<link name="c"/><joint name="j" type="fixed"><parent link="a"/><child link="c"/></joint></robot>"#,
        Error,
        14,
        "joint `j`: the name is taken",
    ),
    (r#"value="1.5""#, r#"value="-1.5""#, Error, 4, "mass is negative"),
    (r#"value="1.5""#, r#"value="NaN""#, Error, 4, "must be finite"),
    (r#"value="1.5""#, r#"value="0""#, Error, 4, "no mass, yet an inertia"),
    (r#"value="1.5""#, r#"value="1,5""#, Error, 4, "write a decimal point"),
    (r#"<mass value="1.5"/>"#, "", Error, 4, "has no <mass>"),
    (r#"ixx="0.01""#, r#"ixx="-0.01""#, Error, 4, "not positive definite"),
    (r#"ixy="0""#, r#"ixy="0.02""#, Error, 4, "not positive definite"),
    (r#"izz="0.01""#, r#"izz="0.05""#, Error, 4, "exceeds the sum"),
    (r#"izz="0.01""#, "", Error, 4, "has no `izz`"),
    (r#"ixx="0.01" ixy="0" ixz="0" iyy="0.01""#, r#"ixx="1e4" ixy="0" ixz="0" iyy="1e4""#, Warning, 4, "spread over"),
    (r#"<inertial>"#, r#"<inertail>"#, Error, 4, "not well-formed"),
    (
        r#"<collision><geometry><cylinder radius="0.05" length="0.2"/></geometry></collision>"#,
        "<colision/>",
        Warning,
        5,
        "did you mean `collision`?",
    ),
    (r#"radius="0.05""#, r#"radius="-0.05""#, Error, 5, "greater than zero"),
    (r#"radius="0.05""#, r#"radius="NaN""#, Error, 5, "must be finite"),
    (r#"radius="0.05""#, r#"raduis="0.05""#, Error, 5, "has no `radius`"),
    (r#"radius="0.05""#, r#"raduis="0.05""#, Warning, 5, "did you mean `radius`?"),
    (r#"size="0.1 0.1 0.2""#, r#"size="100 100 200""#, Warning, 6, "millimetres"),
    (r#"size="0.1 0.1 0.2""#, r#"size="0.1 0.1""#, Error, 6, "must hold 3 numbers, not 2"),
    (r#"size="0.1 0.1 0.2""#, r#"size="0.1 0.1 0.2 x""#, Error, 6, "must hold 3 numbers, not 4"),
    (r#"size="0.1 0.1 0.2""#, r#"size="0.1 abc 0.2""#, Error, 6, "\"abc\", which is no number"),
    (r#"<box size="0.1 0.1 0.2"/>"#, r#"<cone size="1"/>"#, Error, 6, "has no shape"),
    (r#"rgba="1 0 0 1""#, r#"rgba="255 0 0 255""#, Error, 6, "between 0 and 1"),
    (r#"<color rgba="1 0 0 1"/>"#, "", Warning, 6, "no colour is given for material `m`"),
    (r#"type="revolute""#, r#"type="revolut""#, Error, 8, "unknown type `revolut`"),
    (r#"type="revolute""#, r#"type="planar""#, Error, 8, "one degree of freedom"),
    (r#"xyz="0 0 1""#, r#"xyz="0 0 0""#, Error, 11, "no direction"),
    (r#"lower="-1" upper="1""#, r#"lower="1" upper="-1""#, Error, 12, "lower (1) is greater than upper (-1)"),
    (r#"lower="-1" upper="1""#, "", Error, 12, "neither"),
    (r#"lower="-1""#, r#"lower="-inf""#, Error, 12, "must be finite"),
    (r#"<limit lower="-1" upper="1" effort="10" velocity="2"/>"#, "", Error, 8, "has no <limit>"),
    (r#"effort="10""#, r#"effort="-10""#, Error, 12, "negative"),
    (r#"<limit "#, r#"<limits lower="0"/><limit "#, Warning, 12, "did you mean `limit`?"),
    (r#"<limit "#, r#"<mimic joint="k"/><limit "#, Error, 8, "mimics joint `k`, which does not exist"),
    (r#"<limit "#, r#"<safety_controller k_velocity="1"/><limit "#, Warning, 12, "not simulated"),
    (r#"<link name="a"/>"#, r#"<link/>"#, Error, 2, "has no `name`"),
    (r#"<cylinder radius="0.05" length="0.2"/>"#, r#"<mesh filename="none.stl"/>"#, Error, 5, "is missing"),
    (r#"<box size="0.1 0.1 0.2"/>"#, r#"<mesh filename="none.stl"/>"#, Warning, 6, "is missing"),
    (r#"<box size="0.1 0.1 0.2"/>"#, r#"<mesh filename="/etc/passwd"/>"#, Error, 6, "only package://"),
    (r#"<box size="0.1 0.1 0.2"/>"#, r#"<mesh filename="../../../../../etc/passwd"/>"#, Error, 6, "outside"),
    (r#"<box size="0.1 0.1 0.2"/>"#, r#"<mesh filename="package://nowhere/x.stl"/>"#, Warning, 6, "no directory called `nowhere`"),
    (r#"<joint name="j""#, "<joint", Error, 8, "has no `name`"),
];

#[test]
fn the_sound_robot_is_taken_without_a_word() {
    let loaded = parse(SOUND, "two.urdf", &LoadOptions::default()).unwrap();
    assert_eq!(loaded.warnings, []);
    assert_eq!((loaded.model.bodies.len(), loaded.model.joints.len()), (2, 1));
}

#[test]
fn every_fault_is_found_with_its_line() {
    for &(sound, faulty, severity, line, words) in FAULTS {
        assert!(SOUND.contains(sound), "{sound}");
        let text = SOUND.replacen(sound, faulty, 1);
        let (refused, findings) = match parse(&text, "two.urdf", &LoadOptions::default()) {
            Ok(loaded) => (false, loaded.warnings),
            Err(fault) => (true, fault.findings),
        };
        let said: Vec<String> = findings.iter().map(ToString::to_string).collect();
        let found = findings
            .iter()
            .zip(&said)
            .any(|(finding, said)| finding.severity == severity && finding.line == Some(line) && said.contains(words));
        assert!(found, "{faulty}: expected {severity:?} in line {line} with \"{words}\", found\n{}", said.join("\n"));
        assert!(refused || severity == Warning, "{faulty} was taken");
    }
}

#[test]
fn a_moving_body_needs_mass_of_its_own_or_of_what_is_fixed_to_it() {
    let bare =
        r#"<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint>"#;
    let fault = parse(&format!("{bare}</robot>"), "r.urdf", &LoadOptions::default()).unwrap_err();
    assert!(fault.to_string().contains("link `b`: moves on joint `j`, but neither"), "{fault}");
    let held = r#"<link name="c"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
        <joint name="k" type="fixed"><parent link="b"/><child link="c"/></joint></robot>"#;
    assert!(parse(&format!("{bare}{held}"), "r.urdf", &LoadOptions::default()).is_ok());
}

#[test]
fn all_faults_are_named_at_once() {
    let text = SOUND.replace("value=\"1.5\"", "value=\"-1\"").replace("radius=\"0.05\"", "radius=\"0\"").replace("\"2\"", "\"x\"");
    let findings = parse(&text, "two.urdf", &LoadOptions::default()).unwrap_err().findings;
    assert_eq!(findings.iter().map(|finding| finding.line).collect::<Vec<_>>(), [Some(4), Some(5), Some(12)]);
}

#[test]
fn what_is_no_robot_description_is_refused() {
    let deep = format!("<robot name=\"r\">{}{}</robot>", "<gazebo>".repeat(100_000), "</gazebo>".repeat(100_000));
    let long = " ".repeat(5 << 20);
    let bomb = r#"<!DOCTYPE r [<!ENTITY a "aaaa">]><robot name="&a;"/>"#;
    let half = &SOUND[..SOUND.len() / 2];
    for text in ["", "no xml", "<sdf/>", "<robot name=\"r\"/>", "\u{0}", &deep, &long, bomb, half] {
        let fault = parse(text, "x.urdf", &LoadOptions::default()).unwrap_err();
        assert!(fault.findings.iter().any(|finding| finding.severity == Error));
    }
    assert!(load(Path::new("/nowhere/robot.urdf"), &LoadOptions::default()).is_err());
    assert!(load(Path::new("/"), &LoadOptions::default()).is_err());
}

#[test]
fn a_file_from_windows_is_read() {
    let text = format!("\u{feff}{}", SOUND.replace('\n', "\r\n"));
    assert!(parse(&text, "two.urdf", &LoadOptions::default()).is_ok());
}

/// Every cut and every changed byte of a sound file ends in a model or in findings.
#[test]
fn damaged_files_never_panic() {
    for cut in 0..SOUND.len() {
        let _ = parse(&SOUND[..cut], "cut.urdf", &LoadOptions::default());
        for byte in ["<", "\"", "9", "-", ">"] {
            let text = format!("{}{byte}{}", &SOUND[..cut], &SOUND[cut + 1..]);
            let _ = parse(&text, "changed.urdf", &LoadOptions::default());
        }
    }
}

#[test]
fn an_attachment_needs_a_link_to_stand_on_and_names_of_its_own() {
    let attach = |parent_link: &str, text: &str| {
        let attachments = vec![Attachment {
            text: text.to_owned(),
            origin: "tool.urdf".to_owned(),
            parent_link: parent_link.to_owned(),
            parent_from_child: Isometry3::translation(0.0, 0.0, 0.1),
        }];
        parse(SOUND, "two.urdf", &LoadOptions { attachments, ..LoadOptions::default() })
    };
    let tool = r#"<robot name="tool"><link name="t"/></robot>"#;
    let model = attach("b", tool).unwrap().model;
    assert_eq!(model.frame("t").unwrap().body, 1);
    assert!(attach("hand", tool).unwrap_err().to_string().contains("`hand` does not exist"));
    assert!(attach("b", SOUND).unwrap_err().to_string().contains("the name is taken at two.urdf:2"));
    let broken = attach("b", r#"<robot name="tool"><link/></robot>"#).unwrap_err();
    assert!(broken.to_string().starts_with("tool.urdf:1: error"), "{broken}");
}

#[test]
fn a_colour_given_once_serves_every_visual_that_names_it() {
    let named = r#"<link name="c"><visual><geometry><sphere radius="0.1"/></geometry><material name="m"/></visual></link>
        <joint name="k" type="fixed"><parent link="a"/><child link="c"/></joint></robot>"#;
    let loaded = parse(&SOUND.replace("</robot>", named), "two.urdf", &LoadOptions::default()).unwrap();
    assert_eq!(loaded.warnings, []);
    assert_eq!(loaded.model.bodies[0].visuals[0].color_rgba, [1.0, 0.0, 0.0, 1.0]);
}

#[test]
fn fixed_links_add_up() {
    let held = r#"<link name="c"><inertial><origin xyz="0 0 0"/><mass value="0.5"/>
        <inertia ixx="0.002" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.001"/></inertial></link>
        <joint name="k" type="fixed"><origin xyz="0 0 0.3" rpy="1.5707963267948966 0 0"/>
        <parent link="b"/><child link="c"/></joint></robot>"#;
    let model = parse(&SOUND.replace("</robot>", held), "two.urdf", &LoadOptions::default()).unwrap().model;
    let body = &model.bodies[1];
    assert!((body.mass_kg - 2.0).abs() < 1e-12);
    // Centres at 0.1 and 0.3: 0.15 together, 0.05 and 0.15 away. The held part is turned, so its small moment lies along y.
    assert!((body.center_of_mass.z - 0.15).abs() < 1e-12);
    let apart = 1.5 * 0.05 * 0.05 + 0.5 * 0.15 * 0.15;
    let expected = [0.012 + apart, 0.011 + apart, 0.012];
    for (i, expected) in expected.into_iter().enumerate() {
        assert!((body.inertia[(i, i)] - expected).abs() < 1e-12, "{}", body.inertia);
    }
}

#[test]
fn the_built_in_robot_gives_no_cause_for_complaint() {
    let loaded = baxter();
    assert_eq!(loaded.warnings, []);
    let model = loaded.model;
    assert_eq!(model.joints.len(), 17, "a head, two arms of seven, two fingers");
    for (i, joint) in model.joints.iter().enumerate() {
        assert!(joint.child_body == i + 1 && joint.parent_body <= i, "parents come before children");
    }
    for name in baxter::LEFT_ARM_JOINTS.iter().chain(&baxter::RIGHT_ARM_JOINTS).chain(&baxter::LEFT_FINGER_JOINTS) {
        let joint = &model.joints[model.joint_index(name).unwrap()];
        let body = &model.bodies[joint.child_body];
        assert!(body.mass_kg > 0.0 && !body.collisions.is_empty() && !body.visuals.is_empty(), "{name}");
    }
    let leader = model.joint_index(baxter::LEFT_FINGER_JOINTS[0]);
    let follower = model.joint_index(baxter::LEFT_FINGER_JOINTS[1]).unwrap();
    assert_eq!(model.joints[follower].mimic.map(|mimic| mimic.joint), leader);
}

#[test]
fn the_official_robot_loads_and_takes_the_gripper() {
    let Some(path) = official_path() else { return };
    let loaded = load(&path, &LoadOptions { attachments: vec![electric_gripper()], ..LoadOptions::default() }).unwrap();
    assert!(loaded.model.frame(baxter::LEFT_TOOL).is_some());
    let said: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(said.iter().filter(|said| said.contains("is missing")).count(), 2, "{said:#?}");
    assert_eq!(said.iter().filter(|said| said.contains("`gravity` is not simulated")).count(), 1, "{said:#?}");
    assert_eq!(said.len(), 3, "{said:#?}");
}
