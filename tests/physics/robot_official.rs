//! Contract: the project's Baxter is the official one in all that moves: kinematics, limits, masses, dynamics.

use cpdmp::robot::{RobotModel, SerialChain, bare_baxter, baxter};

use crate::physics::robot_arm::{GRAVITY, Spread, distance, official};

fn arms(model: &RobotModel) -> [SerialChain; 2] {
    ["left_gripper", "right_gripper"].map(|tip| SerialChain::new(model, "base", tip).unwrap())
}

#[test]
fn kinematics_and_dynamics_agree_at_a_hundred_postures() {
    let Some(official) = official() else { return };
    for (ours, theirs) in arms(&bare_baxter().model).iter().zip(&arms(&official)) {
        let (mut our_state, mut their_state) = (ours.state(), theirs.state());
        let mut spread = Spread::new(1);
        let mut torques = [[0.0; 7]; 2];
        for _ in 0..100 {
            let q = spread.posture(ours);
            ours.forward_kinematics(&q, &mut our_state);
            theirs.forward_kinematics(&q, &mut their_state);
            let (pose, their_pose) = (our_state.tip_pose(), their_state.tip_pose());
            assert!((pose.to_homogeneous() - their_pose.to_homogeneous()).amax() < 1e-9);
            assert!((our_state.jacobian() - their_state.jacobian()).amax() < 1e-9);
            let mass = ours.mass_matrix(&q, &mut our_state).clone();
            assert!((mass - theirs.mass_matrix(&q, &mut their_state)).amax() < 1e-9);
            ours.gravity_torques(&q, &GRAVITY, &mut our_state, &mut torques[0]);
            theirs.gravity_torques(&q, &GRAVITY, &mut their_state, &mut torques[1]);
            assert!(distance(&torques[0], &torques[1]) < 1e-9);
        }
    }
}

#[test]
fn limits_and_damping_agree() {
    let Some(official) = official() else { return };
    let ours = bare_baxter().model;
    for name in baxter::LEFT_ARM_JOINTS.iter().chain(&baxter::RIGHT_ARM_JOINTS).chain(&["head_pan"]) {
        let joint = |model: &RobotModel| model.joints[model.joint_index(name).unwrap()].clone();
        let (a, b) = (joint(&ours), joint(&official));
        let numbers = |joint: &cpdmp::robot::Joint| {
            [joint.lower, joint.upper, joint.velocity_limit, joint.effort_limit, joint.damping, joint.friction]
        };
        assert_eq!(numbers(&a), numbers(&b), "{name}");
    }
}
