//! Contract: the Jacobian is the derivative of forward kinematics, and forward kinematics is that of the tree of joints.

use cpdmp::robot::{ChainError, SerialChain, baxter, pose_error};
use nalgebra::{Isometry3, Vector3, Vector6};

use crate::physics::robot_arm::{Spread, left_arm};

#[test]
fn jacobian_is_the_derivative_of_the_pose() {
    let arm = left_arm();
    let mut state = arm.state();
    let mut spread = Spread::new(2);
    let step = 1e-6;
    for _ in 0..50 {
        let q = spread.posture(&arm);
        arm.forward_kinematics(&q, &mut state);
        let jacobian = state.jacobian().clone();
        for i in 0..7 {
            let mut at = |offset: f64| {
                let mut moved = q.clone();
                moved[i] += offset;
                arm.forward_kinematics(&moved, &mut state);
                state.tip_pose()
            };
            let difference: Vector6<f64> = pose_error(&at(step), &at(-step)) / (2.0 * step);
            assert!((difference - jacobian.column(i)).amax() < 1e-8, "joint {i}: {difference}");
        }
    }
}

#[test]
fn chain_agrees_with_the_tree_of_joints() {
    let model = baxter().model;
    let arm = left_arm();
    let mut state = arm.state();
    let tool = model.frame(baxter::LEFT_TOOL).unwrap();
    let mut spread = Spread::new(3);
    for _ in 0..20 {
        let q = spread.posture(&arm);
        arm.forward_kinematics(&q, &mut state);
        let mut pose = Isometry3::identity();
        for (i, (joint, &q)) in arm.joints().zip(&q).enumerate() {
            pose *= joint.parent_from_child(q);
            assert!((pose.to_homogeneous() - state.joint_pose(i).to_homogeneous()).amax() < 1e-12);
        }
        let tip = pose * tool.body_from_frame;
        assert!((tip.to_homogeneous() - state.tip_pose().to_homogeneous()).amax() < 1e-12);
    }
}

/// Worked out by hand: with all joints at zero the arm points along the mount's 45 degrees, and the tool lies 0.13 m beyond the hand.
#[test]
fn stretched_arm_reaches_where_its_lengths_add_up() {
    let arm = left_arm();
    let mut state = arm.state();
    arm.forward_kinematics(&[0.0; 7], &mut state);
    let reach = 0.055695 + 0.069 + 0.102 + 0.26242 + 0.10359 + 0.2707 + 0.115975 + 0.11355 + 0.13;
    let mount_yaw: f64 = "0.7854".parse().unwrap();
    let direction = Vector3::new(mount_yaw.cos(), mount_yaw.sin(), 0.0);
    let height = 0.118588 + 0.011038 + 0.27035 - 0.069 - 0.01;
    let expected = Vector3::new(0.024645, 0.219645, height) + direction * reach;
    let tip = state.tip_pose();
    assert!((tip.translation.vector - expected).norm() < 1e-9, "{tip} against {expected}");
    assert!((tip.rotation * Vector3::z() - direction).norm() < 1e-9, "z points out of the hand");
}

#[test]
fn chains_are_refused_with_the_reason() {
    let model = baxter().model;
    let chain = |base, tip| SerialChain::new(&model, base, tip).map(|_| ()).unwrap_err();
    assert_eq!(chain("base", "hook"), ChainError::UnknownLink("hook".to_owned()));
    assert!(matches!(chain("right_hand", "left_hand"), ChainError::NotConnected { .. }));
    assert!(matches!(chain("base", "torso"), ChainError::NoJoint { .. }));
    let frozen = SerialChain::with_frozen(&model, "base", "left_hand", &[("left_s0", 0.1)]);
    assert!(matches!(frozen, Err(ChainError::UnknownJoint(..))), "a joint of the chain cannot be frozen");
}

#[test]
fn a_chain_may_start_on_a_moving_link() {
    let model = baxter().model;
    let whole = left_arm();
    let forearm = SerialChain::new(&model, "left_lower_elbow", baxter::LEFT_TOOL).unwrap();
    assert_eq!(forearm.joint_count(), 3);
    let q = [0.3, -0.5, 0.2, 1.1, 0.4, 0.7, -0.6];
    let (mut all, mut part) = (whole.state(), forearm.state());
    whole.forward_kinematics(&q, &mut all);
    forearm.forward_kinematics(&q[4..], &mut part);
    let expected = all.joint_pose(3).inverse() * all.tip_pose();
    assert!((expected.to_homogeneous() - part.tip_pose().to_homogeneous()).amax() < 1e-12);
}
