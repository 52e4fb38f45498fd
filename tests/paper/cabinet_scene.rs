//! Cabinets as parts of a scene: several of them, and what a stored run tells of their doors.

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use cpdmp::check::judge;
use cpdmp::demonstration::{Trajectory, read_trajectory};
use cpdmp::recording::write_step_log;
use cpdmp::scenario::{InvalidScenario, LoadOptions, Scenario};
use cpdmp::simulation::{self, ArmMotion, Progress, Setup, Silent, check_motion};
use cpdmp::world::{Clearance, ContactEpisode, Object, ObjectKind, Quantity, Solid, nearest_of_each, opening_rad};
use nalgebra::{DMatrix, Vector2, Vector3};

use super::cabinet_door::{HANDLE_3_M, arm, cabinet, executed, scenario_with, taught, tried, value};

/// A cabinet to the left of the shipped one.
const ANOTHER: &str = r#"
[[object]]
name = "another"
kind = "cabinet"
center_m = [0.88, 1.75]
door_size_m = [0.46, 0.40]
bottom_height_m = -0.20
handle_lateral_m = 1.45

"#;

/// The shipped scenario with another cabinet before its own, and `more` at its end, two lessons only.
fn with_another(more: &str) -> Result<Scenario, InvalidScenario> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/cabinet_door.toml");
    let shipped = std::fs::read_to_string(path).expect("shipped");
    let own = shipped.find("[[object]]").expect("it has a cabinet");
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("two.toml");
    std::fs::write(&file, format!("{}{ANOTHER}{}{more}", &shipped[..own], &shipped[own..])).expect("written");
    let set = ["teaching.repetitions=1", "teaching.grid.handle_y_m=[0.40, 0.30]"].map(String::from).to_vec();
    Scenario::load(&file, &LoadOptions { set, ..LoadOptions::default() })
}

/// Contract: a door is led about its own hinge and held by its own bars, whatever other cabinets the scene has before it.
#[test]
fn the_second_of_two_cabinets_is_opened_at_its_own_handle() {
    let scenario = with_another("").unwrap_or_else(|faults| panic!("{faults}"));
    let outcome = simulation::run(arm(&scenario), &Silent).expect("it runs");
    let openings = outcome.lessons.iter().map(|lesson| {
        let last = lesson.looks.last().expect("somebody looked");
        [0, 1].map(|cabinet| opening_rad(&last.objects[cabinet]))
    });
    for [another, own] in openings {
        assert!((own.to_degrees() - 60.0).abs() < 1.0 && another.abs() < 1e-3, "led to {own} rad, the other to {another} rad");
    }
    let criteria = judge(&outcome, arm(&scenario), &scenario.criteria);
    let missed: Vec<_> = criteria.iter().filter(|c| !c.as_expected()).map(|c| (c.name.as_str(), c.value)).collect();
    assert!(missed.is_empty(), "{missed:?}");
}

#[test]
fn no_way_leads_from_one_open_door_straight_to_another() {
    let more = "\n[[teaching.waypoint]]\ntime_s = 9.5\nat = \"another\"\nopening_rad = 0.5\n";
    let told = with_another(more).expect_err("refused").to_string();
    assert!(told.contains("the way goes from an opening of `cabinet` straight to one of `another`"), "{told}");
    let between = format!("\n[[teaching.waypoint]]\ntime_s = 9.2\nat = \"cabinet\"\n{more}");
    with_another(&between).unwrap_or_else(|faults| panic!("{faults}"));
}

fn pairs(contacts: &[ContactEpisode]) -> Vec<(&str, &str)> {
    let mut pairs: Vec<(&str, &str)> = contacts.iter().map(|contact| (contact.a.as_str(), contact.b.as_str())).collect();
    pairs.sort_unstable();
    pairs
}

/// Contract: a stored run that is judged again by geometry alone tells the contacts and the nearest passages that the run itself told: the door
/// is where the log says, not where it started.
#[test]
fn a_stored_run_is_judged_with_its_door_open() {
    let scenario = scenario_with("cabinet_door.toml", &[]);
    let (experiment, outcome, criteria) = executed(&scenario, taught(), HANDLE_3_M, |_| {});
    assert!(value(&criteria, "door_open") > 0.9);
    let folder = tempfile::tempdir().expect("a folder");
    let log = folder.path().join("steps.parquet");
    write_step_log(&log, &outcome).expect("written");
    let setup = Setup::new(&experiment).expect("the robot loads");
    let motion = ArmMotion::new(&setup, &read_trajectory(&log).expect("a log"), &Silent).expect("a movement");
    let again = check_motion(&setup, &motion, &Silent).expect("judged");
    println!("{:#?}\n{:#?}", outcome.collisions, again.collisions);
    assert_eq!(pairs(&again.collisions), pairs(&outcome.collisions));
    for (then, now) in nearest_of_each(&outcome.clearances).into_iter().zip(nearest_of_each(&again.clearances)) {
        println!("{then:?}\n{now:?}");
        let of = |one: &Clearance| (one.a.clone(), one.b.clone());
        assert_eq!(of(then), of(now));
        assert!((then.min_distance_m - now.min_distance_m).abs() < 5e-4, "{then:?}, judged again {now:?}");
    }
}

/// Contract: what a skill plans is solved pose by pose before anything moves, and the first pose that the arm cannot reach is named with its time
/// and the joint that stops it.
#[test]
fn a_plan_that_leads_out_of_reach_is_refused_with_time_and_joint() {
    let scenario = scenario_with("cabinet_door.toml", &[]);
    let setup = Setup::new(arm(&scenario)).expect("the robot loads");
    // From the handle straight ahead, turned as the tool is there.
    let turn = taught().0.demonstrations[0].trajectory.orientations().expect("turned")[0];
    let columns = ["x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"].map(String::from).to_vec();
    let plan = |metres: f64| {
        let q = turn.coords;
        let row = |k: usize| [0.80 + metres * k as f64 / 100.0, 0.35, 0.0, q[0], q[1], q[2], q[3]];
        let values = DMatrix::from_fn(101, 7, |k, column| row(k)[column]);
        Trajectory::new((0..=100).map(|k| 0.05 * f64::from(k)).collect(), columns.clone(), values).expect("a plan")
    };
    setup.can_follow(&plan(0.02), &Silent).expect("within reach");
    let refused = setup.can_follow(&plan(1.0), &Silent).expect_err("out of reach").to_string();
    assert!(refused.starts_with("the skill's plan at ") && refused.contains(" s cannot be reached: "), "{refused}");
    assert!(refused.contains("joint `left_") && refused.contains("nearer to those that were demonstrated"), "{refused}");
    let time_s: f64 = refused["the skill's plan at ".len()..].split(' ').next().expect("a word").parse().expect("a time");
    assert!(time_s > 0.5 && time_s < 4.5, "{time_s} s: the first metre is not all out of reach, nor all within");
}

/// Somebody who waits for so many questions.
struct Patience(AtomicUsize);

impl Progress for Patience {
    fn phase(&self, _name: &str, _steps: u64) {}
    fn advance(&self, _steps: u64) {}
    fn note(&self, _text: &str) {}
    fn elapsed_s(&self) -> f64 {
        0.0
    }
    fn may_go_on(&self) -> bool {
        self.0.fetch_update(Ordering::SeqCst, Ordering::SeqCst, |left| left.checked_sub(1)).is_ok()
    }
}

/// Contract: looking at plans ends at the first pose at which it may not go on, in the execution and in every lesson.
#[test]
fn looking_at_a_plan_stops_when_it_may_not_go_on() {
    let scenario = scenario_with("cabinet_door.toml", &[]);
    let setup = Setup::new(arm(&scenario)).expect("the robot loads");
    let shown = &taught().0.demonstrations[0].trajectory;
    let looked = |patience: usize| setup.can_follow(shown, &Patience(AtomicUsize::new(patience)));
    looked(1_000_000).expect("it was shown, so it can be followed");
    let stopped = looked(7).expect_err("not looked at").to_string();
    assert!(
        stopped.contains("the time limit was reached before the skill's plan at 0.3") && stopped.contains(" s was looked at"),
        "{stopped}"
    );
    let stopped = setup.preflight(&Patience(AtomicUsize::new(500))).expect_err("not looked at").to_string();
    assert!(stopped.contains("the time limit was reached before ") && stopped.contains(" of lesson "), "{stopped}");
}

/// Contract: a skill that starts inside something is refused before the first step, and it is said that it is the skill's start.
#[test]
fn a_skill_that_starts_inside_something_says_so() {
    let scenario = scenario_with("cabinet_door.toml", &[]);
    let refused = tried(&scenario, taught(), HANDLE_3_M, |experiment| {
        let body = Solid { mass_kg: 1.0.into(), friction: 0.5.into(), fixed: true };
        let kind = ObjectKind::Box { size_m: Vector3::new(0.1, 0.1, 0.1), body };
        let block = Object { raised_m: Quantity::Value(-0.05), ..Object::new("block", Vector2::new(0.75, HANDLE_3_M), kind) };
        experiment.objects.push(block);
    });
    let told = refused.map(|_| ()).expect_err("refused").to_string();
    assert!(told.starts_with("the skill's start: ") && told.contains("inside `block`"), "{told}");
}

#[test]
fn what_a_door_weighs_may_be_a_parameter() {
    let weights = ["object.cabinet.mass_kg=\"handle_y_m\"", "object.cabinet.friction_nm=\"handle_y_m\""];
    let scenario = scenario_with("cabinet_door.toml", &weights);
    let (cabinet, _) = cabinet(arm(&scenario));
    let parameters = &arm(&scenario).parameters;
    assert_eq!([&cabinet.mass_kg, &cabinet.friction_nm].map(|one| one.resolve(parameters)), [HANDLE_3_M; 2]);
}
