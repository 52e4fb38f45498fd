//! Section 4.3: a door opened with a hook at handles that were never used.
//!
//! The lessons of the shipped scenario are taught once and shared; every execution is a simulation of its own. All figures are those of the
//! simulated world.

use std::path::Path;
use std::sync::OnceLock;

use cpdmp::check::{Criterion, judge};
use cpdmp::demonstration::Dataset;
use cpdmp::learning::{self, Learned};
use cpdmp::scenario::{LoadOptions, Scenario, Work};
use cpdmp::simulation::{DemonstrationSource, Experiment, History, RunOutcome, Setup, Silent, SimulationError, demonstrate, perform};
use cpdmp::world::{Cabinet, Grip, ObjectKind, Parameters, door_turn, opening_rad};
use nalgebra::{Isometry3, Vector2};

use crate::support::{faultless_sensors, goes_on_from_every_snapshot};

/// Places of the handles along y, and of the places between and beyond them that were never shown (m).
pub(super) const HANDLE_3_M: f64 = 0.35;
const BETWEEN_M: [f64; 4] = [0.425, 0.375, 0.325, 0.275];
const BEYOND_M: [f64; 2] = [0.475, 0.225];

/// 55 and 50 degrees (rad).
const WIDE_RAD: f64 = 0.9599;
const OPEN_RAD: f64 = 0.8727;

pub(super) fn scenario_with(name: &str, set: &[&str]) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(name);
    let options = LoadOptions { set: set.iter().map(ToString::to_string).collect(), ..LoadOptions::default() };
    Scenario::load(&path, &options).unwrap_or_else(|faults| panic!("{faults}"))
}

pub(super) fn arm(scenario: &Scenario) -> &Experiment {
    let Work::Arm(experiment) = &scenario.work else { panic!("no arm") };
    experiment
}

/// The lessons of a scenario and what is learned from them.
pub(super) fn lessons(scenario: &Scenario) -> (Dataset, Learned) {
    let setup = Setup::new(arm(scenario)).expect("the robot loads");
    setup.preflight(&Silent).expect("the lessons can be led");
    let (dataset, _) = demonstrate(&setup, &Silent).expect("demonstrations");
    let learned = learning::learn(&dataset, &arm(scenario).learning, arm(scenario).seed).expect("a skill");
    (dataset, learned)
}

/// The shipped lessons.
pub(super) fn taught() -> &'static (Dataset, Learned) {
    static TAUGHT: OnceLock<(Dataset, Learned)> = OnceLock::new();
    TAUGHT.get_or_init(|| lessons(&scenario_with("cabinet_door.toml", &[])))
}

/// The shipped lessons without a clamp.
fn taught_by_contact() -> &'static (Dataset, Learned) {
    static TAUGHT: OnceLock<(Dataset, Learned)> = OnceLock::new();
    TAUGHT.get_or_init(|| lessons(&scenario_with("cabinet_door_contact_hook.toml", &[])))
}

/// One execution of a skill at the handle at `handle_y_m`, changed by `change`.
pub(super) fn executed(
    scenario: &Scenario,
    lessons: &(Dataset, Learned),
    handle_y_m: f64,
    change: impl FnOnce(&mut Experiment),
) -> (Experiment, RunOutcome, Vec<Criterion>) {
    tried(scenario, lessons, handle_y_m, change).expect("the execution ends")
}

/// The same, of a skill that may start inside a bar.
pub(super) fn tried(
    scenario: &Scenario,
    (dataset, learned): &(Dataset, Learned),
    handle_y_m: f64,
    change: impl FnOnce(&mut Experiment),
) -> Result<(Experiment, RunOutcome, Vec<Criterion>), SimulationError> {
    let mut experiment = arm(scenario).clone();
    experiment.parameters = experiment.parameters.with(&[("handle_y_m".into(), handle_y_m)]);
    change(&mut experiment);
    let setup = Setup::new(&experiment).expect("the robot loads");
    let outcome = perform(&setup, dataset, learned, History::default(), &Silent)?;
    let criteria = judge(&outcome, &experiment, &scenario.criteria);
    Ok((experiment, outcome, criteria))
}

pub(super) fn value(criteria: &[Criterion], name: &str) -> f64 {
    criteria.iter().find(|c| c.name == name).unwrap_or_else(|| panic!("no criterion {name}")).value
}

fn row(what: &str, criteria: &[Criterion]) -> String {
    format!(
        "{what}: opened {:.1} deg, plan {:.2} mm and tool {:.2} mm rms off the arc, at most {:.1} N, bar at most {:.1} mm off",
        value(criteria, "door_open").to_degrees(),
        value(criteria, "plan_on_the_arc") * 1e3,
        value(criteria, "arc_followed") * 1e3,
        value(criteria, "hook_force"),
        value(criteria, "hook_kept") * 1e3
    )
}

/// The cabinet of an experiment and the place of its hinge (m).
pub(super) fn cabinet(experiment: &Experiment) -> (&Cabinet, Vector2<f64>) {
    let object = experiment.objects.iter().find(|o| matches!(o.kind, ObjectKind::Cabinet(_))).expect("a cabinet");
    let ObjectKind::Cabinet(cabinet) = &object.kind else { panic!("no cabinet") };
    (cabinet, object.center(&experiment.parameters))
}

/// Contract: what was demonstrated elsewhere began there: it is not put into the scene of the execution, whose bars stand elsewhere.
#[test]
fn lessons_at_other_handles_can_be_learned_from() {
    let folder = tempfile::tempdir().expect("a folder");
    taught().0.write(folder.path()).expect("written");
    for handle_y_m in BETWEEN_M {
        let mut experiment = arm(&scenario_with("cabinet_door.toml", &[])).clone();
        experiment.demonstrations = DemonstrationSource::Dataset(folder.path().to_path_buf());
        experiment.parameters = experiment.parameters.with(&[("handle_y_m".into(), handle_y_m)]);
        let setup = Setup::new(&experiment).expect("the robot loads");
        setup.preflight(&Silent).unwrap_or_else(|error| panic!("at {handle_y_m} m: {error}"));
    }
}

#[test]
fn the_door_opens_at_a_handle_that_was_never_used() {
    let scenario = scenario_with("cabinet_door.toml", &[]);
    let (_, _, criteria) = executed(&scenario, taught(), HANDLE_3_M, |_| {});
    println!("{}", row("handle 3", &criteria));
    let missed: Vec<_> = criteria.iter().filter(|c| !c.as_expected()).map(|c| (c.name.as_str(), c.value)).collect();
    assert!(missed.is_empty(), "{missed:?}");
}

#[test]
fn the_door_opens_between_the_handles_and_beyond_them() {
    let scenario = scenario_with("cabinet_door.toml", &[]);
    for handle_y_m in BETWEEN_M.into_iter().chain(BEYOND_M) {
        let (_, _, criteria) = executed(&scenario, taught(), handle_y_m, |_| {});
        println!("{}", row(&format!("handle at {handle_y_m} m"), &criteria));
        assert!(value(&criteria, "door_open") >= OPEN_RAD, "{handle_y_m} m");
        assert!(value(&criteria, "arc_followed") <= 0.004, "{handle_y_m} m");
        assert_eq!(value(&criteria, "nothing_else_touched"), 0.0, "{handle_y_m} m");
        // Half a place before the first handle the plan may shut the door on its stop before it opens it, and is not held to this.
        if handle_y_m != BEYOND_M[0] {
            assert!(value(&criteria, "hook_force") <= 20.0, "{handle_y_m} m");
        }
    }
}

/// Contract: the clamped hook is on the handle's circle, and the door's angle is that of the hook seen from the hinge.
#[test]
fn the_hook_and_the_door_move_as_a_hinge_lets_them() {
    let scenario = scenario_with("cabinet_door.toml", &[]);
    let (experiment, outcome, _) = executed(&scenario, taught(), HANDLE_3_M, |_| {});
    let (cabinet, hinge) = cabinet(&experiment);
    let handle = cabinet.handle(hinge.y, &experiment.parameters);
    let angle = |v: Vector2<f64>| v.y.atan2(v.x);
    for step in outcome.steps.iter().filter(|step| step.time_s > 0.6) {
        let away = step.tool.translation.vector.xy() - hinge;
        assert!((away.norm() - cabinet.arc_radius_m(hinge.y, &experiment.parameters)).abs() < 2e-4, "{} s", step.time_s);
        let turned = angle(handle.coords.xy()) - angle(away);
        let turned = turned.sin().atan2(turned.cos());
        assert!((turned - opening_rad(&step.objects[0])).abs() < 1e-3, "{turned} rad at {} s", step.time_s);
    }
}

/// How far the force at the hook, as the world tells it, is from what the arm feels (N), and its torque about the hinge from what turns the
/// door (N m), at most, when nothing is wrong with the arm's sensors and joints.
fn mismatch_of_forces(solver_iterations: usize) -> [f64; 2] {
    let scenario = scenario_with("cabinet_door.toml", &[]);
    let (experiment, outcome, _) = executed(&scenario, taught(), 0.32, |experiment| {
        experiment.physics.solver_iterations = solver_iterations;
        experiment.robot.sensor = faultless_sensors();
    });
    let (cabinet, hinge) = cabinet(&experiment);
    let [m, friction_nm] = [&cabinet.mass_kg, &cabinet.friction_nm].map(|quantity| quantity.resolve(&experiment.parameters));
    let (w, t) = (cabinet.door_size_m.x, 0.018);
    let inertia = m * (w * w + t * t) / 3.0;
    let opening: Vec<f64> = outcome.steps.iter().map(|step| opening_rad(&step.objects[0])).collect();
    let dt = outcome.steps[1].time_s - outcome.steps[0].time_s;
    let (mut felt, mut torque): (f64, f64) = (0.0, 0.0);
    for k in 100..900 {
        let step = &outcome.steps[k];
        // The measurement of a step is told with the next one.
        felt = felt.max((step.wrench.fixed_rows::<3>(0) - step.tool_force).norm());
        let rate = (opening[k + 1] - opening[k - 1]) / (2.0 * dt);
        let acceleration = (opening[k + 1] - 2.0 * opening[k] + opening[k - 1]) / (dt * dt);
        let arm = step.tool.translation.vector.xy() - hinge;
        // The hook pulls with the opposite of what the door does to it; the door opens about -z.
        let pull = arm.x * step.tool_force.y - arm.y * step.tool_force.x;
        let needed = inertia * acceleration + cabinet.damping_nms_per_rad * rate + friction_nm * rate.signum();
        if rate > 0.02 {
            torque = torque.max((pull - needed).abs());
        }
    }
    [felt, torque]
}

/// Contract: what the world says the door did to the hook is what the arm feels and what turns the door, `F r = I a + d w + friction`, however
/// often the engine's solver goes over a step.
#[test]
fn the_force_at_the_hook_is_felt_by_the_arm_and_turns_the_door() {
    for solver_iterations in [1, 4] {
        let [felt_n, torque_nm] = mismatch_of_forces(solver_iterations);
        println!("{solver_iterations} solver iterations: arm against world {felt_n:.4} N, hinge {torque_nm:.4} N m");
        assert!(felt_n < 0.05, "{solver_iterations} solver iterations: {felt_n} N");
        assert!(torque_nm < 0.05, "{solver_iterations} solver iterations: {torque_nm} N m");
    }
}

#[test]
fn the_same_skill_in_the_same_setting_does_the_same_to_the_last_bit() {
    let scenario = scenario_with("cabinet_door.toml", &[]);
    let hash = || executed(&scenario, taught(), 0.42, |_| {}).1.state_hash;
    assert_eq!(hash(), hash());
}

/// Contract: an opening that is taken up before, while and after the clamp holds the handle goes on in the same bits.
#[test]
fn an_opening_that_is_taken_up_goes_on_in_the_same_bits() {
    let scenario = scenario_with("cabinet_door.toml", &["recording.snapshot_every_steps=1500", "recording.hash_every_steps=50"]);
    let (experiment, outcome, _) = executed(&scenario, taught(), 0.42, |_| {});
    goes_on_from_every_snapshot(&experiment, &outcome, 5);
}

#[test]
fn a_hook_without_a_clamp_opens_the_door_by_contact() {
    let scenario = scenario_with("cabinet_door_contact_hook.toml", &[]);
    let taught = taught_by_contact();
    for handle_y_m in [0.45, 0.40, 0.35, 0.30, 0.25] {
        let (experiment, _, criteria) = executed(&scenario, taught, handle_y_m, |_| {});
        assert_eq!(cabinet(&experiment).0.grip, Grip::Contact);
        println!("{}, {:.1} N in one step", row(&format!("contact at {handle_y_m} m"), &criteria), value(&criteria, "hook_blow"));
        assert!(value(&criteria, "door_open") >= OPEN_RAD, "{handle_y_m} m");
        for name in ["hook_kept", "hook_force"] {
            assert!(criteria.iter().find(|c| c.name == name).expect("asked").passed, "{name} at {handle_y_m} m");
        }
        assert_eq!(value(&criteria, "nothing_else_touched"), 0.0, "{handle_y_m} m");
    }
}

#[test]
fn the_plain_primitive_knows_no_handles() {
    let scenario = scenario_with("cabinet_door_lwr.toml", &[]);
    let (dataset, _) = taught();
    let learned = learning::learn(dataset, &arm(&scenario).learning, 0).expect("a baseline");
    let baseline = (dataset.clone(), learned);
    let (_, _, criteria) = executed(&scenario, &baseline, BEYOND_M[1], |_| {});
    println!("{}", row("LWR-DMP beyond the last handle", &criteria));
    let (_, _, own) = executed(&scenario, taught(), BEYOND_M[1], |_| {});
    assert!(value(&criteria, "plan_on_the_arc") > 3.0 * value(&own, "plan_on_the_arc"));
}

/// Contract: before the first step, whatever cannot be done is said, with the pose and the joint that stop it.
#[test]
fn what_cannot_be_reached_is_said_before_the_first_step() {
    let refused = |set: &[&str]| {
        let scenario = scenario_with("cabinet_door.toml", set);
        Setup::new(arm(&scenario)).expect("the robot loads").preflight(&Silent).expect_err("refused").to_string()
    };
    let far = refused(&["object.cabinet.center_m=[1.3, 0.65]"]);
    assert!(far.starts_with("way-point 1 (at cabinet) of lesson 1 cannot be reached") && far.contains("joint `left_"), "{far}");
    let wide =
        refused(&["object.cabinet.center_m=[0.62, 0.65]", "object.cabinet.opening_max_rad=3.0", "teaching.waypoint.1.opening_rad=2.9"]);
    assert!(wide.contains("of lesson 1") && wide.contains("joint `left_"), "{wide}");
    let inside = refused(&["object.cabinet.handle_length_m=0.04", "object.cabinet.handle_standoff_m=0.015"]);
    assert!(inside.starts_with("lesson 1: at the start `left_hook` is ") && inside.contains("inside `cabinet.door`"), "{inside}");
    let off = refused(&["parameters.handle_y_m=0.15"]);
    assert!(off.contains("the handle of `cabinet` is 0.500 m from the hinge, but its door is 0.46 m wide"), "{off}");
}

/// Contract: a door turns its handle on a circle, and its opening is read back from its pose. Handles make room for the one in use.
#[test]
fn a_door_carries_its_handle_on_a_circle() {
    let scenario = scenario_with("cabinet_door.toml", &[]);
    let (cabinet, hinge) = cabinet(arm(&scenario));
    let at = |y: f64| Parameters(vec![("handle_y_m".into(), y)]);
    let handle = cabinet.handle(hinge.y, &at(0.40));
    for k in 0..=30 {
        let opening = 0.05 * f64::from(k);
        let pose = Isometry3::from_parts(hinge.push(0.0).into(), door_turn(opening));
        assert!((opening_rad(&pose) - opening).abs() < 1e-12);
        let place = (pose * handle).coords.xy() - hinge;
        // 25 cm from the hinge, 4 cm before the face.
        assert!((place.norm() - 0.25_f64.hypot(0.04)).abs() < 1e-12);
        assert!(
            (place - Vector2::new(-0.25 * opening.sin() - 0.04 * opening.cos(), -0.25 * opening.cos() + 0.04 * opening.sin())).norm()
                < 1e-12
        );
    }
    let names = |y: f64| cabinet.bars(hinge.y, &at(y)).into_iter().map(|(name, _)| name).collect::<Vec<_>>();
    assert_eq!(names(0.35), ["handle_1", "handle_2", "handle_3", "handle_4", "handle_5"]);
    assert_eq!(names(0.375), ["handle_1", "handle_4", "handle_5", "handle_between"]);
    assert_eq!(names(0.225), ["handle_1", "handle_2", "handle_3", "handle_4", "handle_between"]);
}

/// What is measured in every execution of a kind, and the worst of it.
#[derive(Default)]
struct Tally(Vec<(String, Vec<f64>)>);

impl Tally {
    const NAMES: [&str; 6] = ["door_open", "plan_on_the_arc", "arc_followed", "hook_force", "hook_kept", "nothing_else_touched"];

    fn add(&mut self, kind: String, criteria: &[Criterion]) {
        println!("{}", row(&kind, criteria));
        self.0.push((kind, Self::NAMES.map(|name| value(criteria, name)).to_vec()));
    }

    fn print(&self) {
        let mut kinds: Vec<&String> = self.0.iter().map(|(kind, _)| kind).collect();
        kinds.sort();
        kinds.dedup();
        for kind in kinds {
            let of = |k: usize| self.0.iter().filter(move |(other, _)| other == kind).map(move |(_, values)| values[k]);
            let (least, most) = (of(0).fold(f64::INFINITY, f64::min), |k: usize| of(k).fold(0.0, f64::max));
            println!(
                "worst of {} for {kind}: {:.1} deg, plan {:.2} mm, tool {:.2} mm, {:.1} N, bar {:.1} mm off, {} other contacts",
                of(0).count(),
                least.to_degrees(),
                most(1) * 1e3,
                most(2) * 1e3,
                most(3),
                most(4) * 1e3,
                most(5)
            );
        }
    }
}

/// The shipped experiment with twenty teachers, worst stated.
#[test]
#[ignore = "twenty teachers take a quarter of an hour"]
fn twenty_teachers() {
    let (mut tally, mut in_the_bar) = (Tally::default(), 0);
    for seed in 0..20u64 {
        let scenario = scenario_with("cabinet_door.toml", &[&format!("seed={seed}")]);
        let lessons = lessons(&scenario);
        let baseline = scenario_with("cabinet_door_lwr.toml", &[&format!("seed={seed}")]);
        let learned = learning::learn(&lessons.0, &arm(&baseline).learning, seed).expect("a baseline");
        let of_baseline = (lessons.0.clone(), learned);
        for handle_y_m in [HANDLE_3_M].into_iter().chain(BETWEEN_M).chain(BEYOND_M) {
            let (_, _, criteria) = executed(&scenario, &lessons, handle_y_m, |_| {});
            assert!(value(&criteria, "door_open") >= if handle_y_m == HANDLE_3_M { WIDE_RAD } else { OPEN_RAD });
            tally.add(format!("cpdmp {handle_y_m} m"), &criteria);
            match tried(&baseline, &of_baseline, handle_y_m, |_| {}) {
                Ok((_, _, criteria)) => tally.add(format!("lwr {handle_y_m} m"), &criteria),
                Err(SimulationError::Scene(_)) => in_the_bar += 1,
                Err(error) => panic!("{error}"),
            }
        }
    }
    tally.print();
    println!("{in_the_bar} times the baseline would start inside a bar");
}

/// The shipped experiment without a clamp, with twenty teachers, worst stated.
#[test]
#[ignore = "twenty teachers take ten minutes"]
fn twenty_teachers_without_a_clamp() {
    let mut tally = Tally::default();
    let mut blow: f64 = 0.0;
    for seed in 0..20u64 {
        let scenario = scenario_with("cabinet_door_contact_hook.toml", &[&format!("seed={seed}")]);
        let lessons = lessons(&scenario);
        for handle_y_m in [0.45, 0.40, 0.35, 0.30, 0.25] {
            let (_, _, criteria) = executed(&scenario, &lessons, handle_y_m, |_| {});
            assert!(value(&criteria, "door_open") >= OPEN_RAD);
            blow = blow.max(value(&criteria, "hook_blow"));
            tally.add(format!("contact {handle_y_m} m"), &criteria);
        }
    }
    tally.print();
    println!("at most {blow:.1} N in one step of the engine");
}
