//! The built-in robot: Baxter with the electric gripper on its left hand, and the names of its parts.

use nalgebra::Isometry3;

use super::urdf::{Attachment, LoadOptions, Loaded, parse};

/// Description of Baxter (URDF), the project's own.
pub const BAXTER_URDF: &str = include_str!("../../assets/baxter/baxter.urdf");
/// Description of the electric gripper (URDF), for the left hand.
pub const ELECTRIC_GRIPPER_URDF: &str = include_str!("../../assets/baxter/electric_gripper.urdf");

/// Description of the hook (URDF), for the left hand in place of the gripper.
pub const HOOK_URDF: &str = include_str!("../../assets/baxter/hook.urdf");

/// Link that Baxter's poses are given in: the robot's root, 0.93 m above the floor.
pub const BASE_LINK: &str = "base";
/// Last link of the left arm, which carries the gripper.
pub const LEFT_HAND: &str = "left_hand";
/// Last link of the right arm.
pub const RIGHT_HAND: &str = "right_hand";
/// Frame between the pads of the electric gripper: z out of the hand, fingers open along y.
pub const LEFT_TOOL: &str = "left_gripper_tool";
/// The hook: z out of the hand, x along the bar that it takes, the middle of its pocket at the origin.
pub const LEFT_HOOK: &str = "left_hook";
/// Joints of the left arm from shoulder to wrist.
pub const LEFT_ARM_JOINTS: [&str; 7] = ["left_s0", "left_s1", "left_e0", "left_e1", "left_w0", "left_w1", "left_w2"];
/// Joints of the right arm from shoulder to wrist.
pub const RIGHT_ARM_JOINTS: [&str; 7] = ["right_s0", "right_s1", "right_e0", "right_e1", "right_w0", "right_w1", "right_w2"];
/// Finger joints of the electric gripper; the second mimics the first.
pub const LEFT_FINGER_JOINTS: [&str; 2] = ["left_gripper_l_finger_joint", "left_gripper_r_finger_joint"];
/// Opening between the pads when the fingers are closed, q = 0 (m); each finger adds q.
pub const GRIPPER_CLOSED_OPENING: f64 = 0.044;

/// How far a tool's base lies beyond the hand (m), along the hand's z axis.
const TOOL_MOUNT: f64 = 0.025;

/// Baxter with the electric gripper on its left hand.
pub fn baxter() -> Loaded {
    built_in(vec![electric_gripper()])
}

/// Baxter with the hook on its left hand.
pub fn baxter_with_hook() -> Loaded {
    built_in(vec![hook()])
}

/// Baxter with nothing on its hands.
pub fn bare_baxter() -> Loaded {
    built_in(Vec::new())
}

/// The electric gripper, for the left hand of any Baxter.
pub fn electric_gripper() -> Attachment {
    on_left_hand(ELECTRIC_GRIPPER_URDF, "electric_gripper.urdf")
}

/// The hook, for the left hand of any Baxter.
pub fn hook() -> Attachment {
    on_left_hand(HOOK_URDF, "hook.urdf")
}

fn on_left_hand(text: &str, origin: &str) -> Attachment {
    Attachment {
        text: text.to_owned(),
        origin: origin.to_owned(),
        parent_link: LEFT_HAND.to_owned(),
        parent_from_child: Isometry3::translation(0.0, 0.0, TOOL_MOUNT),
    }
}

fn built_in(attachments: Vec<Attachment>) -> Loaded {
    let options = LoadOptions { attachments, ..LoadOptions::default() };
    match parse(BAXTER_URDF, "baxter.urdf", &options) {
        Ok(loaded) => loaded,
        Err(fault) => unreachable!("the built-in robot is part of the program and tested: {fault}"),
    }
}
