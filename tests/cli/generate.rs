//! `cpdmp generate`: movements from a skill file.

use std::process::Stdio;
use std::sync::OnceLock;

use serde_json::Value;

use super::learn::{learn, strokes};
use super::{Folder, cpdmp};
use crate::support::hand_made::stroke;

/// A folder with a skill of strokes, its parameters read off the start.
fn with_skill() -> Folder {
    static SKILL: OnceLock<Vec<u8>> = OnceLock::new();
    let skill = SKILL.get_or_init(|| {
        let folder = strokes();
        assert_eq!(learn(&folder, &["--theta", "start", "--out", "s.json"]).code, Some(0));
        std::fs::read(folder.path().join("s.json")).expect("written")
    });
    Folder::with(&[("s.json", skill)])
}

fn rows(csv: &str) -> Vec<Vec<f64>> {
    csv.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().expect("a number")).collect()).collect()
}

#[test]
fn an_unseen_start_point_is_enough_to_get_its_movement_on_stdout() {
    let said = with_skill().call(&["generate", "s.json", "--start", "x_m=0.23", "--start", "y_m=0.02", "--duration", "4"]);
    assert_eq!((said.code, said.stderr.as_str()), (Some(0), ""));
    assert!(said.stdout.starts_with("time_s,x_m,y_m\n"), "{}", said.stdout);
    let rows = rows(&said.stdout);
    assert_eq!((rows.len(), rows[0][0], rows[400][0]), (401, 0.0, 4.0));
    let off = |row: &Vec<f64>| stroke([0.23, 0.02], row[0] / 4.0).iter().zip(&row[1..]).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    let worst = rows.iter().map(off).fold(0.0, f64::max);
    assert!(worst < 0.03, "the stroke from there is 1 m long and met within {worst} m");
}

#[test]
fn a_start_of_one_column_leaves_the_others_as_learned() {
    let said = with_skill().call(&["generate", "s.json", "--start", "x_m=0.2", "--format", "json"]);
    let movement: Value = serde_json::from_str(&said.stdout).expect("JSON");
    assert_eq!((movement["start"][0].as_f64(), movement["columns"][1].as_str()), (Some(0.2), Some("x_m")));
    let y = movement["start"][1].as_f64().expect("a number");
    assert!((y - 0.025).abs() < 1e-3, "the middle of the starts that were shown, not {y}");
    assert_eq!(movement["rows"][0][1].as_f64(), Some(0.2));
}

#[test]
fn extrapolation_is_told_and_can_be_denied() {
    let folder = with_skill();
    let far = ["generate", "s.json", "--theta", "start_x_m=1.0", "--theta", "start_y_m=0.02"];
    let said = folder.call(&far);
    assert_eq!(said.code, Some(0));
    assert!(said.stderr.contains("warning") && said.stderr.contains("1.00 of its range"), "{}", said.stderr);
    let said = folder.call(&[&far[..], &["--deny-extrapolation", "0.5", "--out", "a.csv"]].concat());
    assert_eq!((said.code, said.stdout.as_str()), (Some(10), ""), "{}", said.stderr);
    assert_eq!(folder.names(), ["s.json"]);
    assert_eq!(folder.call(&[&far[..], &["--deny-extrapolation", "1.5", "--quiet"]].concat()).stderr, "");
}

#[test]
fn all_slips_of_a_call_are_told_at_once() {
    let said = with_skill().call(&[
        "generate",
        "s.json",
        "--theta",
        "start_x=1",
        "--start",
        "y_m=nan",
        "--goal",
        "z_m=1",
        "--goal",
        "x_m",
        "--dt",
        "0",
        "--duration",
        "-1",
        "--until",
        "inf",
        "--expected-wrench",
    ]);
    assert_eq!((said.code, said.stdout.as_str()), (Some(2), ""));
    for part in [
        "did you mean `start_x_m`",
        "`nan` is not a finite number",
        "no `z_m`; known: [x_m, y_m]",
        "--goal x_m: no `=`",
        "--dt is 0",
        "--duration is -1",
        "--until is inf",
        "no force model",
    ] {
        assert!(said.stderr.contains(part), "{part}: {}", said.stderr);
    }
}

#[test]
fn samples_go_to_files_that_are_ours_or_free() {
    let folder = with_skill();
    let call = |out: &str| folder.call(&["generate", "s.json", "--start", "x_m=0.1", "--covariance", "--out", out]);
    for out in ["a.csv", "a.csv", "a.parquet", "a.parquet"] {
        let said = call(out);
        assert_eq!((said.code, said.stdout.as_str()), (Some(0), ""), "{}", said.stderr);
    }
    let [csv, parquet] = ["a.csv", "a.parquet"].map(|name| cpdmp::demonstration::read_trajectory(&folder.path().join(name)).expect("read"));
    assert_eq!(csv, parquet);
    assert_eq!(csv.columns(), ["x_m", "y_m", "std_x_m", "std_y_m"]);
    assert!(csv.select(&["std_x_m", "std_y_m"]).expect("there").iter().all(|std| *std > 0.0));
    std::fs::write(folder.path().join("notes.csv"), "years,of,work\n").expect("written");
    assert_eq!((call("notes.csv").code, call("a.txt").code), (Some(20), Some(2)));
    assert_eq!(std::fs::read_to_string(folder.path().join("notes.csv")).expect("there"), "years,of,work\n");
}

#[test]
#[cfg(unix)]
fn a_reader_who_leaves_is_no_error_and_a_full_disk_is_one() {
    let folder = with_skill();
    let command = || {
        let mut command = std::process::Command::new(cpdmp().get_program());
        command.current_dir(folder.path()).args(["generate", "s.json", "--start", "x_m=0.1", "--dt", "0.0001"]).stderr(Stdio::piped());
        command
    };
    let mut child = command().stdout(Stdio::piped()).spawn().expect("started");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("ended");
    assert_eq!((output.status.code(), output.stderr.len()), (Some(0), 0));
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("there");
    assert_eq!(command().stdout(full).status().expect("ended").code(), Some(20));
}

/// Contract: an end's orientation is four components, of any length; the movement starts and settles there. Slips are told.
#[test]
fn a_movement_starts_and_ends_with_the_orientation_asked_for() {
    let mut csv = String::from("time_s,repetition,x_m,qx,qy,qz,qw\n");
    for (demonstration, i) in (0..3).flat_map(|demonstration| (0..101).map(move |i| (demonstration, i))) {
        let s = (f64::from(i) / 100.0).powi(3) * (10.0 + f64::from(i) / 100.0 * (f64::from(i) * 0.06 - 15.0));
        // It turns by 1 rad about the vertical axis.
        let (z, w) = (0.5 * s).sin_cos();
        csv += &format!("{},{demonstration},{},0,0,{z},{w}\n", f64::from(i) * 0.02, s + 0.1 * f64::from(demonstration) * (1.0 - s));
    }
    let folder = Folder::with(&[("d.csv", csv.as_bytes())]);
    let said = folder.call(&["learn", "d.csv", "--theta", "start", "--out", "s.json"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    let generate = |ends: &[&str]| folder.call(&[&["generate", "s.json", "--start", "x_m=0.1", "--until", "1.5"], ends].concat());
    let turned_rad = |row: &[f64]| 2.0 * row[4].atan2(row[5]);
    let (z, w) = 0.75_f64.sin_cos();
    let [goal_z, goal_w] = [format!("qz={}", 3.0 * z), format!("qw={}", 3.0 * w)];
    let asked = ["--goal", "qx=0", "--goal", "qy=0", "--goal", &goal_z, "--goal", &goal_w];
    for (ends, from, to) in [
        (&[][..], 0.0, 1.0),
        (&asked, 0.0, 1.5),
        (
            &["--start", "qx=0", "--start", "qy=0", "--start", "qz=0.5", "--start", "qw=0.8660254037844386"],
            std::f64::consts::FRAC_PI_3,
            1.0,
        ),
    ] {
        let said = generate(ends);
        assert_eq!(said.code, Some(0), "{}", said.stderr);
        let rows = rows(&said.stdout);
        assert!((turned_rad(&rows[0]) - from).abs() < 0.01, "starts at {} rad, not {from}", turned_rad(&rows[0]));
        let last = rows.last().expect("samples");
        assert!((turned_rad(last) - to).abs() < 0.01, "ends at {} rad, not {to}", turned_rad(last));
    }
    let said = generate(&["--goal", "qx=0", "--goal", "qw=1", "--start", "qx=0", "--start", "qy=0", "--start", "qz=0", "--start", "qw=0"]);
    assert_eq!((said.code, said.stdout.as_str()), (Some(2), ""));
    for told in ["--goal: an orientation has four components; missing: qy, qz", "--start: qx, qy, qz, qw are all zero"] {
        assert!(said.stderr.contains(told), "{}", said.stderr);
    }
}
