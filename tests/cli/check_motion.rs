//! `cpdmp check` of movements that are not simulated: files of samples, and stored runs.

use cpdmp::check::judge_motion;
use cpdmp::scenario::{LoadOptions, Scenario, Work};
use cpdmp::simulation::{JointExtreme, MotionOutcome, Reach};
use serde_json::Value;

use super::program::Said;
use super::{Folder, GOOD};
use crate::physics::collisions_in_engine::{BESIDE, IN_THE_WAY, scenario};

/// The good scenario with a wall of 0.5 mm across the way, 30 cm high.
fn sheet() -> String {
    let thin = GOOD.replace("post_height_m = 0.14", "post_height_m = 0.14\nthickness_m = 0.0005");
    thin.replace("center_m = [1.2, 0.9]", "center_m = [0.6, 0.2]").replace("block_height_m = 0.2\n", "block_height_m = 0.3\n")
}

/// Two tool poses on either side of the wall, 40 cm in 0.2 s.
const THROUGH: &str = "time_s,x_m,y_m,z_m,qx,qy,qz,qw\n0.0,0.6,0.4,0.12,1,0,0,0\n0.2,0.6,0.0,0.12,1,0,0,0\n";

fn json(said: &Said) -> Value {
    serde_json::from_str(&said.stdout).unwrap_or_else(|error| panic!("{error}: {}{}", said.stdout, said.stderr))
}

/// The entry of a list whose keys have these values.
fn entry<'a>(list: &'a Value, wanted: &[(&str, &str)]) -> &'a Value {
    let fits = |one: &&Value| wanted.iter().all(|(key, value)| one[*key].as_str() == Some(value));
    list.as_array().expect("a list").iter().find(fits).unwrap_or_else(|| panic!("no {wanted:?} in {list:#}"))
}

/// Contract: a sheet of 0.5 mm crossed at 2 m/s between the only two samples is found, and told with pair, time, depth and point.
#[test]
fn a_sheet_that_is_crossed_between_two_samples_is_found() {
    let folder = Folder::with(&[("a.toml", sheet().as_bytes()), ("through.csv", THROUGH.as_bytes())]);
    let said = folder.call(&["check", "through.csv", "--scene", "a.toml", "--format", "json", "-q"]);
    assert_eq!(said.code, Some(10), "{}{}", said.stdout, said.stderr);
    let check = &json(&said)["checks"][0];
    assert_eq!((check["kind"].as_str(), check["outcome"].as_str()), (Some("trajectory"), Some("criteria_not_met")));
    let report = &check["report"];
    assert_eq!(entry(&report["criteria"], &[("name", "contacts_allowed")])["passed"].as_bool(), Some(false));
    // What geometry cannot answer is told with the reason, and decides nothing.
    let goal = entry(&report["criteria"], &[("name", "goal"), ("status", "not_judged")]);
    assert!(goal["required"].as_bool() == Some(false) && goal["not_judged_because"].is_string(), "{goal}");
    let contact = entry(&report["collisions"], &[("a", "left_hand"), ("b", "block.base")]);
    assert!(contact["max_force_n"].is_null(), "a movement has no forces: {contact}");
    let number = |key: &str| contact[key].as_f64().expect("a number");
    assert!(number("first_time_s") > 0.02 && number("last_time_s") < 0.18 && number("max_depth_m") > 1e-4, "{contact}");
    let y = contact["deepest_point_m"][1].as_f64().expect("a number");
    assert!((y - 0.2).abs() < 0.06, "within the hand's 4 cm of the wall: {contact}");
    let said = folder.call(&["check", "through.csv", "--scene", "a.toml"]);
    assert!(said.stdout.contains("left_hand - block.base") && said.stdout.contains("force not measured"), "{}", said.stdout);
    assert!(!said.stdout.contains(" 0.0 N"), "{}", said.stdout);
    assert!(said.stdout.contains("not judged here") && said.stdout.contains("goal  not judged: it asks what a skill"), "{}", said.stdout);
}

#[test]
fn a_movement_needs_a_scene_columns_and_numbers() {
    let holes = THROUGH.replace("0.6,0.0,0.12", "0.6,nan,0.12");
    let files = [("a.toml", GOOD.as_bytes()), ("b.csv", b"time_s,u_m\n0,1\n1,2\n".as_slice()), ("c.csv", holes.as_bytes())];
    let folder = Folder::with(&files);
    let said = folder.call(&["check", "b.csv"]);
    assert!(said.code == Some(2) && said.stderr.contains("--scene"), "{}", said.stderr);
    let said = folder.call(&["check", "*.csv", "--scene", "a.toml"]);
    assert_eq!(said.code, Some(3), "{}{}", said.stdout, said.stderr);
    assert!(said.stdout.contains("left_s0_rad") && said.stdout.contains("q1_rad"), "{}", said.stdout);
    assert!(said.stdout.contains("c.csv:3"), "the row is named: {}", said.stdout);
    assert_eq!(folder.call(&["check", "none*.csv", "--scene", "a.toml"]).code, Some(5));
}

/// Contract: what the arm cannot do is a criterion like any other: poses out of reach, joints beyond their limits, joints too fast.
#[test]
fn what_the_arm_cannot_do_is_told() {
    let far = THROUGH.replace("0.6,0.0", "2.6,0.0");
    let joints = "time_s,left_s0_rad,left_s1_rad,left_e0_rad,left_e1_rad,left_w0_rad,left_w1_rad,left_w2_rad\n\
                  0,-0.38,-1.05,-0.48,1.93,0.34,0.77,1.30\n0.1,-0.38,-1.05,-0.48,1.93,0.34,0.77,4.30\n";
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("far.csv", far.as_bytes()), ("joints.csv", joints.as_bytes())]);
    let said = folder.call(&["check", "far.csv", "joints.csv", "--scene", "a.toml", "--format", "json", "-q"]);
    assert_eq!(said.code, Some(10), "{}{}", said.stdout, said.stderr);
    let checks = json(&said)["checks"].clone();
    let value = |check: usize, name: &str| {
        let criterion = entry(&checks[check]["report"]["criteria"], &[("name", name)]);
        assert_eq!(criterion["as_expected"].as_bool(), Some(false), "{criterion}");
        criterion["value"].as_f64().expect("a number")
    };
    assert!(value(0, "poses_reached") > 1.0);
    assert!((value(1, "joint_limits") - (3.059 - 4.30)).abs() < 1e-3);
    assert!((value(1, "joint_speeds") - 3.0 / 0.1 / 4.0).abs() < 0.1);
}

/// Contract: a stored run is judged from its log as it was judged when it ran, and against a scene that has changed since.
#[test]
fn a_stored_run_is_judged_again() {
    let folder = Folder::with(&[("a.toml", scenario(BESIDE).as_bytes())]);
    let run = json(&folder.call(&["run", "a.toml", "--format", "json", "-q"]));
    assert_eq!(run["outcome"].as_str(), Some("passed"), "{run}");
    let said = folder.call(&["check", "runs", "--format", "json", "-q"]);
    assert_eq!(said.code, Some(0), "{}{}", said.stdout, said.stderr);
    let again = json(&said)["checks"][0].clone();
    assert_eq!(again["kind"].as_str(), Some("run"));
    for one in run["clearance"].as_array().expect("a list").iter().filter(|one| one["b"].as_str() == Some("block")) {
        let pair = [("a", one["a"].as_str().expect("a name")), ("b", "block")];
        let (was, is) = (&one["min_distance_m"], &entry(&again["report"]["clearance"], &pair)["min_distance_m"]);
        let (was, is) = (was.as_f64().expect("m"), is.as_f64().expect("m"));
        assert!((was - is).abs() < if was < 0.05 { 1e-4 } else { 0.03 * was }, "{pair:?}: {was} {is}");
    }
    let moved = format!("object.block.center_m=[{}, {}]", IN_THE_WAY[0], IN_THE_WAY[1]);
    let said = folder.call(&["check", "runs/passage-0", "--set", &moved, "--format", "json", "-q"]);
    assert_eq!(said.code, Some(10), "{}{}", said.stdout, said.stderr);
    let report = json(&said)["checks"][0]["report"].clone();
    let refused = |one: &&Value| one["allowed"].as_bool() == Some(false);
    let contact = report["collisions"].as_array().expect("a list").iter().find(refused).expect("a contact");
    assert!(contact["b"].as_str().is_some_and(|part| part.starts_with("block.")), "{contact}");
}

/// Contract: an allowed contact is no collision, and the report says who allows it and where.
#[test]
fn the_scene_says_which_contacts_it_allows_and_where() {
    let allowed = "\n[[allowed_contact]]\nname = \"tearing\"\na = \"left_hand\"\nb = \"block\"\n";
    let text = sheet() + allowed;
    let folder = Folder::with(&[("a.toml", text.as_bytes()), ("through.csv", THROUGH.as_bytes())]);
    let said = folder.call(&["check", "through.csv", "--scene", "a.toml", "--format", "json", "-q"]);
    let report = json(&said)["checks"][0]["report"].clone();
    let contact = entry(&report["collisions"], &[("a", "left_hand"), ("b", "block.base")]);
    assert_eq!((contact["allowed"].as_bool(), contact["reason_key"].as_str()), (Some(true), Some("allowed_contact.tearing")));
    let line = text[..text.find("\"tearing\"").expect("there")].matches('\n').count() as i64 + 1;
    assert_eq!((contact["reason_place"]["file"].as_str(), contact["reason_place"]["line"].as_i64()), (Some("a.toml"), Some(line)));
    let said = folder.call(&["check", "through.csv", "--scene", "a.toml", "-v"]);
    let told = format!("the scenario allows it (allowed_contact.tearing, a.toml:{line}:8)");
    assert!(said.stdout.contains(&told), "{}", said.stdout);
}

/// Contract: what moves is looked at though nobody holds it: an object that a file of samples carries through a block touches it, which the scene
/// allows, and the scenario's own question finds.
#[test]
fn an_object_that_a_movement_carries_is_judged_too() {
    let untouched = "\n[[criterion]]\nname = \"untouched\"\nkind = \"no_contact\"\nobjects = [\"block\"]\n";
    let objects = ["block", "toy", "table"].map(|name| {
        let column = |axis: &str| format!("object_{name}_{axis}");
        ["x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"].map(column).join(",")
    });
    let carried = |toy_y_m: [f64; 2]| {
        let row =
            |(time_s, y): (f64, f64)| format!("{time_s},0.6,0.4,0.12,1,0,0,0,1.2,0.9,0,0,0,0,1,1.2,{y},0.1,0,0,0,1,0.62,0.12,0,0,0,0,1\n");
        let heading = format!("time_s,x_m,y_m,z_m,qx,qy,qz,qw,{}\n", objects.join(","));
        heading + &row((0.0, toy_y_m[0])) + &row((0.5, toy_y_m[1]))
    };
    let (through, before) = (carried([0.6, 1.2]), carried([0.6, 0.7]));
    let scene = GOOD.to_owned() + untouched;
    let folder = Folder::with(&[("a.toml", scene.as_bytes()), ("through.csv", through.as_bytes()), ("before.csv", before.as_bytes())]);
    for (file, touches) in [("through.csv", true), ("before.csv", false)] {
        let said = folder.call(&["check", file, "--scene", "a.toml", "--format", "json", "-q"]);
        let report = json(&said)["checks"][0]["report"].clone();
        let criterion = entry(&report["criteria"], &[("name", "untouched")]);
        assert_eq!(criterion["as_expected"].as_bool(), Some(!touches), "{file}: {report:#}");
        assert_eq!(said.code, Some(if touches { 10 } else { 0 }), "{file}: {report:#}");
        if touches {
            let contact = entry(&report["collisions"], &[("a", "toy"), ("b", "block.base")]);
            assert_eq!(contact["reason"].as_str(), Some("objects may touch each other"), "{contact}");
        }
    }
}

/// Contract: a pose counts as reached when the tool is there and turned as asked; each says when it first is not.
#[test]
fn a_pose_that_is_reached_turned_away_is_not_reached() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    let scenario = Scenario::load(&folder.path().join("a.toml"), &LoadOptions::default()).unwrap_or_else(|faults| panic!("{faults}"));
    let Work::Arm(experiment) = scenario.work else { panic!("no arm") };
    let fine = JointExtreme { joint: "left_s0".to_owned(), value: 0.5, time_s: 0.0, first_failed_s: None };
    let judged = |reach: Reach| {
        let outcome = MotionOutcome {
            samples: 2,
            duration_s: 1.0,
            collisions: Vec::new(),
            clearances: Vec::new(),
            limit: fine.clone(),
            speed: fine.clone(),
            reach: Some(reach),
            far: None,
            robot_warnings: Vec::new(),
            warnings: Vec::new(),
        };
        let criteria = judge_motion(&outcome, &experiment, &[]);
        ["poses_reached", "orientations_reached"].map(|name| {
            let found = criteria.iter().find(|one| one.name == name).expect("asked");
            (found.passed, found.first_failed_time_s)
        })
    };
    let reach = Reach { position_error_m: 1e-4, position_failed_s: None, orientation_error_rad: 1e-3, orientation_failed_s: None };
    assert_eq!(judged(reach), [(true, None), (true, None)]);
    assert_eq!(judged(Reach { orientation_error_rad: 0.1, orientation_failed_s: Some(0.7), ..reach }), [(true, None), (false, Some(0.7))]);
    assert_eq!(judged(Reach { position_error_m: 0.1, position_failed_s: Some(0.2), ..reach }), [(false, Some(0.2)), (true, None)]);
}

/// A plate below the arm that holds still, its top at 0.02 m and as much higher as it is raised.
const SHELF: &str = r#"
[[object]]
name = "shelf"
kind = "box"
center_m = [0.7, -0.55]
size_m = [0.8, 0.4, 0.02]
mass_kg = 1
fixed = true

[[criterion]]
name = "idle_hand"
kind = "clearance"
objects = ["shelf"]
links = ["right_hand"]
min_m = 0.05
"#;

/// Contract: the arm that holds still has a distance to what stands still, by geometry and in the engine: over a plate, that of its lowest point
/// to the plate's top, so that it shrinks by as much as the plate is raised, and a criterion about it is judged.
#[test]
fn an_arm_that_holds_still_has_a_distance_to_what_stands_still() {
    let still = "-0.4347,-1.0645,-0.4138,1.934,0.2873,0.7587,1.3";
    let joints = ["s0", "s1", "e0", "e1", "w0", "w1", "w2"].map(|joint| format!("left_{joint}_rad")).join(",");
    let samples = format!("time_s,{joints}\n0,{still}\n1,{still}\n");
    let folder = Folder::with(&[("a.toml", format!("{GOOD}{SHELF}").as_bytes()), ("still.csv", samples.as_bytes())]);
    let asked = |arguments: &[&str], code: i32| {
        let said = folder.call(&[arguments, &["--format", "json", "-q"]].concat());
        assert_eq!(said.code, Some(code), "{}{}", said.stdout, said.stderr);
        let report: Value = serde_json::from_str(&said.stdout).expect("JSON");
        let criteria = report["checks"][0]["report"]["criteria"].as_array().expect("a list").clone();
        let found = criteria.into_iter().find(|one| one["name"] == "idle_hand").expect("asked");
        assert_eq!((found["status"].as_str(), found["passed"].as_bool()), (Some("judged"), Some(code == 0)), "{found}");
        found["value"].as_f64().expect("a distance")
    };
    let by_geometry = |raised: &str, code: i32| asked(&["check", "still.csv", "--scene", "a.toml", "--set", raised], code);
    let (low, middle) = (by_geometry("object.shelf.raised_m=-0.3", 0), by_geometry("object.shelf.raised_m=-0.2", 0));
    let high = by_geometry("object.shelf.raised_m=-0.1", 0);
    assert!((low - middle - 0.1).abs() < 1e-6 && (middle - high - 0.1).abs() < 1e-6, "{low} {middle} {high}");
    let near = by_geometry("object.shelf.raised_m=-0.05", 10);
    assert!((high - near - 0.05).abs() < 1e-6, "{high} {near}");
    let simulated = asked(&["check", "a.toml", "--set", "object.shelf.raised_m=-0.1"], 0);
    assert!((simulated - high).abs() < 2e-3, "held by its joints, it gives way a little: {simulated} instead of {high}");
}

/// Contract: samples that say where objects are say it of all that can move, and of a door that hangs on its hinge.
#[test]
fn objects_are_where_the_samples_say_or_are_refused() {
    let scenario = include_str!("../../scenarios/cabinet_door.toml");
    let cup = "\n[[object]]\nname = \"cup\"\nkind = \"cylinder\"\ncenter_m = [0.5, -0.6]\nradius_m = 0.03\nheight_m = 0.1\nmass_kg = 0.1\n";
    let table = "\n[[object]]\nname = \"desk\"\nkind = \"table\"\ncenter_m = [0.5, -0.6]\nsize_m = [0.2, 0.2]\ntop_height_m = 0.0\n";
    let folder = Folder::with(&[("a.toml", scenario.as_bytes()), ("b.toml", format!("{scenario}{table}{cup}").as_bytes())]);
    let Work::Arm(experiment) = Scenario::load(&folder.path().join("a.toml"), &LoadOptions::default()).expect("good").work else {
        panic!("no arm")
    };
    let hinge = experiment.objects[0].pose(&experiment.parameters, 0.0).translation;
    let rest: Vec<String> = experiment.robot.rest_posture_rad.iter().map(ToString::to_string).collect();
    let (counted, rest) = ((1..=rest.len()).map(|joint| format!("q{joint}_rad")).collect::<Vec<_>>().join(","), rest.join(","));
    let name = &experiment.objects[0].name;
    let place = ["x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"].map(|column| format!("{name}_{column}")).join(",");
    let door = |off_m: f64| {
        let row = |time_s: f64| format!("{time_s},{rest},{},{},{},0,0,0,1\n", hinge.x + off_m, hinge.y, hinge.z);
        let text = format!("time_s,{counted},{place}\n{}{}", row(0.0), row(1.0));
        std::fs::write(folder.path().join("x.csv"), text).expect("written");
    };
    let check = |scene: &str| folder.call(&["check", "x.csv", "--scene", scene]);
    door(0.0);
    let said = check("a.toml");
    assert_eq!(said.code, Some(0), "{}{}", said.stdout, said.stderr);
    let said = check("b.toml");
    assert!(said.code == Some(3) && said.stdout.contains("not where `cup` is, which can move"), "{}", said.stdout);
    door(0.01);
    let said = check("a.toml");
    assert!(said.code == Some(3) && said.stdout.contains("10.0 mm from the hinge"), "{}", said.stdout);
}

/// Contract: a name that nothing bears counts nothing, silently; so it is refused, wherever it stands.
#[test]
fn links_and_parts_that_do_not_exist_are_refused_by_name() {
    let odd = "\n[[allowed_contact]]\nname = \"tearing\"\na = \"left_hnd\"\nb = \"shelv\"\n";
    let text = format!("{GOOD}{SHELF}{odd}").replace("links = [\"right_hand\"]", "links = [\"right_hand\", \"right_hnd\"]");
    let folder = Folder::with(&[("a.toml", text.as_bytes())]);
    let said = folder.call(&["validate", "a.toml"]);
    assert_eq!(said.code, Some(3), "{}", said.stderr);
    let told = [
        ("right_hnd", "the robot has no link `right_hnd`, and the scene no object of that name; did you mean `right_hand`?"),
        ("left_hnd", "the robot has no link `left_hnd`"),
        ("shelv", "the robot has no link `shelv`, and the scene no object of that name; did you mean `shelf`?"),
    ];
    let check = folder.call(&["check", "a.toml"]);
    for (name, told) in told {
        let (line, column) = place(&text, &format!("\"{name}\""));
        let place = format!("a.toml:{line}:{column}");
        assert!(said.stderr.contains(told) && said.stderr.contains(&place), "{place}: {told}: {}", said.stderr);
        assert!(check.stdout.contains(&format!("{place}: error[scene]: {told}")), "{place}: {told}: {}", check.stdout);
    }
    let set = "criterion.idle_hand.links=[\"lft_hand\"]";
    let wrong = folder.call(&["validate", "a.toml", "--set", set]).stderr;
    assert!(wrong.contains("the robot has no link `lft_hand`") && wrong.contains("--set") && wrong.contains(set), "{wrong}");
}

/// Line and column, from 1, at which `needle` stands in `text`.
fn place(text: &str, needle: &str) -> (usize, usize) {
    let before = &text[..text.find(needle).expect("it stands there")];
    (before.matches('\n').count() + 1, before.rsplit('\n').next().expect("a line").chars().count() + 1)
}
