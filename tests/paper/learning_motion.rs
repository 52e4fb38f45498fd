//! A skill moves as its differential equation says: at the integrator's order, to goals that change, and on from where the robot really is.

use std::sync::OnceLock;

use cpdmp::demonstration::synthetic::PickAndPlace;
use cpdmp::learning::cpdmp::{CouplingSettings, Switching};
use cpdmp::learning::dmp::{Integrator, Motion, TransformationSystem};
use cpdmp::learning::{ExecutionSettings, LearningSettings, Measured, PhaseStopping, Skill, SkillExecution, StepInput, generate, learn};
use nalgebra::{DVector, UnitQuaternion, Vector3};

fn skill() -> &'static Skill {
    static SKILL: OnceLock<Skill> = OnceLock::new();
    SKILL.get_or_init(|| learn(&PickAndPlace::default().dataset(0), &LearningSettings::default(), 0).unwrap().skill)
}

fn settings() -> ExecutionSettings {
    ExecutionSettings { theta_m: vec![("block_height_m".to_owned(), 0.235)], ..Default::default() }
}

fn execution() -> SkillExecution {
    SkillExecution::new(skill(), &settings()).unwrap()
}

/// Positions of (16) without force at `samples` moments up to `until` (time fraction), by many small Runge-Kutta steps of its own.
fn reference(until: f64, samples: usize) -> Vec<DVector<f64>> {
    const SMALL: usize = 64;
    let theta = DVector::from_element(1, 0.235);
    let mut shaping = skill().motion.shaping_at(&theta).unwrap();
    let (start, goal) = skill().ends_at(&theta);
    let (tau, system) = (skill().motion.duration_s, TransformationSystem::new(5000.0, skill().motion.duration_s));
    let du = until / (samples * SMALL) as f64;
    let mut x: Vec<Motion> = start.iter().map(|x| Motion { position: *x, velocity: 0.0 }).collect();
    let mut path = Vec::new();
    for i in 0..samples * SMALL {
        let mut net = [[0.0; 3]; 3];
        for (part, net) in [0.0, 0.5, 1.0].iter().zip(&mut net) {
            shaping.net_forcing((i as f64 + part) * du, &start, &goal, net);
        }
        for j in 0..3 {
            x[j] = system.runge_kutta(x[j], net.map(|net| goal[j] + net[j]), du * tau);
        }
        if (i + 1) % SMALL == 0 {
            path.push(DVector::from_iterator(3, x.iter().map(|m| m.position)));
        }
    }
    path
}

#[test]
fn a_whole_execution_converges_at_the_order_of_its_integrator() {
    const COARSE: usize = 400;
    let until = 0.92;
    let truth = reference(until, COARSE);
    for (integrator, order) in [(Integrator::ExactHold, 2.0), (Integrator::RungeKutta4, 4.0)] {
        let error = |finer: usize| {
            let mut execution = SkillExecution::new(skill(), &ExecutionSettings { integrator, ..settings() }).unwrap();
            let dt = until * execution.duration_s() / (COARSE * finer) as f64;
            let mut worst = 0.0f64;
            for x in &truth {
                (0..finer).for_each(|_| _ = execution.step(&StepInput::of(dt)));
                worst = worst.max((&execution.state().position - x).norm());
            }
            worst
        };
        let [a, b, c] = [2, 4, 8].map(error);
        let measured = [(a / b).log2(), (b / c).log2()];
        println!("{integrator:?}: errors {a:e}, {b:e}, {c:e} m, order {measured:?}");
        assert!(measured.iter().all(|m| (m - order).abs() < 0.25), "{integrator:?}: order {measured:?}, errors {a}, {b}, {c}");
    }
}

#[test]
fn steps_that_would_be_unstable_for_runge_kutta_are_held_exactly() {
    let mut execution = SkillExecution::new(skill(), &ExecutionSettings { integrator: Integrator::RungeKutta4, ..settings() }).unwrap();
    for _ in 0..40 {
        assert!(execution.step(&StepInput::of(20.0)).position.iter().all(|x| x.abs() < 2.0));
    }
    assert!((&execution.state().position - execution.goal()).norm() < 1e-9);
}

#[test]
fn a_new_goal_jumps_the_acceleration_by_equation_1_and_nothing_else() {
    for at in [0.0, 0.3, 0.6, 0.97, 1.2] {
        let mut moved = execution();
        let steps = (at * 2800.0) as usize;
        (0..steps).for_each(|_| _ = moved.step(&StepInput::of(0.01)));
        let mut kept = moved.clone();
        let goal: Vec<f64> = moved.goal().iter().zip([0.1, -0.2, 0.05]).map(|(g, d)| g + d).collect();
        assert!(moved.set_goal(&goal, &[0.0; 3]));
        let h = 1e-7;
        let (a, b) = (moved.step(&StepInput::of(h)).clone(), kept.step(&StepInput::of(h)).clone());
        assert!((&a.position - &b.position).norm() < 1e-12 && (&a.velocity - &b.velocity).norm() < 1e-6, "continuous at {at}");
        let gate = if at < 0.94 { 1.0 } else { cpdmp::math::smooth_step(b.u, 1.0, 0.94) };
        let jump = &a.acceleration - &b.acceleration;
        let expected = DVector::from_vec(vec![0.1, -0.2, 0.05]) * (moved.omega().powi(2) * (1.0 - gate * b.phase));
        assert!((jump - expected).norm() < 1e-6, "at {at}");
        (0..4200).for_each(|_| _ = moved.step(&StepInput::of(0.01)));
        assert!((&moved.state().position - DVector::from_vec(goal)).norm() < 1e-4, "reached from {at}");
    }
}

#[test]
fn a_moving_goal_is_followed_without_a_lag_and_reached_when_it_stops() {
    for integrator in [Integrator::ExactHold, Integrator::RungeKutta4] {
        let mut execution = SkillExecution::new(skill(), &ExecutionSettings { integrator, ..settings() }).unwrap();
        (0..1000).for_each(|_| _ = execution.step(&StepInput::of(0.01)));
        let velocity = [0.03, -0.02, 0.01];
        let (from, g) = (execution.state().time_s, execution.goal().clone());
        assert!(execution.set_goal(g.as_slice(), &velocity));
        (0..3500).for_each(|_| _ = execution.step(&StepInput::of(0.01)));
        let goal = &g + DVector::from_row_slice(&velocity) * (execution.state().time_s - from);
        assert!((execution.goal() - &goal).norm() < 1e-9);
        assert!((&execution.state().position - &goal).norm() < 1e-6, "lag {}", (&execution.state().position - &goal).norm());
        // Forcing that is held leaves a ripple of (omega dt)^2 / 12 of the velocity.
        let ripple = if integrator == Integrator::ExactHold { (execution.omega() * 0.01).powi(2) / 12.0 } else { 0.0 };
        let off = (&execution.state().velocity - DVector::from_row_slice(&velocity)).norm();
        assert!(off < 0.0375 * ripple * 1.1 + 1e-8, "{integrator:?}: velocity off by {off}");
        execution.set_goal(goal.as_slice(), &[0.0; 3]);
        (0..1500).for_each(|_| _ = execution.step(&StepInput::of(0.01)));
        assert!((&execution.state().position - &goal).norm() < 1e-9);
    }
    let mut execution = execution();
    let before = execution.clone().step(&StepInput::of(0.01)).clone();
    assert!(!execution.set_goal(&[0.0; 2], &[0.0; 3]) && !execution.set_goal(&[f64::NAN; 3], &[0.0; 3]));
    assert!(*execution.step(&StepInput::of(0.01)) == before);
}

/// Held off its path while its goal moves: the phase waits, the goal is followed all the same, and reached when it stops.
#[test]
fn a_goal_that_moves_while_the_phase_waits_is_reached_by_both_integrators() {
    for integrator in [Integrator::ExactHold, Integrator::RungeKutta4] {
        let phase_stopping = Some(PhaseStopping { gain: 1e3, slowest: 0.2 });
        let mut execution = SkillExecution::new(skill(), &ExecutionSettings { integrator, phase_stopping, ..settings() }).unwrap();
        (0..800).for_each(|_| _ = execution.step(&StepInput::of(0.01)));
        let (velocity, g) = ([0.02, -0.01, 0.005], execution.goal().clone());
        assert!(execution.set_goal(g.as_slice(), &velocity));
        let (from, u) = (execution.state().time_s, execution.state().u);
        let place = execution.state().position.clone() + DVector::from_element(3, 0.2);
        for _ in 0..500 {
            let measured = Some(Measured { position: place.as_slice(), velocity: &[0.0; 3], orientation: None });
            execution.step(&StepInput { measured, ..StepInput::of(0.01) });
        }
        let rate = (execution.state().u - u) * execution.duration_s() / 5.0;
        assert!((rate - 0.2).abs() < 1e-3, "{integrator:?}: waits at {rate}");
        (0..3500).for_each(|_| _ = execution.step(&StepInput::of(0.01)));
        let goal = &g + DVector::from_row_slice(&velocity) * (execution.state().time_s - from);
        assert!((execution.goal() - &goal).norm() < 1e-9, "the goal moves in real time");
        assert!((&execution.state().position - &goal).norm() < 1e-5, "{integrator:?}: {}", (&execution.state().position - &goal).norm());
        execution.set_goal(goal.as_slice(), &[0.0; 3]);
        (0..1500).for_each(|_| _ = execution.step(&StepInput::of(0.01)));
        assert!((&execution.state().position - &goal).norm() < 1e-9);
    }
}

/// Other formulations scale the forcing by `g - x0` and blow up where it is small.
#[test]
fn a_movement_that_ends_where_it_starts_keeps_its_shape() {
    let as_taught = generate(skill(), &settings(), 0.05, 1.2).unwrap();
    let theta = DVector::from_element(1, 0.235);
    let (start, goal) = skill().ends_at(&theta);
    for columns in [vec![0], vec![0, 1, 2]] {
        let mut ends = start.clone();
        (0..3).filter(|j| !columns.contains(j)).for_each(|j| ends[j] = goal[j]);
        let asked = ExecutionSettings { goal: Some(ends.iter().copied().collect()), ..settings() };
        let closed = generate(skill(), &asked, 0.05, 1.2).unwrap();
        let last = closed.values().nrows() - 1;
        for j in 0..3 {
            assert!((closed.values()[(last, j)] - ends[j]).abs() < 1e-4);
            let farthest = (0..=last).map(|t| (closed.values()[(t, j)] - as_taught.values()[(t, j)]).abs()).fold(0.0, f64::max);
            assert!(farthest <= (goal[j] - ends[j]).abs() * 1.001 + 1e-9, "column {j} is bent by {farthest} m");
        }
    }
}

/// `learning-peers.md` 3.1: held at 0.2 for 0.3 s, a peer's first output after release is 0.996, the undisturbed path.
#[test]
fn after_being_held_the_movement_goes_on_from_where_it_was_held() {
    let mut held = execution();
    (0..1000).for_each(|_| _ = held.step(&StepInput::of(0.01)));
    let place = DVector::from_vec(vec![0.2, 0.2, 0.2]);
    for _ in 0..30 {
        let measured = Some(Measured { position: place.as_slice(), velocity: &[0.0; 3], orientation: None });
        let state = held.step(&StepInput { measured, ..StepInput::of(0.01) });
        assert!(state.measured_used);
        let pulled = 0.5 * (held.omega() * 0.01).powi(2) * 2.0;
        assert!((&held.state().position - &place).norm() < pulled, "the output stays beside the robot");
    }
    // From the measured state on it is (16), as one spring.
    let theta = DVector::from_element(1, 0.235);
    let mut shaping = skill().motion.shaping_at(&theta).unwrap();
    let (start, goal) = skill().ends_at(&theta);
    let system = TransformationSystem::new(5000.0, held.duration_s());
    let state = held.state().clone();
    let mut x: Vec<Motion> = (0..3).map(|j| Motion { position: state.position[j], velocity: state.velocity[j] }).collect();
    for i in 0..1000 {
        let mut net = [[0.0; 3]; 3];
        for (part, net) in [0.0, 0.5, 1.0].iter().zip(&mut net) {
            shaping.net_forcing(state.u + (f64::from(i) + part) * 0.01 / held.duration_s(), &start, &goal, net);
        }
        let now = held.step(&StepInput::of(0.01));
        for j in 0..3 {
            x[j] = system.runge_kutta(x[j], net.map(|net| goal[j] + net[j]), 0.01);
            assert!((x[j].position - now.position[j]).abs() < 1e-5, "step {i}, axis {j}");
        }
    }
    let twice = held.clone().step(&StepInput::of(0.01)).clone();
    for (position, velocity) in [(&[0.0; 2][..], &[0.0; 3][..]), (&[f64::NAN; 3], &[0.0; 3]), (&[0.0; 3], &[f64::INFINITY; 3])] {
        let measured = Some(Measured { position, velocity, orientation: None });
        let mut other = held.clone();
        let state = other.step(&StepInput { measured, ..StepInput::of(0.01) });
        assert!(!state.measured_used && state.position == twice.position);
    }
}

#[test]
fn the_phase_waits_for_a_robot_that_is_held_and_the_goal_is_still_reached() {
    let phase_stopping = Some(PhaseStopping { gain: 1e4, slowest: 0.05 });
    let mut waiting = SkillExecution::new(skill(), &ExecutionSettings { phase_stopping, ..settings() }).unwrap();
    let mut blind = execution();
    for _ in 0..500 {
        assert!(waiting.step(&StepInput::of(0.01)) == blind.step(&StepInput::of(0.01)), "on the path nothing waits, bit for bit");
    }
    let (u, place) = (waiting.state().u, waiting.state().position.clone() + DVector::from_element(3, 0.3));
    for _ in 0..1000 {
        let measured = Some(Measured { position: place.as_slice(), velocity: &[0.0; 3], orientation: None });
        waiting.step(&StepInput { measured, ..StepInput::of(0.01) });
    }
    let rate = (waiting.state().u - u) * waiting.duration_s() / 10.0;
    assert!((rate - 0.05).abs() < 1e-3, "at the slowest rate, not {rate}");
    (0..3500).for_each(|_| _ = waiting.step(&StepInput::of(0.01)));
    assert!((&waiting.state().position - waiting.goal()).norm() < 1e-4);
    let refused =
        SkillExecution::new(skill(), &ExecutionSettings { phase_stopping: Some(PhaseStopping { gain: -1.0, slowest: 0.0 }), ..settings() });
    let message = refused.unwrap_err().to_string();
    assert!(message.contains("phase_stopping.gain") && message.contains("phase_stopping.slowest"));
}

#[test]
fn no_step_of_any_kind_allocates() {
    let coupling = CouplingSettings { enabled: true, switching: Switching::Smooth(1.0), ..Default::default() };
    for integrator in [Integrator::ExactHold, Integrator::RungeKutta4] {
        let phase_stopping = Some(PhaseStopping { gain: 1.0, slowest: 0.1 });
        let asked = ExecutionSettings { integrator, phase_stopping, coupling: coupling.clone(), ..settings() };
        let mut execution = SkillExecution::new(skill(), &asked).unwrap();
        assert!(execution.state().orientation.is_some() && execution.state().gripper.is_some());
        let goal = execution.goal().clone();
        let counted = allocation_counter::measure(|| {
            for i in 0..3000 {
                let position = [0.5 + 1e-5 * f64::from(i), 0.1, 0.2];
                let orientation = (i % 7 == 0).then(|| (UnitQuaternion::identity(), Vector3::new(0.0, 0.1, 0.0)));
                let measured = (i % 5 == 0).then_some(Measured { position: &position, velocity: &[0.0; 3], orientation });
                execution.step(&StepInput { wrench: &[1.0, 2.0, f64::from(i % 9)], measured, ..StepInput::of(0.01) });
                if i % 100 == 0 {
                    execution.set_goal(goal.as_slice(), &[0.01, 0.0, 0.0]);
                    execution.set_goal_orientation(UnitQuaternion::identity(), Vector3::new(0.2, 0.0, 0.0));
                }
            }
        });
        assert_eq!((counted.count_total, counted.bytes_total), (0, 0), "{integrator:?}");
        assert!(execution.state().u > 0.5);
    }
    let one = allocation_counter::measure(|| drop(std::hint::black_box(vec![0u8; 10])));
    assert_eq!(one.count_total, 1, "the counter counts");
}
