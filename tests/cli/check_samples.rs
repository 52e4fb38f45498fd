//! `cpdmp check` of samples that are not what they seem: angles in degrees, columns of somebody else, movements that take long to look at.

use std::sync::atomic::{AtomicUsize, Ordering};

use cpdmp::demonstration::read_trajectory;
use cpdmp::scenario::{LoadOptions, Scenario, Work};
use cpdmp::simulation::{ArmMotion, Progress, Setup, Silent, SimulationError, check_motion};
use serde_json::Value;

use super::{Folder, GOOD};

const REST: [f64; 7] = [-0.4347, -1.0645, -0.4138, 1.934, 0.2873, 0.7587, -0.2272];

/// Samples of the left arm's joints, a second apart, with more columns.
fn samples(rows: &[[f64; 7]], more: &[(&str, f64)]) -> String {
    let joints = ["s0", "s1", "e0", "e1", "w0", "w1", "w2"].map(|joint| format!("left_{joint}_rad"));
    let heading: Vec<String> = joints.into_iter().chain(more.iter().map(|(name, _)| (*name).to_owned())).collect();
    let row = |(time_s, row): (usize, &[f64; 7])| {
        let cells: Vec<String> = row.iter().chain(more.iter().map(|(_, value)| value)).map(ToString::to_string).collect();
        format!("{time_s},{}\n", cells.join(","))
    };
    format!("time_s,{}\n{}", heading.join(","), rows.iter().enumerate().map(row).collect::<String>())
}

fn folder(text: &str) -> Folder {
    Folder::with(&[("a.toml", GOOD.as_bytes()), ("a.csv", text.as_bytes())])
}

/// The only check of `a.csv`, which ends with that code.
fn checked(folder: &Folder, more: &[&str], code: i32) -> Value {
    let said = folder.call(&[&["check", "a.csv", "--scene", "a.toml", "--format", "json", "-q"], more].concat());
    assert_eq!(said.code, Some(code), "{}{}", said.stdout, said.stderr);
    serde_json::from_str::<Value>(&said.stdout).expect("JSON")["checks"][0].clone()
}

fn criterion<'a>(check: &'a Value, name: &str) -> &'a Value {
    let all = check["report"]["criteria"].as_array().expect("a list");
    all.iter().find(|one| one["name"] == name).unwrap_or_else(|| panic!("no {name} in {check:#}"))
}

fn warnings(check: &Value) -> String {
    check["report"]["warnings"].to_string()
}

/// Contract: angles far beyond the limits fail as such; what the arm would touch there is not told as good, nor looked for.
#[test]
fn angles_in_degrees_are_far_beyond_the_limits() {
    let degrees = REST.map(f64::to_degrees);
    let check = checked(&folder(&samples(&[degrees, degrees.map(|angle| angle + 1.0)], &[])), &[], 10);
    assert_eq!(criterion(&check, "joint_limits")["passed"], false, "{check:#}");
    assert_eq!(criterion(&check, "contacts_allowed")["status"], "not_judged", "{check:#}");
    assert!(warnings(&check).contains("`left_s0` is at -24.906 rad at 0.000 s") && warnings(&check).contains("degrees?"), "{check:#}");
    let mut far = REST;
    far[0] = 1e4;
    let check = checked(&folder(&samples(&[REST, far], &[])), &[], 10);
    assert!(warnings(&check).contains("10000.000 rad at 1.000 s") && !warnings(&check).contains("degrees?"), "{check:#}");
}

/// Counts how often it is asked, and says no from some question on.
struct Patience(AtomicUsize, usize);

impl Progress for Patience {
    fn phase(&self, _name: &str, _steps: u64) {}
    fn advance(&self, _steps: u64) {}
    fn note(&self, _text: &str) {}
    fn elapsed_s(&self) -> f64 {
        0.0
    }
    fn may_go_on(&self) -> bool {
        self.0.fetch_add(1, Ordering::Relaxed) < self.1
    }
}

/// Contract: a time limit ends the check with its own code, and within a movement from one sample to the next, too.
#[test]
fn a_time_limit_ends_the_look_at_a_movement() {
    let mut end = REST;
    end[0] = 1.2;
    let joints = folder(&samples(&[REST, end], &[]));
    let poses = folder("time_s,x_m,y_m,z_m,qx,qy,qz,qw\n0,0.6,0.4,0.12,1,0,0,0\n1,0.6,0.3,0.12,1,0,0,0\n");
    for folder in [&joints, &poses] {
        let check = checked(folder, &["--timeout", "0.001"], 12);
        assert!(check["report"]["error"].as_str().is_some_and(|told| told.contains("time limit")), "{check:#}");
    }
    let scenario = Scenario::load(&joints.path().join("a.toml"), &LoadOptions::default()).unwrap_or_else(|faults| panic!("{faults}"));
    let Work::Arm(experiment) = scenario.work else { panic!("no arm") };
    let setup = Setup::new(&experiment).expect("the robot loads");
    let trajectory = read_trajectory(&joints.path().join("a.csv")).expect("samples");
    let motion = ArmMotion::new(&setup, &trajectory, &Silent).expect("a movement");
    let asked = |most: usize| {
        let patience = Patience(AtomicUsize::new(0), most);
        let stopped = matches!(check_motion(&setup, &motion, &patience), Err(SimulationError::StoppedBefore { .. }));
        (stopped, patience.0.into_inner())
    };
    let (stopped, all) = asked(usize::MAX);
    assert!(!stopped && all > 5_000, "{all} questions for a way of 1.6 rad");
    let (stopped, some) = asked(all / 2);
    assert!(stopped && some < all * 3 / 4, "{some} of {all}");
}

/// Contract: a criterion that fails says when it first did, not when it was worst.
#[test]
fn limits_are_first_failed_when_they_are_first_exceeded() {
    let beyond = [1.6, 1.8, 1.85, 1.9].map(|s0| [s0, REST[1], REST[2], REST[3], REST[4], REST[5], REST[6]]);
    let check = checked(&folder(&samples(&beyond, &[])), &[], 10);
    let limits = criterion(&check, "joint_limits");
    assert_eq!(limits["first_failed_time_s"].as_f64(), Some(1.0), "{limits}");
    assert!((limits["value"].as_f64().expect("rad") - (1.7016 - 1.9)).abs() < 1e-3, "{limits}");
    let fast = [0.0, 0.1, 2.5, 5.9].map(|w2| [REST[0], REST[1], REST[2], REST[3], REST[4], REST[5], w2 - 2.9]);
    let text = samples(&fast, &[]).replace("\n2,", "\n1.5,").replace("\n3,", "\n2,");
    let speeds = checked(&folder(&text), &[], 10);
    let speeds = criterion(&speeds, "joint_speeds");
    assert_eq!(speeds["first_failed_time_s"].as_f64(), Some(1.0), "4.8 rad/s from there on, 6.8 rad/s from 1.5 s on: {speeds}");
}

/// Contract: columns that tell of another joint, tell the arm twice or tell half a pose are refused by name, all at once.
#[test]
fn columns_that_cannot_be_followed_are_refused() {
    let more = [("right_s0_rad", 9.0), ("q1_rad", 0.3), ("x_m", 0.5), ("toy_x_m", 0.6), ("toy_y_m", 0.3)];
    let check = checked(&folder(&samples(&[REST, REST], &more)), &[], 3);
    let told = check.to_string();
    for part in ["[right_s0_rad] are not of the arm", "and by [q1_rad] and by [x_m]", "of `toy` it has only [toy_x_m, toy_y_m]"] {
        assert!(told.contains(part), "{part}: {check:#}");
    }
}

/// Contract: joints and a tool that are of one movement are judged; when they part, it is told by how much and when.
#[test]
fn joints_and_tool_are_one_movement_or_refused() {
    let scene = folder("");
    let Ok(Scenario { work: Work::Arm(experiment), .. }) = Scenario::load(&scene.path().join("a.toml"), &LoadOptions::default()) else {
        panic!("an arm");
    };
    let robot = Setup::new(&experiment).expect("a robot").robot.clone();
    let chain = cpdmp::robot::SerialChain::new(&robot, "base", &experiment.robot.tool_link).expect("an arm");
    let mut state = chain.state();
    chain.forward_kinematics(&REST, &mut state);
    let tool = state.tip_pose();
    let (place, turn) = (tool.translation.vector, tool.rotation.coords);
    let columns = |off_m: f64| {
        [
            ("x_m", place.x + off_m),
            ("y_m", place.y),
            ("z_m", place.z),
            ("qx", turn.x),
            ("qy", turn.y),
            ("qz", turn.z),
            ("qw", turn.w),
            ("fx_n", 1.0),
        ]
    };
    let one = checked(&folder(&samples(&[REST, REST], &columns(1e-4))), &[], 0);
    assert_eq!(warnings(&one), "[]", "{one:#}");
    let two = checked(&folder(&samples(&[REST, REST], &columns(0.03))), &[], 3).to_string();
    assert!(
        two.contains("and by [x_m, y_m, z_m, qx, qy, qz, qw]")
            && two.contains("up to 30.0 mm and 0.0 deg apart (at 0.000 s), more than 5 mm or 0.6 deg"),
        "{two}"
    );
}

/// Contract: a column of which nothing is taken, and an object that the scene keeps elsewhere, are warned of; what a step log holds is not.
#[test]
fn columns_that_say_nothing_are_warned_of() {
    let unused = folder(&samples(&[REST, REST], &[("tyo_x_m", 0.6), ("effort1_nm", 3.0), ("left_w9_rad", 1.0)]));
    let check = checked(&unused, &[], 0);
    assert!(warnings(&check).contains("[tyo_x_m, left_w9_rad]"), "{check:#}");
    checked(&unused, &["--deny-warnings"], 10);
    let said = unused.call(&["check", "a.csv", "--scene", "a.toml"]);
    assert!(said.stderr.contains("a.csv: warning: columns that nothing is taken from"), "{}", said.stderr);
    let pose = |x_m: f64| {
        let columns = ["x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"].map(|axis| format!("table_{axis}"));
        let values = [x_m, 0.12, 0.0, 0.0, 0.0, 0.0, 1.0];
        let more: Vec<(&str, f64)> = columns.iter().map(String::as_str).zip(values).collect();
        checked(&folder(&samples(&[REST, REST], &more)), &[], 0)
    };
    assert_eq!(warnings(&pose(0.62)), "[]");
    assert!(warnings(&pose(0.72)).contains("`table` up to 100.0 mm"), "{}", warnings(&pose(0.72)));
}

/// Contract: with a scene, movements that lie in a folder are judged as if they had been named; a scene for nothing is a slip.
#[test]
fn movements_in_a_folder_are_judged_too() {
    let mut far = REST;
    far[0] = 1e4;
    let folder = folder(&samples(&[REST, REST], &[]));
    std::fs::create_dir(folder.path().join("moves")).expect("made");
    for (name, end) in [("good.csv", REST), ("bad.tsv", far)] {
        let text = samples(&[REST, end], &[]);
        let text = if name.ends_with("tsv") { text.replace(',', "\t") } else { text };
        std::fs::write(folder.path().join("moves").join(name), text).expect("written");
    }
    let said = folder.call(&["check", "moves", "--scene", "a.toml", "--format", "json", "-q"]);
    assert_eq!(said.code, Some(10), "{}{}", said.stdout, said.stderr);
    let checks = serde_json::from_str::<Value>(&said.stdout).expect("JSON")["checks"].clone();
    let told: Vec<_> = checks.as_array().expect("a list").iter().map(|check| (check["path"].as_str(), check["outcome"].as_str())).collect();
    assert_eq!(told, [(Some("moves/bad.tsv"), Some("criteria_not_met")), (Some("moves/good.csv"), Some("passed"))]);
    let by_pattern = folder.call(&["check", "moves/*", "--scene", "a.toml", "--format", "json", "-q"]);
    let again = serde_json::from_str::<Value>(&by_pattern.stdout).expect("JSON")["checks"].clone();
    assert_eq!((by_pattern.code, again.as_array().map(Vec::len)), (Some(10), Some(2)), "a pattern finds what its folder does");
    assert!(folder.call(&["check", "moves"]).stderr.contains("2 files of samples are not judged"));
    assert_eq!(folder.call(&["check", "moves", "-q"]).code, Some(5), "without a scene there is nothing to judge them in");
    let said = folder.call(&["check", "a.toml", "--scene", "a.toml", "-q"]);
    assert!(said.code == Some(2) && said.stderr.contains("--scene has no effect"), "{:?} {}", said.code, said.stderr);
}

/// Contract: a scene that cannot be simulated because things stand inside each other is none to judge a movement in.
#[test]
fn a_scene_that_cannot_be_is_none_to_judge_in() {
    let folder = folder(&samples(&[REST, REST], &[]));
    let inside = ["--set", "object.block.center_m=[0.0,0.0]", "--set", "object.block.raised_m=0.5"];
    let said = folder.call(&[&["check", "a.csv", "--scene", "a.toml", "-q"], &inside[..]].concat());
    assert!(said.code == Some(3) && said.stdout.contains("inside") && said.stdout.contains("error[scene]"), "{}", said.stdout);
}
