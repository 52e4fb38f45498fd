//! The orientation is a primitive of its own: it repeats what was taught, also through several turns, and reaches new goals from anywhere.

use std::f64::consts::PI;

use cpdmp::demonstration::synthetic::PickAndPlace;
use cpdmp::demonstration::{Dataset, Demonstration, Trajectory};
use cpdmp::learning::dmp::Integrator;
use cpdmp::learning::phmm::PhmmSettings;
use cpdmp::learning::{
    ExecutionSettings, Features, LearningError, LearningSettings, Measured, Skill, SkillExecution, StepInput, generate, learn,
};
use cpdmp::math::{exp_map, log_map, minimum_jerk};
use nalgebra::{DMatrix, DVector, UnitQuaternion, Vector3};

/// Tumbling: three turns about z while the axis itself goes once round x, more or less of it with theta.
fn tumbling(u: f64, theta: f64) -> UnitQuaternion<f64> {
    let p = minimum_jerk(u).position;
    exp_map(&(Vector3::z() * (6.0 * PI * p)))
        * exp_map(&(Vector3::new(1.0, 0.2, 0.0) * (2.0 * PI * p)))
        * exp_map(&(Vector3::y() * (theta * p)))
}

fn dataset(motion: fn(f64, f64) -> UnitQuaternion<f64>, thetas: &[f64]) -> Dataset {
    let names = |list: &[&str]| list.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
    let samples = 501;
    let demonstration = |(k, theta): (usize, &f64)| {
        let row = |t: usize| {
            let u = t as f64 / (samples - 1) as f64;
            // The sign of a recorded quaternion means nothing.
            let q = motion(u, *theta).coords * if (t / 37 + k).is_multiple_of(2) { 1.0 } else { -1.0 };
            [minimum_jerk(u).position, q.x, q.y, q.z, q.w]
        };
        let values = DMatrix::from_fn(samples, 5, |t, j| row(t)[j]);
        let times = (0..samples).map(|t| t as f64 * 0.02).collect();
        let trajectory = Trajectory::new(times, names(&["x_m", "qx", "qy", "qz", "qw"]), values).unwrap();
        Demonstration { name: format!("demonstration_{k}"), trajectory, theta_m: vec![("bend".to_owned(), *theta)], theta_f: Vec::new() }
    };
    Dataset {
        motion: names(&["x_m"]),
        wrench: Vec::new(),
        parameter_source: cpdmp::demonstration::ParameterSource::Given,
        demonstrations: thetas.iter().enumerate().map(demonstration).collect(),
    }
}

fn learned(dataset: &Dataset) -> Skill {
    learn(dataset, &LearningSettings::default(), 0).unwrap().skill
}

fn at(theta: f64) -> ExecutionSettings {
    ExecutionSettings { theta_m: vec![("bend".to_owned(), theta)], ..Default::default() }
}

/// Largest angles (rad) from the taught motion: of the execution, and of the regressed profile that it follows.
fn errors(skill: &Skill, asked: &ExecutionSettings, taught: impl Fn(f64) -> UnitQuaternion<f64>) -> [f64; 2] {
    let theta = DVector::from_element(1, asked.theta_m[0].1);
    let profile = skill.orientation.as_ref().unwrap().at(&theta);
    let mut execution = SkillExecution::new(skill, asked).unwrap();
    let dt = execution.duration_s() / 1000.0;
    let mut worst = [0.0f64; 2];
    for i in 0..=1000 {
        let state = if i == 0 { execution.state() } else { execution.step(&StepInput::of(dt)) };
        let truth = taught(state.u);
        for (worst, q) in worst.iter_mut().zip([state.orientation.unwrap(), profile.orientation(state.u)]) {
            *worst = worst.max(truth.angle_to(&q));
        }
    }
    worst
}

#[test]
fn what_was_taught_comes_out_as_well_as_the_regression_knows_it() {
    let skill = learned(&dataset(tumbling, &[-0.3, 0.0, 0.3]));
    assert!(skill.orientation.as_ref().unwrap().path.is_some(), "several turns need a reference that moves");
    for theta in [-0.3, 0.1, 0.3] {
        let [execution, profile] = errors(&skill, &at(theta), |u| tumbling(u, theta));
        println!("tumbling, theta {theta}: execution {execution:e}, profile {profile:e} rad");
        assert!(execution < 0.02 && execution < profile + 2e-3, "theta {theta}: {execution} rad, profile {profile}");
    }
    let synthetic = PickAndPlace::default().dataset(0);
    let skill = learned(&synthetic);
    assert!(skill.orientation.as_ref().unwrap().path.is_none());
    let q = synthetic.demonstrations[0].trajectory.orientations().unwrap();
    let asked = ExecutionSettings { theta_m: vec![("block_height_m".to_owned(), 0.2)], ..Default::default() };
    let [execution, profile] = errors(&skill, &asked, |u| q[(u * (q.len() - 1) as f64).round() as usize]);
    println!("pick and place: execution {execution:e}, profile {profile:e} rad");
    assert!(execution < 2e-3 && execution < profile + 5e-4, "{execution} rad, profile {profile}");
}

#[test]
fn the_angular_velocity_is_that_of_the_orientation_and_nothing_jumps() {
    let skill = learned(&dataset(tumbling, &[-0.3, 0.0, 0.3]));
    for integrator in [Integrator::ExactHold, Integrator::RungeKutta4] {
        let mut execution = SkillExecution::new(&skill, &ExecutionSettings { integrator, ..at(0.2) }).unwrap();
        let dt = 1e-4;
        let mut last = execution.state().clone();
        for i in 0..130_000 {
            let rate = if i % 20_000 < 4000 { 0.5 } else { 1.0 };
            let now = execution.step(&StepInput { phase_rate: rate, ..StepInput::of(dt) }).clone();
            let turned = log_map(&cpdmp::math::same_hemisphere(
                &(now.orientation.unwrap() * last.orientation.unwrap().inverse()),
                &UnitQuaternion::identity(),
            )) / dt;
            let mean = (now.angular_velocity.unwrap() + last.angular_velocity.unwrap()) * 0.5;
            // At a change of rate the mean of before and after is not that of the step.
            if i % 20_000 != 0 && i % 20_000 != 4000 {
                assert!((turned - mean).norm() < 1e-4, "step {i}: {turned} but {mean}");
            }
            last = now;
        }
        assert!(last.angular_velocity.unwrap().norm() < 1e-6 && last.u > 1.0);
    }
}

#[test]
fn new_starts_and_goals_are_met_from_any_side() {
    let skill = learned(&dataset(|u, theta| exp_map(&(Vector3::new(theta, 0.3, 0.0) * minimum_jerk(u).position)), &[-0.3, 0.0, 0.3]));
    for axis in [Vector3::x(), Vector3::z(), Vector3::new(1.0, 1.0, -1.0).normalize()] {
        for angle in [0.5, 3.0, PI, 3.3, 5.0, 9.0] {
            let [start, goal] = [exp_map(&(axis * -0.4)), exp_map(&(axis * angle))];
            let asked = ExecutionSettings { start_orientation: Some(start), goal_orientation: Some(goal), ..at(0.1) };
            let mut execution = SkillExecution::new(&skill, &asked).unwrap();
            assert!(execution.state().orientation.unwrap().angle_to(&start) < 1e-7);
            let mut last = start;
            for _ in 0..1300 {
                let q = execution.step(&StepInput::of(0.01)).orientation.unwrap();
                assert!(q.angle_to(&last) < 0.05, "no jump");
                last = q;
            }
            assert!(last.angle_to(&goal) < 1e-4, "{axis} {angle}: {} rad off", last.angle_to(&goal));
        }
    }
}

#[test]
fn a_goal_that_keeps_turning_is_followed_past_many_turns_without_a_lag_and_reached_when_it_stops() {
    let skill = learned(&dataset(|u, theta| exp_map(&(Vector3::new(theta, 0.3, 0.0) * minimum_jerk(u).position)), &[-0.3, 0.0, 0.3]));
    let mut execution = SkillExecution::new(&skill, &at(0.0)).unwrap();
    (0..400).for_each(|_| _ = execution.step(&StepInput::of(0.01)));
    let goal = execution.goal_orientation().unwrap();
    // About the axis of the goal itself, so that the chart has no singularity on the way.
    let turning = goal.axis().unwrap().into_inner() * 0.8;
    assert!(execution.set_goal_orientation(goal, turning));
    let (omega, mut last) = (execution.omega(), execution.state().orientation.unwrap());
    for i in 0..2500 {
        let state = execution.step(&StepInput::of(0.01));
        let (q, velocity) = (state.orientation.unwrap(), state.angular_velocity.unwrap());
        assert!(q.angle_to(&last) < 0.05, "no jump at step {i}");
        last = q;
        if i > 1500 {
            assert!(q.angle_to(&execution.goal_orientation().unwrap()) < 1e-5, "lags at step {i}");
            // Forcing that is held leaves a ripple of (omega dt)^2 / 12 of the velocity.
            let ripple = 0.8 * (omega * 0.01).powi(2) / 12.0;
            assert!((velocity - turning).norm() < 1.1 * ripple, "{} at step {i}", (velocity - turning).norm());
        }
    }
    let stopped = execution.goal_orientation().unwrap();
    assert!(execution.set_goal_orientation(stopped, Vector3::zeros()));
    (0..600).for_each(|_| _ = execution.step(&StepInput::of(0.01)));
    assert!(execution.state().orientation.unwrap().angle_to(&stopped) < 1e-6);
    assert!(!execution.set_goal_orientation(stopped, Vector3::new(f64::NAN, 0.0, 0.0)));
}

#[test]
fn a_measured_orientation_is_where_it_goes_on() {
    let skill = learned(&dataset(tumbling, &[-0.3, 0.0, 0.3]));
    let mut execution = SkillExecution::new(&skill, &at(0.0)).unwrap();
    (0..500).for_each(|_| _ = execution.step(&StepInput::of(0.01)));
    let state = execution.state().clone();
    let held = state.orientation.unwrap() * exp_map(&Vector3::new(0.4, 0.0, 0.2));
    let velocity = Vector3::new(0.3, -0.2, 0.1);
    let (position, speed) = (state.position.as_slice(), state.velocity.as_slice());
    let measured = Some(Measured { position, velocity: speed, orientation: Some((held, velocity)) });
    let now = execution.step(&StepInput { measured, ..StepInput::of(1e-6) });
    assert!(now.orientation.unwrap().angle_to(&held) < 1e-5);
    assert!((now.angular_velocity.unwrap() - velocity).norm() < 1e-2, "{}", now.angular_velocity.unwrap());
    (0..900).for_each(|_| _ = execution.step(&StepInput::of(0.01)));
    assert!(execution.state().orientation.unwrap().angle_to(&tumbling(1.0, 0.0)) < 0.02);
}

#[test]
fn files_keep_the_reference_that_moves_and_older_files_have_none() {
    let skill = learned(&dataset(tumbling, &[-0.3, 0.0, 0.3]));
    let text = skill.to_json().unwrap();
    assert!(text.contains("reference_path") && Skill::from_json(&text).unwrap() == skill);
    let refused = |text: &str| match Skill::from_json(text) {
        Err(LearningError::Skill(message)) => message,
        other => panic!("{other:?}"),
    };
    let mut json: serde_json::Value = serde_json::from_str(&text).unwrap();
    json.as_object_mut().unwrap().remove("checksum");
    json["orientation"]["reference_path"].as_array_mut().unwrap().pop();
    assert!(refused(&json.to_string()).contains("orientation.reference_path"));
    let old = learned(&PickAndPlace::default().dataset(0));
    assert!(!old.to_json().unwrap().contains("reference_path"), "as the version before wrote it");
}

#[test]
fn orientations_that_make_no_sense_are_refused() {
    let skill = learned(&dataset(tumbling, &[-0.3, 0.0, 0.3]));
    let broken = UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(f64::NAN, 0.0, 0.0, 0.0));
    let refused = SkillExecution::new(&skill, &ExecutionSettings { goal_orientation: Some(broken), ..at(0.0) }).unwrap_err().to_string();
    assert!(refused.contains("goal orientation"), "{refused}");
    let without = Skill { orientation: None, ..skill };
    let asked = ExecutionSettings { start_orientation: Some(UnitQuaternion::identity()), ..at(0.0) };
    assert!(SkillExecution::new(&without, &asked).unwrap_err().to_string().contains("no orientation"));
}

/// Contract: the orientation sees the parameters through the same features as the position.
#[test]
fn a_turn_that_grows_with_the_square_of_a_parameter_is_learned_with_quadratic_features() {
    let bent = |u: f64, theta: f64| exp_map(&(Vector3::y() * (theta * theta * minimum_jerk(u).position)));
    let data = dataset(bent, &[0.2, 0.4, 0.6, 0.8, 1.0]);
    let error = |features| {
        let settings =
            LearningSettings { motion: PhmmSettings { features, kmeans_starts: 0, ..PhmmSettings::default() }, ..Default::default() };
        let skill = learn(&data, &settings, 0).unwrap().skill;
        assert_eq!(Skill::from_json(&skill.to_json().unwrap()).unwrap(), skill);
        let moved = generate(&skill, &at(0.7), 0.1, 1.0).unwrap();
        moved.orientations().unwrap().last().unwrap().angle_to(&bent(1.0, 0.7))
    };
    let (linear, quadratic) = (error(Features::Linear), error(Features::Quadratic));
    assert!(quadratic < 0.01 && linear > 3.0 * quadratic, "linear {linear} rad, quadratic {quadratic} rad");
}
