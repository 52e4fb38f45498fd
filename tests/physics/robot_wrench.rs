//! Contract: the estimate returns the wrench that acted, with the sign of the environment acting on the tool.

use cpdmp::robot::{EffortModel, JointReading, SerialChain, Wrench, WrenchEstimator};
use nalgebra::{Vector3, Vector6};

use crate::physics::robot_arm::{GRAVITY, Spread, left_arm};

/// Efforts of an arm that moves so while the environment applies `wrench`: M a + h = tau + Jᵀ F.
fn efforts(arm: &SerialChain, q: &[f64], v: &[f64], a: &[f64], wrench: &Vector6<f64>) -> Vec<f64> {
    let mut state = arm.state();
    let mut tau = vec![0.0; 7];
    arm.inverse_dynamics(q, v, a, &GRAVITY, &mut state, &mut tau);
    arm.forward_kinematics(q, &mut state);
    let by_environment = state.jacobian().transpose() * wrench;
    tau.iter().zip(by_environment.iter()).map(|(tau, theirs)| tau - theirs).collect()
}

fn six(wrench: &Wrench) -> Vector6<f64> {
    let (f, m) = (wrench.force, wrench.torque);
    Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z)
}

#[test]
fn full_dynamics_recover_the_wrench_in_motion() {
    let arm = left_arm();
    let mut state = arm.state();
    let mut estimator = WrenchEstimator::new(&arm, EffortModel::FullDynamics, 0.0);
    let mut spread = Spread::new(10);
    let mut tried = 0;
    while tried < 100 {
        let (q, v, a) = (spread.posture(&arm), spread.vector(7, 1.5), spread.vector(7, 3.0));
        arm.forward_kinematics(&q, &mut state);
        if state.manipulability() < 0.01 {
            continue;
        }
        tried += 1;
        let wrench = Vector6::from_iterator(spread.vector(6, 10.0));
        let effort = efforts(&arm, &q, &v, &a, &wrench);
        let reading = JointReading { q: &q, v: &v, a: &a, effort: &effort };
        let estimate = estimator.estimate(&arm, &reading, &GRAVITY, &mut state).unwrap();
        assert!((six(&estimate) - wrench).amax() < 1e-7, "{estimate:?} against {wrench}");
    }
}

/// The sign in plain words: a hand pressing down on the tool appears as a force along -z, and the motors push less than gravity needs
/// where the hand helps.
#[test]
fn a_weight_on_the_tool_pulls_down() {
    let arm = left_arm();
    let mut state = arm.state();
    let q = [-0.4347, -1.0645, -0.4138, 1.9340, 0.2873, 0.7587, -0.2272];
    let mut holding = [0.0; 7];
    arm.gravity_torques(&q, &GRAVITY, &mut state, &mut holding);
    let weight = Vector6::new(0.0, 0.0, -9.81, 0.0, 0.0, 0.0);
    let effort = efforts(&arm, &q, &[0.0; 7], &[0.0; 7], &weight);
    let work_more = effort.iter().zip(&holding).map(|(with, without)| with.abs() - without.abs()).sum::<f64>();
    assert!(work_more > 0.0, "carrying a kilogram takes more effort");
    let mut estimator = WrenchEstimator::new(&arm, EffortModel::GravityOnly, 0.0);
    let reading = JointReading { q: &q, v: &[0.0; 7], a: &[0.0; 7], effort: &effort };
    let estimate = estimator.estimate(&arm, &reading, &GRAVITY, &mut state).unwrap();
    assert!((estimate.force - Vector3::new(0.0, 0.0, -9.81)).norm() < 1e-9, "{estimate:?}");
    assert!(estimate.torque.norm() < 1e-9, "the torque is about the tip point");
}

#[test]
fn gravity_alone_takes_inertia_for_contact() {
    let arm = left_arm();
    let mut state = arm.state();
    let q = [-0.4347, -1.0645, -0.4138, 1.9340, 0.2873, 0.7587, -0.2272];
    let a = [2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let effort = efforts(&arm, &q, &[0.0; 7], &a, &Vector6::zeros());
    let reading = JointReading { q: &q, v: &[0.0; 7], a: &a, effort: &effort };
    let mut force = |model| {
        let mut estimator = WrenchEstimator::new(&arm, model, 0.0);
        estimator.estimate(&arm, &reading, &GRAVITY, &mut state).unwrap().force.norm()
    };
    assert!(force(EffortModel::FullDynamics) < 1e-9);
    assert!(force(EffortModel::GravityOnly) > 1.0);
}

#[test]
fn damping_bounds_the_estimate_where_the_arm_is_stretched() {
    let arm = left_arm();
    let mut state = arm.state();
    let q = [0.1, 0.2, 0.0, 1e-4, 0.0, 1e-4, 0.0];
    let mut effort = efforts(&arm, &q, &[0.0; 7], &[0.0; 7], &Vector6::zeros());
    effort.iter_mut().for_each(|effort| *effort += 0.1);
    let reading = JointReading { q: &q, v: &[0.0; 7], a: &[0.0; 7], effort: &effort };
    let mut damped = WrenchEstimator::new(&arm, EffortModel::GravityOnly, 2.5e-3);
    let estimate = damped.estimate(&arm, &reading, &GRAVITY, &mut state).unwrap();
    // |F| <= |residual| / (2 lambda): 0.1 sqrt(7) / (2 * 0.05).
    assert!(six(&estimate).norm() <= 0.1 * 7f64.sqrt() / 0.1, "{estimate:?}");
}
