//! What is wrong is told all at once, each at its place, once, however often it is met.

use std::collections::BTreeSet;

use serde_json::Value;

use super::{Folder, GOOD, Said};

const ROBOT: &str = include_str!("../../assets/baxter/baxter.urdf");

fn json(said: &Said) -> Value {
    serde_json::from_str(&said.stdout).unwrap_or_else(|_| panic!("{}{}", said.stdout, said.stderr))
}

/// The number, from 1, of the line number `count` with these words.
fn line_of(text: &str, words: &str, count: usize) -> u64 {
    let mut lines = text.lines().enumerate().filter(|(_, line)| line.contains(words));
    lines.nth(count).expect("it is there").0 as u64 + 1
}

fn lines(told: &Value) -> Vec<u64> {
    let found = told["diagnostics"].as_array().expect("a list");
    found.iter().map(|found| found["line"].as_u64().unwrap_or_else(|| panic!("no line: {found}"))).collect()
}

fn changed(pairs: &[(&str, &str)]) -> String {
    pairs.iter().fold(GOOD.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "there is no {from}");
        text.replacen(from, to, 1)
    })
}

/// Contract: a misspelt link, an object beside the table and two way-points out of reach are four faults at four lines, in every command that would
/// need them; whatever the number of lessons.
#[test]
fn names_scene_and_way_are_told_together() {
    let allowed = "\n[[allowed_contact]]\nname = \"a\"\na = \"left_hnd\"\nb = \"table\"\n";
    let text = changed(&[
        ("center_m = [0.6, 0.1]", "center_m = [0.6, 0.9]"),
        ("offset_m = [0.6, 0.4, 0.1]", "offset_m = [2.6, 0.4, 0.1]"),
        ("offset_m = [0.0, 0.0, 0.1]", "offset_m = [2.0, 0.0, 0.1]"),
    ]) + allowed;
    let folder = Folder::with(&[("a.toml", text.as_bytes())]);
    let told = json(&folder.call(&["validate", "a.toml", "--format", "json"]));
    let way_point = |count| line_of(&text, "[[teaching.waypoint]]", count);
    let expected = [line_of(&text, "name = \"toy\"", 0), way_point(0), way_point(1), line_of(&text, "left_hnd", 0)];
    assert_eq!((lines(&told), &told["error"]), (expected.to_vec(), &Value::Null), "{told:#}");
    assert!(told["diagnostics"][3]["message"].as_str().is_some_and(|told| told.contains("did you mean `left_hand`?")), "{told:#}");
    for command in [&["run", "a.toml"][..], &["check", "a.toml"], &["teach", "a.toml", "--out", "lessons"]] {
        let said = folder.call(command);
        for line in expected {
            assert!(said.code == Some(3) && said.stderr.contains(&format!("a.toml:{line}:")), "{command:?}, line {line}: {}", said.stderr);
        }
    }
}

/// Contract: a way-point that cannot be reached does not hide what is inside something else.
#[test]
fn a_way_out_of_reach_hides_no_overlap() {
    let inside = ("center_m = [1.2, 0.9]", "center_m = [0.6, 0.12]");
    let first = ("offset_m = [0.6, 0.4, 0.1]", "offset_m = [2.6, 0.4, 0.1]");
    let second = ("offset_m = [0.0, 0.0, 0.1]", "offset_m = [2.0, 0.0, 0.1]");
    for (changes, way_points) in [(&[inside, second][..], &[1][..]), (&[inside, first, second], &[0, 1])] {
        let text = changed(changes);
        let folder = Folder::with(&[("a.toml", text.as_bytes())]);
        let told = json(&folder.call(&["validate", "a.toml", "--format", "json"]));
        let found: BTreeSet<u64> = lines(&told).into_iter().collect();
        let way_points = way_points.iter().map(|number| line_of(&text, "[[teaching.waypoint]]", *number));
        let expected: BTreeSet<u64> = way_points.chain([line_of(&text, "name = \"block\"", 0)]).collect();
        assert!(found.is_superset(&expected), "{expected:?}: {told:#}");
    }
}

/// Contract: an arm in itself is told once for every pair, not once for every lesson, and at the posture that nobody leads.
#[test]
fn what_every_lesson_meets_is_told_once() {
    let text = GOOD.to_owned() + "\n[robot]\nidle_posture_rad = [1.6, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]\n";
    let folder = Folder::with(&[("a.toml", text.as_bytes())]);
    let told = json(&folder.call(&["validate", "a.toml", "--format", "json"]));
    let found = told["diagnostics"].as_array().expect("a list");
    assert!(!found.is_empty() && told["error"].is_null(), "{told:#}");
    for one in found {
        assert_eq!(one["line"].as_u64(), Some(line_of(&text, "idle_posture_rad", 0)), "{one}");
        assert!(one["message"].as_str().is_some_and(|told| told.starts_with("lesson 1: ")), "{one}");
    }
}

/// Contract: a tool that the robot has not is told at its key, with what was meant.
#[test]
fn tools_that_are_not_there_are_told_at_their_keys() {
    let text = GOOD.to_owned() + "\n[robot]\ntool_link = \"left_gripper_tipp\"\nidle_tool_link = \"right_hnd\"\n";
    let folder = Folder::with(&[("a.toml", text.as_bytes())]);
    let told = json(&folder.call(&["validate", "a.toml", "--format", "json"]));
    assert_eq!(lines(&told), ["\ntool_link", "idle_tool_link"].map(|key| line_of(&text, key.trim(), 0)), "{told:#}");
    assert!(told["diagnostics"][1]["message"].as_str().is_some_and(|told| told.contains("did you mean `right_hand`?")), "{told:#}");
}

/// Contract: what is odd about a robot has its line wherever a fault has one, and is told once.
#[test]
fn oddities_of_a_robot_have_their_lines() {
    let start = ROBOT.find("upper=\"").expect("there") + "upper=\"".len();
    let end = start + ROBOT[start..].find('"').expect("there");
    let odd = format!("{}170{}", &ROBOT[..start], &ROBOT[end..]);
    let line = line_of(&odd, "upper=\"170\"", 0);
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("r.urdf", odd.as_bytes())]);
    let validated = json(&folder.call(&["validate", "a.toml", "--robot", "r.urdf", "--format", "json"]));
    let found = validated["diagnostics"].as_array().expect("a list");
    assert_eq!((found.len(), &found[0]["file"], &found[0]["severity"]), (1, &"r.urdf".into(), &"warning".into()), "{validated:#}");
    assert!(found[0]["line"].as_u64().is_some_and(|told| told.abs_diff(line) <= 3), "near line {line}: {validated:#}");
    let said = folder.call(&["validate", "a.toml", "--robot", "r.urdf", "--deny-warnings"]);
    assert!(said.code == Some(3) && said.stdout.contains("1 fault"), "{}{}", said.stdout, said.stderr);
    let said = folder.call(&["check", "a.toml", "--robot", "r.urdf", "--format", "github"]);
    assert_eq!(said.stdout.matches("looks like degrees").count(), 1, "{}", said.stdout);
    assert!(said.stdout.contains("::warning file=r.urdf,line="), "{}", said.stdout);
    let said = folder.call(&["check", "a.toml", "--robot", "r.urdf", "--format", "junit"]);
    assert_eq!(said.stdout.matches("looks like degrees").count(), 1, "{}", said.stdout);
}

/// Contract: what is odd about a scenario is told once in every format.
#[test]
fn a_warning_is_told_once() {
    let unasked = &GOOD[..GOOD.find("[[criterion]]").expect("there")];
    let folder = Folder::with(&[("a.toml", unasked.as_bytes())]);
    for format in ["github", "junit"] {
        let said = folder.call(&["check", "a.toml", "--format", format]);
        assert_eq!(said.stdout.matches("without a criterion").count(), 1, "{format}: {}", said.stdout);
    }
}

/// Contract: a small file with very many faults is refused like any other: the first are told, and the rest is counted.
#[test]
fn thousands_of_faults_are_counted() {
    let broken = ROBOT.replace("</robot>", &format!("{}</robot>", "<link/>\n".repeat(5000)));
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("r.urdf", broken.as_bytes())]);
    let told = json(&folder.call(&["validate", "a.toml", "--robot", "r.urdf", "--format", "json"]));
    let found = told["diagnostics"].as_array().expect("a list");
    assert_eq!(found.len(), 101, "{}", found.len());
    let last = &found[100];
    let more = last["message"].as_str().and_then(|told| told.strip_prefix("and ")?.strip_suffix(" more")?.parse::<u32>().ok());
    assert!(last["code"] == "more" && more.is_some_and(|more| more >= 4900), "every one of the links is a fault: {last}");
}

/// Contract: faults of recorded demonstrations are told in the file and line in which they stand.
#[test]
fn faults_of_data_stand_in_the_data() {
    let (before, after) = GOOD.split_once("[teaching]").expect("there");
    let rest = after.split_once("[learning]").expect("there").1;
    let text = before.replacen("name = \"good\"", "name = \"good\"\ndemonstrations = \"lessons\"", 1) + "[learning]" + rest;
    let row = |time: &str, x: &str| format!("{time},{x},0.1,0.2\n");
    let samples = format!("time_s,x_m,y_m,z_m\n{}{}{}", row("0.0", "0.5"), row("0.1", "nan"), row("0.1", "0.6"));
    let list = "schema_version = 1\nmotion = [\"x_m\", \"y_m\", \"z_m\"]\n\n[[demonstration]]\nfile = \"a.csv\"\ntheta_m = { block_height_m = 0.2 }\n";
    let files = [("a.toml", text.as_bytes()), ("lessons/dataset.toml", list.as_bytes()), ("lessons/a.csv", samples.as_bytes())];
    let folder = Folder::with(&files);
    let told = json(&folder.call(&["check", "a.toml", "--format", "json", "-q"]));
    let faults = told["checks"][0]["faults"].as_array().expect("a list").clone();
    assert!(!faults.is_empty(), "{told:#}");
    let validated = json(&folder.call(&["validate", "a.toml", "--format", "json"]));
    let diagnostics = validated["diagnostics"].as_array().expect("a list");
    assert_eq!((diagnostics.len(), &validated["error"]), (faults.len(), &Value::Null), "{validated:#}");
    for fault in faults.iter().chain(diagnostics) {
        assert_eq!((&fault["code"], &fault["file"]), (&"dataset".into(), &"lessons/a.csv".into()), "{fault}");
        assert!(fault["line"].as_u64().is_some_and(|line| line == 3 || line == 4), "{fault}");
    }
    let said = folder.call(&["run", "a.toml"]);
    assert!(said.code == Some(3) && said.stderr.contains("0.1,nan,0.1,0.2"), "the line is shown: {}", said.stderr);
}
