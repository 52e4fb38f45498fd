//! How a skill runs on the simulated arm: coupled at its joints, hearing of where the arm is, waiting for who holds it.

use std::path::Path;

use cpdmp::robot::{SerialChain, baxter};
use cpdmp::scenario::{LoadOptions, Scenario, Work};
use cpdmp::simulation::{Experiment, RunOutcome, Silent, StepRecord, run};
use nalgebra::{DVector, Isometry3, Vector3};

use crate::support::goes_on_from_every_snapshot;

/// An arm with perfect senses and no friction that is led once, from one place to another.
const LED: &str = r#"
schema_version = 1
name = "led"

[robot.sensor]
effort_noise_nm = 0.0
effort_bias_nm = 0.0
dry_friction_nm = 0.0
dynamics_model = "full"
filter_cutoff_hz = inf

[teaching]
duration_s = 4.0

[[teaching.waypoint]]
time_s = 0.0
offset_m = [0.6, 0.4, 0.1]

[[teaching.waypoint]]
time_s = 4.0
offset_m = [0.6, 0.15, 0.1]

[learning.motion]
states = 5
kmeans_starts = 0

[learning.force]
states = 3
kmeans_starts = 0

[execution]
settle_s = 1.0
"#;

/// The run of that scenario with these overrides.
fn led(set: &[&str]) -> RunOutcome {
    led_experiment(set).1
}

/// The same with what was asked for.
fn led_experiment(set: &[&str]) -> (Experiment, RunOutcome) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("led.toml");
    std::fs::write(&path, LED).expect("written");
    let options = LoadOptions { set: set.iter().map(|typed| (*typed).to_owned()).collect(), ..LoadOptions::default() };
    let scenario = Scenario::load(Path::new(&path), &options).unwrap_or_else(|faults| panic!("{faults}"));
    let Work::Arm(experiment) = scenario.work else { panic!("no arm") };
    let outcome = run(&experiment, &Silent).expect("the run ends");
    (*experiment, outcome)
}

fn at(outcome: &RunOutcome, time_s: f64) -> &StepRecord {
    outcome.steps.iter().find(|record| record.time_s >= time_s - 1e-9).expect("a record")
}

/// How far the tool ends from the goal (m).
fn missed(outcome: &RunOutcome) -> f64 {
    (outcome.steps.last().expect("records").tool.translation.vector - outcome.goal).norm()
}

/// `base_from_tool` of the left arm, by its own chain.
fn tool(q: &DVector<f64>) -> Isometry3<f64> {
    let model = baxter().model;
    let chain = SerialChain::new(&model, baxter::BASE_LINK, baxter::LEFT_TOOL).expect("an arm");
    let mut state = chain.state();
    chain.forward_kinematics(q.as_slice(), &mut state);
    state.tip_pose()
}

/// `J^T F` for a force at the tool, from differences of the tool's place (N m).
fn torques(q: &DVector<f64>, force: &Vector3<f64>) -> DVector<f64> {
    let h = 1e-6;
    DVector::from_fn(q.len(), |j, _| {
        let step = DVector::from_fn(q.len(), |i, _| if i == j { h } else { 0.0 });
        let slope = (tool(&(q + &step)).translation.vector - tool(&(q - &step)).translation.vector) / (2.0 * h);
        slope.dot(force)
    })
}

const JOINTS: [&str; 6] = [
    "learning.space=joint",
    "coupling.space=joint",
    "coupling.enabled=true",
    "coupling.mode=minimise_force_error",
    "coupling.compliance_rad_per_nm=[0.01, 0.02, 0.01, 0.03, 0.01, 0.02, 0.01]",
    "coupling.saturation_rad=0.5",
];

/// A push of 10 N while the arm is to stand still: once it is steady every joint is turned by `C_j (J^T (F - F_des))_j`, and the tool goes where
/// such joints put it. The force that is felt is the person's.
#[test]
fn a_push_turns_the_joints_by_the_transposed_jacobian() {
    let still = ["teaching.waypoint.1.offset_m=[0.6, 0.4, 0.1]"];
    for force in [Vector3::new(10.0, 0.0, 0.0), Vector3::new(0.0, -6.0, 8.0)] {
        let push = format!("human.help={{ kind = \"push\", force_n = {:?}, windows_s = [[0.5, 3.9]] }}", force.as_slice());
        let outcome = led(&[&JOINTS[..], &still, &[push.as_str()]].concat());
        let (begun, record) = (at(&outcome, 0.3), at(&outcome, 3.4));
        let felt = record.wrench.fixed_rows::<3>(0).into_owned();
        assert!((felt - force).norm() < 0.3, "the arm feels {felt}, the person pushes {force}");
        let q = DVector::from_column_slice(&record.joint_position);
        let compliance = DVector::from_row_slice(&[0.01, 0.02, 0.01, 0.03, 0.01, 0.02, 0.01]);
        let turned = torques(&q, &(felt - record.expected_force)).component_mul(&compliance);
        let planned = DVector::from_column_slice(&begun.joint_position);
        let expected = tool(&(&planned + turned)).translation.vector - tool(&planned).translation.vector;
        let off = (record.deviation - expected).norm();
        println!(
            "pushed by {:?} N: tool moves {:.1} mm, by the law {:.1} mm",
            force.as_slice(),
            record.deviation.norm() * 1e3,
            expected.norm() * 1e3
        );
        assert!(expected.norm() > 0.02 && off < 0.05 * expected.norm(), "moved by {}, expected {expected}", record.deviation);
        assert!((record.reference.translation.vector - begun.reference.translation.vector - record.deviation).norm() < 2e-3);
        assert!(missed(&outcome) < 0.01, "the goal is kept once the person has gone: {} m", missed(&outcome));
    }
}

#[test]
fn a_movement_of_the_joints_reaches_its_goal_and_is_moved_by_nobody_when_nobody_pushes() {
    let outcome = led(&JOINTS);
    assert_eq!(outcome.skill.motion.columns.len(), 7);
    assert!(missed(&outcome) < 0.005, "{} m from the goal", missed(&outcome));
    let planned = outcome.plan.select(&["x_m", "y_m", "z_m"]).expect("a place");
    let worst = outcome.steps.iter().zip(planned.row_iter()).map(|(record, row)| (record.tool.translation.vector - row.transpose()).norm());
    let worst = worst.fold(0.0, f64::max);
    assert!(worst < 0.02, "the tool leaves the planned path by {worst} m");
    assert!(outcome.steps.iter().all(|record| record.deviation.norm() < 5e-3), "by no more than what the model expects wrongly");
}

/// Contract: a snapshot in the very step in which a run ends changes nothing about when it ends.
#[test]
fn snapshots_do_not_change_when_a_run_ends() {
    let ended = |every: u64| {
        let snapshots = format!("recording.snapshot_every_steps={every}");
        let outcome = led(&["execution.phase_stopping=true", HELD, &snapshots]);
        (outcome.state_hash, outcome.phases.last().expect("an execution").steps)
    };
    let whole = ended(0);
    assert_eq!(ended(whole.1), whole);
}

/// Contract: what a skill in joint space, a measured state, a phase that waits and noisy sensors remember is part of a snapshot.
#[test]
fn runs_of_every_mode_are_taken_up_in_the_same_bits() {
    let noisy = ["robot.sensor.effort_noise_nm=0.05", "robot.sensor.filter_cutoff_hz=5", "recording.snapshot_every_steps=700"];
    let waiting = ["execution.feedback=measured", "execution.feedback_time_s=0.1", "execution.phase_stopping=true", HELD];
    for mode in [&JOINTS[..], &waiting] {
        let (experiment, outcome) = led_experiment(&[&noisy, mode].concat());
        goes_on_from_every_snapshot(&experiment, &outcome, 6);
    }
}

const HELD: &str = "human.help={ kind = \"push\", force_n = [0.0, 0.0, 40.0], windows_s = [[1.0, 3.0]] }";

/// While a person holds the arm off its path the phase waits, and the movement still ends at its goal, later.
#[test]
fn the_phase_waits_while_a_person_holds_the_arm() {
    let feedback = ["execution.feedback=measured", "execution.feedback_time_s=0.1"];
    let waiting = ["execution.phase_stopping=true", "execution.phase_stopping_gain=2000"];
    let free = led(&[]);
    for record in &free.steps {
        assert!((record.time_fraction - (record.time_s / 4.0)).abs() < 1e-3, "nothing makes this phase wait");
    }
    let (blind, drawn) = (led(&[HELD]), led(&[&feedback[..], &[HELD]].concat()));
    assert!(blind.steps.iter().all(|record| record.deviation == Vector3::zeros()), "without feedback nothing is known of the person");
    let held = led(&[&feedback[..], &waiting, &[HELD]].concat());
    let alone = led(&[&feedback[..], &waiting].concat());
    let rate =
        |outcome: &RunOutcome, from: f64, to: f64| (at(outcome, to).time_fraction - at(outcome, from).time_fraction) / (to - from) * 4.0;
    println!(
        "deviation {:.1} mm drawn, {:.1} mm held; rate {:.3} held, {:.3} alone; last record at {:.2} s held, {:.2} s alone",
        at(&drawn, 2.5).deviation.norm() * 1e3,
        at(&held, 2.5).deviation.norm() * 1e3,
        rate(&held, 1.5, 2.9),
        rate(&alone, 1.5, 2.9),
        held.steps.last().expect("records").time_s,
        alone.steps.last().expect("records").time_s
    );
    assert!(at(&drawn, 2.5).deviation.norm() > 0.01, "the plan is drawn to where the arm is held");
    assert!((rate(&drawn, 1.5, 2.9) - 1.0).abs() < 1e-3, "feedback alone makes nothing wait");
    // The law, at every record: the rate is 1 / (1 + gain e^2), not below the slowest.
    for pair in held.steps.windows(2).filter(|pair| pair[1].time_fraction < 1.0) {
        let e2 = 0.5 * (pair[0].deviation.norm_squared() + pair[1].deviation.norm_squared());
        let expected = (1.0 / (1.0 + 2000.0 * e2)).max(0.05);
        let measured = (pair[1].time_fraction - pair[0].time_fraction) * 4.0 / (pair[1].time_s - pair[0].time_s);
        assert!((measured - expected).abs() < 0.05, "rate {measured}, by the law {expected} at {} s", pair[0].time_s);
    }
    assert!(rate(&held, 1.5, 2.9) < 0.7 && rate(&alone, 1.5, 2.9) > 0.95);
    assert!(held.steps.last().expect("records").time_s > alone.steps.last().expect("records").time_s + 0.3, "it takes longer");
    for outcome in [&blind, &drawn, &held, &alone] {
        assert!(missed(outcome) < 0.01, "{} m from the goal", missed(outcome));
    }
}

#[test]
fn both_integrators_lead_the_arm_along_one_path() {
    let [hold, rk4] = ["hold", "rk4"].map(|method| led(&[&format!("execution.integrator={method}")]));
    let apart = hold.steps.iter().zip(&rk4.steps).map(|(a, b)| (a.tool.translation.vector - b.tool.translation.vector).norm());
    let apart = apart.fold(0.0, f64::max);
    assert!(apart > 0.0 && apart < 1e-4, "{apart} m apart");
}
