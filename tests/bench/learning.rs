//! How long learning and executing take: `cargo bench --bench learning`.
//!
//! Limits (issue 3): one step of a skill in three dimensions with 16 states of motion, 10 of force and a coupling, 2 us; learning from nine
//! demonstrations of 28 s at 100 Hz with 12 starts, 3 s on one thread. Time is a property of the machine, so nothing fails on it here; that a
//! step does not allocate is a test, `no_step_of_any_kind_allocates`.

use std::hint::black_box;

use cpdmp::demonstration::synthetic::PickAndPlace;
use cpdmp::learning::cpdmp::{CouplingMode, CouplingSettings};
use cpdmp::learning::dmp::{Integrator, Motion, TransformationSystem};
use cpdmp::learning::phmm::PhmmSettings;
use cpdmp::learning::{ExecutionSettings, LearningSettings, Skill, SkillExecution, StepInput, learn};
use divan::Bencher;
use nalgebra::DVector;

fn main() {
    divan::main();
}

/// 16 states of motion and 10 of force, as quickly learned as they come: a step takes as long whatever they say.
fn skill() -> Skill {
    let quick = |states| PhmmSettings { states, kmeans_starts: 0, ..PhmmSettings::default() };
    let settings = LearningSettings { rate_hz: 10.0, motion: quick(16), force: quick(10), ..LearningSettings::default() };
    learn(&PickAndPlace::default().dataset(0), &settings, 0).expect("the synthetic task can be learned").skill
}

/// One step at 1 kHz with forces that act all along, from start to beyond the goal, again and again.
fn steps(bencher: Bencher, skill: &Skill, integrator: Integrator, with_coupling: bool) {
    let coupling = CouplingSettings { enabled: with_coupling, mode: CouplingMode::MinimiseForceError, ..CouplingSettings::default() };
    let theta_m = vec![("block_height_m".to_owned(), 0.235)];
    let asked = ExecutionSettings { theta_m, coupling, integrator, ..ExecutionSettings::default() };
    let start = SkillExecution::new(skill, &asked).expect("a fitting request");
    let mut execution = start.clone();
    bencher.bench_local(|| {
        if execution.state().u > 1.1 {
            execution.clone_from(&start);
        }
        black_box(execution.step(&StepInput { wrench: black_box(&[0.5, -1.0, 2.0]), ..StepInput::of(0.001) }).position[0])
    });
}

#[divan::bench(args = [Integrator::ExactHold, Integrator::RungeKutta4], sample_size = 1000)]
fn step_in_space_coupled(bencher: Bencher, integrator: Integrator) {
    steps(bencher, &Skill { orientation: None, ..skill() }, integrator, true);
}

#[divan::bench(args = [Integrator::ExactHold, Integrator::RungeKutta4], sample_size = 1000)]
fn step_in_space_coupled_with_orientation_and_gripper(bencher: Bencher, integrator: Integrator) {
    steps(bencher, &skill(), integrator, true);
}

#[divan::bench(sample_size = 1000)]
fn step_of_the_movement_alone(bencher: Bencher) {
    steps(bencher, &Skill { orientation: None, force: None, gripper: None, ..skill() }, Integrator::ExactHold, false);
}

#[divan::bench(sample_size = 1000)]
fn gmr_query_of_16_states(bencher: Bencher) {
    let mut shaping = skill().motion.shaping_at(&DVector::from_element(1, 0.235)).expect("a fitting model");
    let (mut f, mut u) = ([0.0; 3], 0.0);
    bencher.bench_local(|| {
        u = (u + 0.001) % 1.0;
        shaping.forcing(black_box(u), &mut f);
        black_box(f[0])
    });
}

#[divan::bench(sample_size = 1000)]
fn spring_held_exactly(bencher: Bencher) {
    let (system, mut motion) = (TransformationSystem::new(5000.0, 28.0), Motion::default());
    bencher.bench_local(|| {
        motion = system.hold(motion, black_box(1.0), 0.001);
        black_box(motion.position)
    });
}

/// Nine demonstrations of 28 s with 12 starts, on one thread; samples of 25 and of 100 Hz.
#[divan::bench(args = [25.0, 100.0], sample_count = 3, sample_size = 1)]
fn learn_nine_demonstrations(bencher: Bencher, rate_hz: f64) {
    let starts = |settings: PhmmSettings| PhmmSettings { kmeans_starts: 10, ..settings };
    let defaults = LearningSettings::default();
    let settings = LearningSettings { rate_hz, motion: starts(defaults.motion), force: starts(defaults.force), ..defaults };
    let dataset = PickAndPlace::default().dataset(0);
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread");
    bencher.bench_local(|| one.install(|| learn(&dataset, &settings, 0).expect("the synthetic task can be learned")));
}
