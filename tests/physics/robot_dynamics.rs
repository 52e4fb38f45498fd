//! Contract: inverse dynamics and mass matrix obey the laws of mechanics for the bodies of the model, whatever way they are computed.

use cpdmp::robot::{SerialChain, baxter};
use nalgebra::{DVector, Isometry3, Point3, Vector3};

use crate::physics::robot_arm::{BAXTER, GRAVITY, Spread, distance, left_arm};

/// A body of the model and where it is.
type Placed = (usize, Isometry3<f64>);

/// Poses of all bodies that the left arm moves, gripper fingers in the middle of their travel, straight from the tree of joints.
fn body_poses(q: &[f64]) -> Vec<Placed> {
    let model = &*BAXTER;
    let mut all: Vec<f64> = model.joints.iter().map(|joint| joint.middle()).collect();
    for (name, &q) in baxter::LEFT_ARM_JOINTS.iter().zip(q) {
        all[model.joint_index(name).unwrap()] = q;
    }
    let mut poses = vec![Isometry3::identity(); model.bodies.len()];
    let mut moved = Vec::new();
    for (i, joint) in model.joints.iter().enumerate() {
        poses[joint.child_body] = poses[joint.parent_body] * joint.parent_from_child(model.position_of(i, &all));
        if joint.name.starts_with("left_") {
            moved.push((joint.child_body, poses[joint.child_body]));
        }
    }
    moved
}

fn potential_energy(q: &[f64]) -> f64 {
    let bodies = &BAXTER.bodies;
    let height = |body: usize, pose: &Isometry3<f64>| (pose * Point3::from(bodies[body].center_of_mass)).z;
    body_poses(q).iter().map(|(body, pose)| 9.81 * bodies[*body].mass_kg * height(*body, pose)).sum()
}

/// From differences of body poses, not from any Jacobian.
fn kinetic_energy(q: &[f64], v: &[f64]) -> f64 {
    let bodies = &BAXTER.bodies;
    let step = 1e-6;
    let at = |sign: f64| body_poses(&q.iter().zip(v).map(|(q, v)| q + sign * step * v).collect::<Vec<_>>());
    let energy = |(after, before): (&Placed, &Placed)| {
        let body = &bodies[after.0];
        let center = Point3::from(body.center_of_mass);
        let speed = (after.1 * center - before.1 * center) / (2.0 * step);
        let rate: Vector3<f64> = (before.1.rotation.inverse() * after.1.rotation).scaled_axis() / (2.0 * step);
        0.5 * body.mass_kg * speed.norm_squared() + 0.5 * rate.dot(&(body.inertia * rate))
    };
    at(1.0).iter().zip(&at(-1.0)).map(energy).sum()
}

fn efforts(arm: &SerialChain, q: &[f64], v: &[f64], a: &[f64], gravity: &Vector3<f64>) -> Vec<f64> {
    let mut tau = vec![0.0; 7];
    arm.inverse_dynamics(q, v, a, gravity, &mut arm.state(), &mut tau);
    tau
}

#[test]
fn mass_matrix_columns_are_efforts_of_unit_accelerations() {
    let arm = left_arm();
    let mut state = arm.state();
    let mut spread = Spread::new(4);
    for _ in 0..100 {
        let q = spread.posture(&arm);
        let mass = arm.mass_matrix(&q, &mut state).clone();
        for i in 0..7 {
            let mut unit = [0.0; 7];
            unit[i] = 1.0;
            let column = efforts(&arm, &q, &[0.0; 7], &unit, &Vector3::zeros());
            assert!(distance(&column, mass.column(i).iter()) < 1e-12);
        }
        assert!(mass.clone().cholesky().is_some(), "not positive definite at {q:?}");
    }
}

#[test]
fn kinetic_energy_is_that_of_the_bodies() {
    let arm = left_arm();
    let mut spread = Spread::new(5);
    for _ in 0..20 {
        let (q, v) = (spread.posture(&arm), spread.vector(7, 1.5));
        let velocity = DVector::from_column_slice(&v);
        let energy = 0.5 * velocity.dot(&(arm.mass_matrix(&q, &mut arm.state()) * &velocity));
        assert!((energy - kinetic_energy(&q, &v)).abs() < 1e-7 * energy.max(1.0));
    }
}

#[test]
fn gravity_torques_are_the_gradient_of_potential_energy() {
    let arm = left_arm();
    let mut spread = Spread::new(6);
    let mut tau = [0.0; 7];
    for _ in 0..20 {
        let q = spread.posture(&arm);
        arm.gravity_torques(&q, &GRAVITY, &mut arm.state(), &mut tau);
        for i in 0..7 {
            let at = |offset: f64| {
                let mut moved = q.clone();
                moved[i] += offset;
                potential_energy(&moved)
            };
            let slope = (at(1e-5) - at(-1e-5)) / 2e-5;
            assert!((slope - tau[i]).abs() < 1e-6, "joint {i}: {slope} against {}", tau[i]);
        }
    }
}

/// Caught by no symmetric test: a wrong Coriolis term does work.
#[test]
fn power_of_the_efforts_is_the_rate_of_energy() {
    let arm = left_arm();
    let mut spread = Spread::new(7);
    for _ in 0..20 {
        let (q, v, a) = (spread.posture(&arm), spread.vector(7, 1.5), spread.vector(7, 3.0));
        let power: f64 = efforts(&arm, &q, &v, &a, &GRAVITY).iter().zip(&v).map(|(tau, v)| tau * v).sum();
        let energy = |t: f64| {
            let q: Vec<f64> = (0..7).map(|i| q[i] + v[i] * t + 0.5 * a[i] * t * t).collect();
            let v = DVector::from_fn(7, |i, _| v[i] + a[i] * t);
            0.5 * v.dot(&(arm.mass_matrix(&q, &mut arm.state()) * &v)) + potential_energy(&q)
        };
        let rate = (energy(1e-5) - energy(-1e-5)) / 2e-5;
        assert!((rate - power).abs() < 1e-5 * power.abs().max(10.0), "{rate} against {power}");
    }
}

#[test]
fn a_frozen_finger_moves_the_mass_with_it() {
    let chain = |finger| {
        let frozen = [(baxter::LEFT_FINGER_JOINTS[0], finger)];
        SerialChain::with_frozen(&BAXTER, baxter::BASE_LINK, baxter::LEFT_TOOL, &frozen).unwrap()
    };
    let (closed, open) = (chain(0.0), chain(0.020833));
    assert!((closed.moving_mass() - open.moving_mass()).abs() < 1e-12);
    assert!((open.moving_mass() - left_arm().moving_mass()).abs() < 1e-12);
    let about_hand = |arm: &SerialChain| arm.mass_matrix(&[0.0; 7], &mut arm.state())[(6, 6)];
    // Two fingers of 20 g, their centres 7 mm outside the pads, which are 22 mm from the hand's axis when closed.
    let expected = 2.0 * 0.02 * ((0.022f64 + 0.020833 + 0.007).powi(2) - (0.022f64 + 0.007).powi(2));
    assert!((about_hand(&open) - about_hand(&closed) - expected).abs() < 1e-12, "the right finger mimics the left");
}

/// Figures of pinocchio 4.1.0 (rnea, crba, frame placement) for the same two files joined at the hand, fingers in the middle.
#[test]
fn agrees_with_pinocchio() {
    let arm = left_arm();
    let mut state = arm.state();
    let q = [0.3, -0.5, 0.2, 1.1, 0.4, 0.7, -0.6];
    let v = [0.5, -0.4, 0.3, 0.6, -0.7, 0.8, -0.9];
    let a = [1.0, 2.0, -1.5, 0.5, 3.0, -2.0, 1.2];
    let expected = [
        0.7658247619393443,
        -42.842510915379954,
        3.593725123574477,
        -10.266302333387404,
        0.8661458209212555,
        -0.10418604507905452,
        0.012355964393208362,
    ];
    assert!(distance(&efforts(&arm, &q, &v, &a, &GRAVITY), &expected) < 1e-10);
    let mass = arm.mass_matrix(&q, &mut state);
    let picked = [mass[(0, 0)], mass[(1, 1)], mass[(6, 6)], mass[(0, 1)], mass[(1, 3)], mass[(3, 6)]];
    let expected =
        [3.314860843723345, 2.6806178247764114, 0.0010781088939234003, 0.07456967406797103, 1.019786898262694, 0.00027034935625085675];
    assert!(distance(&picked, &expected) < 1e-10);
    arm.forward_kinematics(&q, &mut state);
    let expected = Vector3::new(0.23162964528370467, 1.0931659282695407, -0.006641053566923738);
    assert!((state.tip_pose().translation.vector - expected).norm() < 1e-10);
}
