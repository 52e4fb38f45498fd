//! The arm in the engine against the project's own dynamics, and the drives' limits.

use cpdmp::control::ArmModel;
use cpdmp::robot::{JointCommand, SerialChain};

use cpdmp::world::ObjectKind;
use nalgebra::Vector2;

use crate::support::{LEFT_POSTURE, baxter, object, world};

const G: [f64; 3] = [0.0, 0.0, -9.81];

#[test]
fn the_engine_has_the_mass_matrix_of_the_project_s_own_dynamics() {
    let robot = baxter();
    for shift in [0.0, 0.2, -0.25] {
        let posture = LEFT_POSTURE.map(|angle| angle + shift);
        let mut world = world(&robot, &posture, &[], [0.0; 3], 0.0);
        world.command_arm(&JointCommand::zero(7));
        world.advance().expect("finite");
        let engine = world.mass_matrix().expect("a mass matrix");
        // The world starts with an open gripper.
        let chain =
            SerialChain::with_frozen(&robot, "base", "left_gripper_tool", &[("left_gripper_l_finger_joint", 0.020833)]).expect("a chain");
        let mut state = chain.state();
        let own = chain.mass_matrix(&posture, &mut state);
        let worst = (engine.view((0, 0), (7, 7)) - own).abs().max();
        assert!(worst < 1e-9 * own.abs().max(), "largest difference {worst:e} of {}", own.abs().max());
    }
}

#[test]
fn gravity_compensation_holds_the_arm_still() {
    let robot = baxter();
    let mut world = world(&robot, &LEFT_POSTURE, &[], G, 0.0);
    let mut arm = ArmModel::new(&robot, "left_gripper_tool", &LEFT_POSTURE, G).expect("an arm");
    let (mut q, mut v, mut command) = ([0.0; 7], [0.0; 7], JointCommand::zero(7));
    for _ in 0..5000 {
        world.read_arm(&mut q, &mut v);
        arm.gravity_torques(&q, &mut command.torque_nm);
        world.command_arm(&command);
        world.advance().expect("finite");
    }
    world.read_arm(&mut q, &mut v);
    let drift = q.iter().zip(LEFT_POSTURE).map(|(q, start)| (q - start).abs()).fold(0.0, f64::max);
    assert!(drift < 1e-3, "drifted {drift} rad in 5 s");
}

#[test]
fn drives_respect_effort_and_velocity_limits_and_joints_their_range() {
    let robot = baxter();
    let mut world = world(&robot, &LEFT_POSTURE, &[], G, 0.0);
    let mut command = JointCommand::zero(7);
    let (mut q, mut v, mut effort) = ([0.0; 7], [0.0; 7], [0.0; 7]);
    let joints: Vec<_> = robot.joints.iter().filter(|joint| joint.name.starts_with("left_") && joint.name.len() == 7).collect();
    assert_eq!(joints.len(), 7);
    for step in 0..3000 {
        let push = if (step / 700) % 2 == 0 { 500.0 } else { -500.0 };
        command.torque_nm.fill(push);
        world.command_arm(&command);
        world.advance().expect("finite");
        world.read_arm(&mut q, &mut v);
        world.read_efforts(&mut effort);
        for (i, joint) in joints.iter().enumerate() {
            assert!(effort[i].abs() <= joint.effort_limit * (1.0 + 1e-12), "{}: {} N m", joint.name, effort[i]);
            // The other joints' motion may carry one a little beyond its limit before its drive has braked it.
            assert!(v[i].abs() <= joint.velocity_limit * 1.2, "{}: {} rad/s", joint.name, v[i]);
            assert!(q[i] <= joint.upper + 0.02 && q[i] >= joint.lower - 0.02, "{}: {} rad", joint.name, q[i]);
        }
    }
}

/// Found by the baseline scraping over a block: damping that reacts to an impact within the step once drove 21 N m through a 15 N m wrist.
#[test]
fn an_arm_that_strikes_a_table_keeps_its_mean_effort_within_the_limits() {
    const STRETCH: usize = 20;
    let robot = baxter();
    let kind = ObjectKind::Table { size_m: Vector2::new(0.7, 1.3), top_height_m: -0.15, friction: 0.6.into() };
    let mut world = world(&robot, &LEFT_POSTURE, &[object("table", [0.7, 0.25], kind)], G, 0.0);
    let limits: Vec<f64> =
        robot.joints.iter().filter(|j| j.name.starts_with("left_") && j.name.len() == 7).map(|j| j.effort_limit).collect();
    // Limp shoulder and elbow, so that the arm falls; a wrist that is pressed against its limits.
    let mut command = JointCommand::zero(7);
    command.damping_nms_per_rad = vec![0.0, 0.0, 0.0, 0.0, 8.0, 8.0, 4.0];
    let mut effort = [0.0; 7];
    let mut history: Vec<[f64; 7]> = Vec::new();
    for step in 0..2000 {
        let push = if (step / 50) % 2 == 0 { 14.0 } else { -14.0 };
        command.torque_nm[4..].fill(push);
        world.command_arm(&command);
        world.advance().expect("finite");
        world.read_efforts(&mut effort);
        history.push(effort);
    }
    assert!(world.contacts().iter().any(|contact| contact.b == "table"), "the arm has struck the table");
    for stretch in history.windows(STRETCH) {
        for (i, limit) in limits.iter().enumerate() {
            let mean = stretch.iter().map(|effort| effort[i]).sum::<f64>() / STRETCH as f64;
            assert!(mean.abs() <= limit * (1.0 + 1.0 / STRETCH as f64), "joint {i}: {mean} N m");
        }
    }
}
