//! A planar experiment from the command line to its files: what is printed, what is written, and that it can be repeated.

use std::fs::{self, File};
use std::path::Path;

use parquet::file::reader::SerializedFileReader;
use parquet::record::RowAccessor;
use serde_json::Value;

use super::Folder;
use super::program::names;

const SHIPPED: &str = include_str!("../../scenarios/obstacle_avoidance.toml");

fn shipped() -> Folder {
    Folder::with(&[("a.toml", SHIPPED.as_bytes())])
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("JSON")
}

#[test]
fn a_planar_run_tells_the_same_everywhere_and_can_be_repeated() {
    let folder = shipped();
    let first = folder.call(&["run", "a.toml", "--color", "never"]);
    assert_eq!(first.code, Some(0), "{}{}", first.stdout, first.stderr);
    for words in ["obstacle_avoidance, seed 0: passed", "goal_x_m = -2", "beyond", "lwr dmp", " *", "!"] {
        assert!(first.stdout.contains(words), "{words} in {}", first.stdout);
    }
    let run = folder.path().join("runs/obstacle_avoidance-0");
    let mut written = names(&run);
    written.retain(|name| name != "recording.rrd");
    let files = ["demonstrations", "figures", "manifest.json", "paths.parquet", "report.json", "scenario.toml"];
    assert_eq!(written, [&files[..], &["skill.json", "skill_lwr_dmp_one_side.json", "state_hashes.parquet"]].concat());
    assert_eq!(run.join("recording.rrd").exists(), cfg!(feature = "rerun"));
    let figures = names(&run.join("figures"));
    let pictures: &[&str] =
        if cfg!(feature = "png") { &["forcing.png", "forcing.svg", "paths.png", "paths.svg"] } else { &["forcing.svg", "paths.svg"] };
    assert_eq!(figures, pictures);
    for name in figures.iter().filter(|name| name.ends_with(".svg")) {
        let text = fs::read_to_string(run.join("figures").join(name)).expect("a figure");
        assert!(roxmltree::Document::parse(&text).expect("well-formed").descendants().any(|e| e.has_tag_name("polyline")), "{name}");
    }
    let report = json(&fs::read_to_string(run.join("report.json")).expect("written"));
    // The shipped scenario has no start by k-means: both by time slices are left.
    assert_eq!(report["learning"]["starts"], 2, "{}", report["learning"]);
    let hash = |text: &str| json(text)["state_hash"].as_str().expect("a hash").to_owned();
    let report = fs::read_to_string(run.join("report.json")).expect("written");
    for arguments in [&["run", "a.toml", "--jobs", "1"][..], &["run", "runs/obstacle_avoidance-0/scenario.toml", "--out", "resolved"]] {
        let again = folder.call(&[arguments, &["--format", "json", "-q"]].concat());
        assert_eq!((again.code, hash(&again.stdout)), (Some(0), hash(&report)), "{arguments:?}");
    }
    let other = folder.call(&["run", "a.toml", "--seed", "1", "--format", "json", "-q"]);
    assert_ne!(hash(&other.stdout), hash(&report), "another seed is another run");
}

/// The skill of a run needs nothing of the run: what `generate` makes of it is the stored path, to what a CSV file keeps.
#[test]
fn the_skill_of_a_run_makes_the_path_of_the_run() {
    let folder = shipped();
    assert_eq!(folder.call(&["run", "a.toml", "-q", "--out", "run", "--set", "recording.rrd=false"]).code, Some(0));
    assert!(!folder.path().join("run/recording.rrd").exists(), "it was switched off");
    let path = stored(&folder.path().join("run/paths.parquet")).into_iter();
    let path = path.filter(|(method, setting, _)| method == "cpdmp" && setting == "goal_x_m = -1").map(|(.., points)| points).next();
    let path = path.expect("a path");
    let skill = json(&fs::read_to_string(folder.path().join("run/skill.json")).expect("written"));
    let dt = (skill["motion"]["duration_s"].as_f64().expect("a number") / (path.len() - 1) as f64).to_string();
    let ends = ["--start", "x_m=0", "--start", "y_m=-4", "--goal", "x_m=-1", "--goal", "y_m=4"];
    let asked = [&["generate", "run/skill.json", "--theta", "goal_x_m=-1", "--dt", &dt, "--out", "path.csv"], &ends[..]].concat();
    let said = folder.call(&asked);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    let text = fs::read_to_string(folder.path().join("path.csv")).expect("written");
    let rows: Vec<Vec<f64>> =
        text.lines().skip(1).map(|line| line.split(',').map(|word| word.parse().expect("a number")).collect()).collect();
    assert!(rows.len() >= path.len(), "{} rows", rows.len());
    for (row, point) in rows.iter().zip(&path) {
        assert!((row[1] - point[0]).hypot(row[2] - point[1]) < 1e-9, "{row:?} and {point:?}");
    }
}

/// The clearances of the report, computed again from the stored paths: every piece of a path in 5 steps, its distance to 4000 points of the
/// ellipse. Such a distance is too large by less than a rim's step and half a path's step across: 3 mm for these sizes.
#[test]
fn clearances_are_those_of_the_stored_paths() {
    let folder = shipped();
    assert_eq!(folder.call(&["run", "a.toml", "-q", "--out", "run"]).code, Some(0));
    let report = json(&fs::read_to_string(folder.path().join("run/report.json")).expect("written"));
    let paths = stored(&folder.path().join("run/paths.parquet"));
    let mut compared = 0;
    for setting in report["comparison"]["settings"].as_array().expect("settings") {
        for result in setting["results"].as_array().expect("results") {
            let of = |name: &str, text: &Value| text.as_str() == Some(name);
            let path = paths.iter().find(|(method, name, _)| of(method, &result["method"]) && of(name, &setting["name"])).expect("a path");
            let told = result["clearance_m"].as_f64().expect("a number");
            let found = brute_force(&path.2, [1.0, 0.5]);
            assert!((told - found).abs() < 3e-3, "{} {}: {told} and {found}", setting["name"], result["method"]);
            assert_eq!(result["collides"].as_bool(), Some(told <= 0.0));
            compared += 1;
        }
    }
    assert_eq!(compared, 18, "nine settings, two methods");
}

/// The paths of a path log: method, setting, points (m).
fn stored(path: &Path) -> Vec<(String, String, Vec<[f64; 2]>)> {
    let rows = SerializedFileReader::new(File::open(path).expect("written")).expect("Parquet").into_iter();
    let mut paths: Vec<(String, String, Vec<[f64; 2]>)> = Vec::new();
    for row in rows.map(|row| row.expect("a row")) {
        let text = |column| row.get_string(column).expect("text").clone();
        let point = [3, 4].map(|column| row.get_double(column).expect("a number"));
        match paths.last_mut().filter(|(method, setting, _)| (method, setting) == (&text(0), &text(1))) {
            Some((_, _, points)) => points.push(point),
            None => paths.push((text(0), text(1), vec![point])),
        }
    }
    paths
}

fn brute_force(path: &[[f64; 2]], half: [f64; 2]) -> f64 {
    let rim: Vec<[f64; 2]> =
        (0..4000).map(|i| std::f64::consts::TAU * f64::from(i) / 4000.0).map(|a| [half[0] * a.cos(), half[1] * a.sin()]).collect();
    let mut least = f64::INFINITY;
    for pair in path.windows(2).filter(|pair| pair[0][1].abs() < 3.0) {
        for t in (0..5).map(|i| f64::from(i) / 5.0) {
            let p = [0, 1].map(|axis| pair[0][axis] + t * (pair[1][axis] - pair[0][axis]));
            let distance = rim.iter().map(|q| (p[0] - q[0]).hypot(p[1] - q[1])).fold(f64::INFINITY, f64::min);
            let inside = (p[0] / half[0]).powi(2) + (p[1] / half[1]).powi(2) < 1.0;
            least = least.min(if inside { -distance } else { distance });
        }
    }
    least
}

#[test]
fn keys_of_arms_and_faulty_keys_are_told() {
    let folder = shipped();
    for (typed, told) in [
        ("robot.urdf=builtin:baxter", "`robot` is about an arm"),
        ("parameters.a_m=1", "`parameters` is about an arm"),
        ("learning.shaping=lwr", "`learning.shaping` means nothing for a planar experiment, which decides it itself"),
        ("learning.orientation_basis=20", "`learning.orientation_basis` means nothing for a planar experiment, which has no such thing"),
        ("learning.force.states=5", "`learning.force` means nothing for a planar experiment"),
        ("learning.compliance.statistic=literal", "`learning.compliance` means nothing for a planar experiment"),
        ("coupling.enabled=true", "`coupling` is about an arm"),
        ("planar.kind=circle", "`planar.kind` cannot be `circle`"),
        ("planar.taught_goal_x_m=[1]", "did you mean `taught_goals_x_m`?"),
        ("planar.hand.noise_m=-1", "expected 0 … 0.1 m"),
        ("planar.taught_goals_x_m=[1.0, 1.0]", "taught_goals_x_m"),
        ("criterion.cpdmp_clear_beyond.method=dmp", "expected one of `cpdmp`"),
    ] {
        for command in ["validate", "run"] {
            let said = folder.call(&[command, "a.toml", "--set", typed]);
            assert_eq!(said.code, Some(3), "{command} {typed}: {}{}", said.stdout, said.stderr);
            assert!(said.stderr.contains(told), "{command} {typed}: {}", said.stderr);
        }
    }
    assert!(!folder.path().join("runs/obstacle_avoidance-0").exists(), "nothing was written");
}

#[test]
fn planar_criteria_of_an_arm_are_told() {
    let said = Folder::with_change("kind = \"goal_reached\"\nmax_m = 0.02", "kind = \"planar_collides\"\nmethod = \"cpdmp\"").refused();
    assert!(said.contains("has nothing to judge here"), "{said}");
}
