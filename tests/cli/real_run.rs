//! A short run from the command line to its files: what is printed, what is written, and that it can be repeated.

use std::fs;

use serde_json::Value;

use super::program::{Said, names};
use super::{Folder, GOOD};

fn good() -> Folder {
    Folder::with(&[("a.toml", GOOD.as_bytes())])
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("JSON")
}

fn hash(said: &Said) -> String {
    json(&said.stdout)["state_hash"].as_str().expect("a hash").to_owned()
}

/// Contract: the terminal, stdout for programs and the folder tell the same; nothing but the run's folder is left; the resolved scenario and
/// the written dataset are worth as much as what they came from.
#[test]
fn a_run_tells_the_same_everywhere_and_can_be_repeated() {
    let folder = good();
    let first = folder.call(&["run", "a.toml", "--color", "never"]);
    assert_eq!(first.code, Some(0), "{}{}", first.stdout, first.stderr);
    assert!(first.stdout.starts_with("good, seed 0: passed\n"), "{}", first.stdout);
    assert!(first.stderr.contains("teach") && first.stderr.contains("written to runs/good-0"), "{}", first.stderr);
    let run = folder.path().join("runs/good-0");
    let report = json(&fs::read_to_string(run.join("report.json")).expect("written"));
    let state_hash = report["state_hash"].as_str().expect("a hash");
    assert!(first.stdout.contains(state_hash));
    assert_eq!(report["criteria"][0]["as_expected"].as_bool(), Some(true));
    let mut written = names(&run);
    // Absent when the program is built without the feature `rerun`.
    written.retain(|name| name != "recording.rrd");
    assert_eq!(
        written,
        [
            "demonstrations",
            "figures",
            "manifest.json",
            "report.json",
            "scenario.toml",
            "skill.json",
            "snapshots.bin",
            "state_hashes.parquet",
            "steps.parquet"
        ]
    );
    assert_eq!(names(&folder.path().join("runs")), ["good-0"]);

    for path in ["runs/good-0", "runs/good-0/manifest.json"] {
        let inspected = folder.call(&["inspect", path, "--format", "json"]);
        assert_eq!(inspected.code, Some(0), "{}", inspected.stderr);
        let found = json(&inspected.stdout);
        assert_eq!(
            (&found["kind"], &found["run"]["scenario"], &found["run"]["outcome"]),
            (&"run".into(), &"good".into(), &"passed".into())
        );
        assert_eq!(found["run"]["state_hash"].as_str(), Some(state_hash), "{found}");
    }

    let again = folder.call(&["run", "a.toml", "--format", "json", "--jobs", "1", "-q"]);
    assert_eq!((again.code, again.stderr.as_str()), (Some(0), ""));
    assert_eq!(hash(&again), state_hash, "the same run, on another number of threads");

    let resolved = folder.call(&["run", "runs/good-0/scenario.toml", "--out", "resolved", "--format", "json"]);
    assert_eq!(resolved.code, Some(0), "{}", resolved.stderr);
    assert_eq!(hash(&resolved), state_hash, "the resolved scenario is the scenario");
    let validated = folder.call(&["validate", "runs/good-0/scenario.toml"]);
    assert_eq!((validated.code, validated.stderr.as_str()), (Some(0), ""), "and no odder than it");

    let other = folder.call(&["run", "a.toml", "--format", "json", "--seed", "1"]);
    assert_ne!(hash(&other), state_hash, "another seed is another run");
    assert!(folder.path().join("runs/good-1/report.json").exists());
}

/// Contract: the figures of a stored run are those that the run drew, byte for byte, also when the folder has been moved.
#[test]
fn figures_are_drawn_again_from_the_folder_alone() {
    let folder = good();
    assert_eq!(folder.call(&["run", "a.toml", "--out", "run", "-q"]).code, Some(0));
    let place = folder.path().join("moved");
    fs::rename(folder.path().join("run"), &place).expect("moved");
    fs::remove_file(folder.path().join("a.toml")).expect("removed");
    let figures = |folder: &std::path::Path| -> Vec<(String, Vec<u8>)> {
        names(folder).into_iter().map(|name| (name.clone(), fs::read(folder.join(name)).expect("a figure"))).collect()
    };
    let first = figures(&place.join("figures"));
    assert_eq!(first.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), figure_files());
    let said = folder.call(&["figures", "moved", "--out", "again"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert!(figure_files().iter().all(|name| said.stdout.contains(&format!("again/{name}\n"))), "{}", said.stdout);
    assert!(figures(&folder.path().join("again")) == first, "the bytes differ");
    fs::remove_dir_all(place.join("figures")).expect("removed");
    let said = folder.call(&["figures", "moved", "--format", "json"]);
    assert_eq!((said.code, json(&said.stdout)["figures"][0].as_str()), (Some(0), Some("motion.svg")), "{}", said.stderr);
    assert!(figures(&place.join("figures")) == first, "the bytes differ");

    // Files of two runs are no run.
    let scenario = fs::read_to_string(place.join("scenario.toml")).expect("text");
    fs::write(place.join("scenario.toml"), scenario.replacen("seed = 0", "seed = 1", 1)).expect("written");
    let said = folder.call(&["figures", "moved"]);
    assert!(said.code == Some(3) && said.stderr.contains("not the scenario that was run"), "{}", said.stderr);
    fs::write(place.join("scenario.toml"), scenario).expect("written");
    let skill = fs::read_to_string(place.join("skill.json")).expect("text");
    fs::write(place.join("skill.json"), skill + "\n").expect("written");
    let said = folder.call(&["figures", "moved"]);
    assert!(said.code == Some(3) && said.stderr.contains("skill.json: this is not the file that the run wrote"), "{}", said.stderr);
    fs::remove_file(place.join("steps.parquet")).expect("removed");
    for (arguments, words) in [(["figures", "moved"], "steps.parquet"), (["figures", "again"], "manifest.json")] {
        let said = folder.call(&arguments);
        assert_eq!(said.code, Some(3), "{}", said.stderr);
        assert!(said.stderr.contains(words), "{}", said.stderr);
    }
}

/// The files of a run's figures: drawings and, with the feature `png`, pictures.
fn figure_files() -> Vec<String> {
    let kinds: &[&str] = if cfg!(feature = "png") { &["png", "svg"] } else { &["svg"] };
    let figures = ["compliance", "forces", "forcing", "forcing_settings", "motion", "paths", "states"];
    let mut files: Vec<String> = figures.iter().flat_map(|name| kinds.iter().map(move |kind| format!("{name}.{kind}"))).collect();
    files.sort();
    files
}

#[test]
fn a_recorded_dataset_stands_for_the_teaching() {
    let folder = good();
    assert_eq!(folder.call(&["run", "a.toml", "--out", "taught", "-q"]).code, Some(0));
    let said = folder.call(&["run", "a.toml", "--set", "demonstrations=taught/demonstrations", "--format", "json"]);
    assert_eq!(said.code, Some(0), "{}{}", said.stdout, said.stderr);
    let phases = json(&said.stdout)["phases"].as_array().expect("a list").iter().map(|phase| phase["name"].clone()).collect::<Vec<_>>();
    assert_eq!(phases, ["learn", "execute"]);

    // And they can be judged as movements: that they tell the arm by its joints and by its tool is no contradiction. Their list is no scenario.
    let said = folder.call(&["check", "taught/demonstrations", "--scene", "a.toml", "--format", "json", "-q"]);
    let checks = json(&said.stdout)["checks"].as_array().expect("a list").clone();
    assert_eq!(checks.len(), 3, "{checks:#?}");
    for check in checks {
        assert_eq!((check["kind"].as_str(), check["faults"].as_array().map(Vec::len)), (Some("trajectory"), Some(0)), "{check:#}");
        assert_eq!(check["report"]["warnings"].as_array().map(Vec::len), Some(0), "{check:#}");
    }
    let said = folder.call(&["check", "taught/demonstrations"]);
    assert!(said.code == Some(5) && said.stderr.contains("say with --scene"), "{}", said.stderr);
}

/// Contract: taught demonstrations hold tool and joints, so that one dataset serves a skill of either.
#[test]
fn a_skill_of_the_joints_runs_like_one_of_the_tool() {
    let folder = good();
    let joints = ["--set=learning.space=joint", "--set=coupling.space=joint", "--set=coupling.enabled=true", "--format=json", "-q"];
    let taught = folder.call(&[&["run", "a.toml", "--out", "taught"], &joints[..]].concat());
    assert_eq!(taught.code, Some(0), "{}{}", taught.stdout, taught.stderr);
    let recorded = ["run", "a.toml", "--out", "again", "--set", "demonstrations=taught/demonstrations"];
    for more in [&joints[..], &["--format=json", "-q"]] {
        let said = folder.call(&[&recorded[..], more].concat());
        assert_eq!(said.code, Some(0), "{}{}", said.stdout, said.stderr);
        let goal = json(&said.stdout)["criteria"][0]["value"].as_f64().expect("a distance");
        assert!(goal < 0.01, "{goal} m from the goal");
    }
}

#[test]
fn what_is_expected_decides_the_outcome() {
    let folder = good();
    let missed = ["--set", "criterion.goal.max_m=0"];
    let run = |more: &[&str]| folder.call(&[&["run", "a.toml", "--format", "json", "-q"], &missed[..], more].concat());
    let said = run(&[]);
    assert_eq!(said.code, Some(10), "{}", said.stderr);
    let report = json(&said.stdout);
    assert_eq!((report["outcome"].as_str(), report["exit_code"].as_i64()), (Some("criteria_not_met"), Some(10)));
    assert!(report["criteria"][0]["margin"].as_f64().expect("a number") < 0.0);
    assert_eq!(run(&["--set", "criterion.goal.expect=fail"]).code, Some(0));
    assert_eq!(run(&["--set", "criterion.goal.expect=report"]).code, Some(0));
}

#[test]
fn what_cannot_be_learned_ends_with_4_and_a_report() {
    let folder = good();
    let said = folder.call(&["run", "a.toml", "--set", "learning.motion.states=200", "--set", "learning.rate_hz=1"]);
    assert_eq!(said.code, Some(4), "{}", said.stderr);
    let report = json(&fs::read_to_string(folder.path().join("runs/good-0/report.json")).expect("written"));
    assert_eq!(report["outcome"].as_str(), Some("learning_failed"));
    assert!(report["error"].as_str().is_some_and(|error| error.contains("200 states")), "{report}");
}

#[test]
fn a_way_that_the_arm_cannot_go_is_invalid_input() {
    let folder = good();
    let said = folder.call(&["run", "a.toml", "--set", "teaching.waypoint.0.offset_m=[2.0, 0.0, 0.0]"]);
    assert_eq!(said.code, Some(3), "{}{}", said.stdout, said.stderr);
    assert!(said.stderr.contains("cannot be reached"), "{}", said.stderr);
    assert!(!folder.path().join("runs/good-0").exists());
}

#[test]
fn postures_of_another_arm_are_invalid_input() {
    let pair = "[0.0, 0.0]";
    let overrides: Vec<String> = [
        ("rest_posture_rad", pair),
        ("idle_posture_rad", "[]"),
        ("impedance.stiffness_nm_per_rad", pair.replace("0.0", "1.0").as_str()),
        ("impedance.damping_nms_per_rad", pair),
    ]
    .iter()
    .map(|(key, value)| format!("--set=robot.{key}={value}"))
    .collect();
    for command in ["validate", "run"] {
        let mut arguments = vec![command, "a.toml"];
        arguments.extend(overrides.iter().map(String::as_str));
        let said = good().call(&arguments);
        assert_eq!(said.code, Some(3), "{}", said.stderr);
    }
}
