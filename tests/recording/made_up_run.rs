//! A short run that was never simulated: every number is known, and everything that can happen happens once.

use std::sync::LazyLock;

use cpdmp::demonstration::synthetic::PickAndPlace;
use cpdmp::learning::phmm::PhmmSettings;
use cpdmp::learning::{ExecutionSettings, LearningSettings, ShapingKind, generate, learn};
use cpdmp::simulation::{AppliedForce, FinalObject, LessonLook, LessonRecord, RunOutcome, Snapshots, StepRecord};
use cpdmp::world::{Clearance, Parameters};
use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3, Vector6};

use crate::support::baxter;

/// Steps of the run.
pub const STEPS: usize = 120;

/// The steps between which the arm complies, the person holds it, and the gripper is closed.
pub const COMPLIES: std::ops::Range<usize> = 40..80;
/// See [`COMPLIES`].
pub const HOLDS: std::ops::Range<usize> = 45..70;
/// See [`COMPLIES`].
pub const CLOSED: std::ops::Range<usize> = 60..110;

/// The outcome of the made-up run.
pub fn outcome() -> RunOutcome {
    static OUTCOME: LazyLock<RunOutcome> = LazyLock::new(|| learned(ShapingKind::Phmm));
    OUTCOME.clone()
}

/// The same with a skill that has no states.
pub fn outcome_of_the_baseline() -> RunOutcome {
    learned(ShapingKind::Lwr)
}

/// How its skill was learned.
pub fn learning_settings() -> LearningSettings {
    let small = PhmmSettings { states: 5, kmeans_starts: 0, max_iterations: 5, ..PhmmSettings::default() };
    LearningSettings { motion: small.clone(), force: small, ..LearningSettings::default() }
}

/// What the skill was asked.
pub fn question() -> ExecutionSettings {
    ExecutionSettings { theta_m: vec![("block_height_m".into(), 0.235)], ..ExecutionSettings::default() }
}

fn learned(shaping: ShapingKind) -> RunOutcome {
    let dataset = PickAndPlace { duration_s: 6.0, rate_hz: 50.0, toy_offsets_m: vec![-0.06, 0.06], ..PickAndPlace::default() }.dataset(1);
    let settings = LearningSettings { shaping, ..learning_settings() };
    let learned = learn(&dataset, &settings, 1).expect("the synthetic demonstrations can be learned from");
    let plan = generate(&learned.skill, &question(), 0.05, 1.0).expect("the skill can be asked");
    let robot = baxter();
    let names = ["table", "block_1", "block_2", "toy", "basket"];
    let objects = names.map(|name| FinalObject { name: name.into(), position: Point3::origin(), speed_m_per_s: 0.0 });
    let clearance = Clearance {
        a: "left_hand".into(),
        b: "block_1".into(),
        min_distance_m: 0.02,
        time_s: 1.0,
        point_a: Point3::origin(),
        point_b: Point3::new(0.02, 0.0, 0.0),
    };
    RunOutcome {
        steps: (0..STEPS).map(|i| record(i, robot.bodies.len(), names.len())).collect(),
        lessons: vec![lesson(robot.bodies.len(), names.len()); 2],
        robot,
        robot_warnings: Vec::new(),
        dataset,
        skill: learned.skill,
        learning: learned.report,
        plan,
        human_peak_force_n: 15.0,
        tool_peak_force_n: 0.0,
        goal: nalgebra::Vector3::zeros(),
        collisions: Vec::new(),
        clearances: vec![clearance],
        phases: Vec::new(),
        state_hash: 0x1234,
        traces: Vec::new(),
        snapshots: Snapshots::new(),
        final_objects: objects.to_vec(),
        beside: Vec::new(),
    }
}

/// A lesson of a second in which everything moves.
fn lesson(bodies: usize, objects: usize) -> LessonRecord {
    let look = |i: usize| {
        let record = record(i, bodies, objects);
        LessonLook {
            time_s: 0.1 * i as f64,
            tool: record.tool.translation.vector,
            gripper_command: record.gripper_command,
            human: AppliedForce { point: Point3::origin(), force: Vector3::new(3.0, 0.0, i as f64) },
            bodies: record.bodies,
            objects: record.objects,
        }
    };
    LessonRecord {
        astray: None,
        name: "made_up".into(),
        parameters: Parameters(vec![("block_height_m".into(), 0.2)]),
        looks: (0..10).map(look).collect(),
    }
}

/// Numbers that no rounding leaves as they are, all different.
fn record(i: usize, bodies: usize, objects: usize) -> StepRecord {
    let a = (i as f64 * 0.37).sin() / 3.0;
    let vector = |k: f64| Vector3::new(a + k, a * k - 0.1, 1.0 / (3.0 + k + i as f64));
    let pose = |k: f64| Isometry3::from_parts(vector(k).into(), UnitQuaternion::from_scaled_axis(vector(k + 1.0)));
    StepRecord {
        step: 50 * i as u64,
        time_s: 0.05 * i as f64,
        joint_position: (0..7).map(|j| a + j as f64).collect(),
        joint_velocity: (0..7).map(|j| a * j as f64).collect(),
        deviation: nalgebra::Vector3::zeros(),
        joint_effort: (0..7).map(|j| a - j as f64).collect(),
        tool: pose(0.3),
        reference: pose(0.4),
        wrench: Vector6::new(a, 2.0 * a, 3.0 * a, 4.0 * a, 5.0 * a, 6.0 * a),
        expected_force: vector(7.0),
        coupling_displacement: vector(8.0) * 1e-2,
        phase: (-4.6 * i as f64 / STEPS as f64).exp(),
        time_fraction: i as f64 / 110.0,
        state: 5 * i / STEPS,
        beta: if COMPLIES.contains(&i) { -1.0 } else { 0.0 },
        activation: if COMPLIES.contains(&i) { 0.9 } else { 0.0 },
        gripper_command: if CLOSED.contains(&i) { 0.0 } else { 1.0 },
        gripper_opening: if CLOSED.contains(&i) { 0.21 } else { 0.98 },
        tool_force: Vector3::zeros(),
        tool_impulse: Vector3::zeros(),
        human: if HOLDS.contains(&i) {
            AppliedForce { point: Point3::from(vector(9.0)), force: vector(10.0) }
        } else {
            AppliedForce::default()
        },
        bodies: (0..bodies).map(|body| if body == 0 { Isometry3::identity() } else { pose(body as f64) }).collect(),
        objects: (0..objects).map(|object| if object == 3 { pose(0.6) } else { Isometry3::identity() }).collect(),
        touches: Vec::new(),
        kinetic_energy_j: a * a,
    }
}
