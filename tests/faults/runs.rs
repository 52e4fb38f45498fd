//! Faults that show only when the arm moves, or when the files around a run are not what they should be.

use std::fs::File;
use std::path::Path;

use parquet::file::reader::SerializedFileReader;
use parquet::record::Field;
use serde_json::Value;

use crate::cli::{Folder, GOOD, Said, cpdmp};

const BAXTER: &str = include_str!("../../assets/baxter/baxter.urdf");

fn good() -> Folder {
    Folder::with(&[("a.toml", GOOD.as_bytes())])
}

fn with_set(folder: &Folder, command: &[&str], set: &[&str]) -> Said {
    let set = set.iter().flat_map(|set| ["--set", *set]);
    folder.call(&command.iter().copied().chain(set).collect::<Vec<_>>())
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

/// The report that a run with these overrides leaves in `out`, and what the program said.
fn run(folder: &Folder, set: &[&str]) -> (Said, Value) {
    let said = with_set(folder, &["run", "a.toml", "--out", "out", "-q"], set);
    let report = std::fs::read_to_string(folder.path().join("out/report.json")).unwrap_or_else(|_| panic!("no report: {}", said.stderr));
    (said, json(&report))
}

/// The columns of a step log whose names begin with `prefix`.
fn columns(log: &Path, prefix: &str) -> Vec<Vec<f64>> {
    let rows = SerializedFileReader::new(File::open(log).expect("written")).expect("Parquet").into_iter();
    let mut columns: Vec<Vec<f64>> = Vec::new();
    for row in rows.map(|row| row.expect("a row")) {
        let found = row.get_column_iter().filter(|(name, _)| name.starts_with(prefix));
        for (index, (_, field)) in found.enumerate() {
            let number = match field {
                Field::Double(number) => *number,
                Field::Long(number) => *number as f64,
                other => panic!("{other:?}"),
            };
            columns.resize_with(columns.len().max(index + 1), Vec::new);
            columns[index].push(number);
        }
    }
    columns
}

#[test]
fn row_7_demonstrations_and_robots_outside_the_roots_are_refused_with_where_they_lie() {
    let outside = Folder::with(&[("b.urdf", BAXTER.as_bytes()), ("d/x.csv", b"time_s,x_m\n0,0\n1,1\n")]);
    let place = outside.path().canonicalize().expect("there");
    let folder = good();
    for (key, file) in [("robot.urdf", "b.urdf"), ("demonstrations", "d")] {
        let file = place.join(file).display().to_string();
        let layer = if key == "robot.urdf" { format!("[robot]\nurdf = {file:?}\n") } else { format!("demonstrations = {file:?}\n") };
        let text = format!("extends = \"a.toml\"\nname = \"b\"\n{layer}");
        std::fs::write(folder.path().join("b.toml"), text).expect("written");
        let said = folder.call(&["validate", "b.toml"]);
        assert_eq!(said.code, Some(3), "{key}: {}", said.stderr);
        assert!(said.stderr.contains("error[outside_root]") && said.stderr.contains(&file), "{key}: {}", said.stderr);
    }
}

#[test]
fn row_13_what_starts_inside_something_else_is_told_with_pair_and_depth_before_a_step() {
    for command in ["validate", "run"] {
        let folder = good();
        let said = with_set(&folder, &[command, "a.toml"], &["object.block.center_m=[0.6, 0.4]"]);
        assert_eq!(said.code, Some(3), "{command}: {}", said.stdout);
        let told = ["at the start `left_gripper_electric_base` is ", " mm inside `block.base`", "move the objects or the arm apart"];
        assert!(told.iter().all(|part| said.stderr.contains(part)), "{command}: {}", said.stderr);
        assert!(!folder.path().join("runs/good-0").exists(), "nothing was written");
    }
}

#[test]
fn row_24_a_pose_out_of_reach_is_told_with_the_distance_and_the_joint_that_stops_the_arm() {
    let said = with_set(&good(), &["validate", "a.toml"], &["teaching.waypoint.1.offset_m=[0.0, 1.5, 0.0]"]);
    assert_eq!(said.code, Some(3), "{}", said.stdout);
    for part in ["way-point 2 (at toy) of lesson 1", "cannot be reached", " mm and ", " deg away"] {
        assert!(said.stderr.contains(part), "{part}: {}", said.stderr);
    }
}

/// A robot with a link so light that no torque leaves it finite.
fn diverging() -> String {
    let link = BAXTER.find("<link name=\"left_upper_elbow\">").expect("there");
    let (before, after) = BAXTER.split_at(link);
    let tiny = "<inertia ixx=\"1e-200\" ixy=\"0\" ixz=\"0\" iyy=\"1e-200\" iyz=\"0\" izz=\"1e-200\"/>";
    let inertia = &after[after.find("<inertia ").expect("there")..];
    let inertia = &inertia[..inertia.find("/>").expect("there") + 2];
    before.to_owned() + &after.replacen(inertia, tiny, 1).replacen("4.31272", "1e-200", 1)
}

#[test]
fn row_25_a_simulation_that_diverges_ends_with_11_time_and_body() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("b.urdf", diverging().as_bytes())]);
    let said = folder.call(&["run", "a.toml", "--robot", "b.urdf", "--out", "out"]);
    assert_eq!(said.code, Some(11), "{}{}", said.stdout, said.stderr);
    let report = json(&std::fs::read_to_string(folder.path().join("out/report.json")).expect("a report is written"));
    assert_eq!((report["outcome"].as_str(), report["exit_code"].as_i64()), (Some("diverged"), Some(11)));
    let error = report["error"].as_str().expect("a reason");
    assert!(error.contains("diverged at step 1 (0.001 s): body `left_") && error.contains("`step_s`"), "{error}");
    assert!(error.contains("(everything was at rest before)"), "{error}");
}

/// Contract: an execution that diverges or is stopped leaves what it showed up to then, and no verdict.
#[test]
fn rows_25_and_29_what_an_execution_showed_before_it_ended_is_kept() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("b.urdf", diverging().as_bytes())]);
    assert_eq!(folder.call(&["run", "a.toml", "--out", "taught", "-q"]).code, Some(0));
    let again = ["run", "a.toml", "--set", "demonstrations=taught/demonstrations", "--out", "out"];
    let endless = ["--set", "execution.duration_s=600", "--set", "execution.settle_s=60"];
    for (more, code, told, fewest) in [(&["--robot", "b.urdf"][..], 11, "diverged at step 1 ", 1), (&endless, 12, "`execute`", 100)] {
        // A busy machine may need longer to come as far as the execution, which takes minutes.
        let (said, report) = ["3", "6", "12", "24", "48"]
            .iter()
            .map(|limit| {
                let said = folder.call(&[&again[..], more, &["--timeout", limit]].concat());
                assert_eq!(said.code, Some(code), "{}{}", said.stdout, said.stderr);
                (said, json(&std::fs::read_to_string(folder.path().join("out/report.json")).expect("a report is written")))
            })
            .find(|(said, _)| folder.path().join("out/steps.parquet").is_file() && said.code == Some(code))
            .expect("it is executed within one of the limits");
        assert!(report["error"].as_str().is_some_and(|error| error.contains(told)), "{report}");
        assert!(report["criteria"].as_array().is_some_and(Vec::is_empty) && report["state_hash"].is_null(), "nothing is judged: {report}");
        assert!(report["human"]["peak_force_n"].is_number() && said.stdout.contains("did not touch the arm"), "{}", said.stdout);
        let times = columns(&folder.path().join("out/steps.parquet"), "time_s").remove(0);
        assert!(times.len() >= fewest && times.iter().all(|time_s| time_s.is_finite()), "{} steps", times.len());
        assert!(folder.path().join("out/skill.json").is_file());
        let said = folder.call(&["replay", "out"]);
        assert!(said.code == Some(3) && said.stderr.contains("did not come to its end"), "{}", said.stderr);
    }
}

#[test]
fn row_27_a_person_never_pushes_harder_than_the_cap_and_may_never_be_needed() {
    let folder = good();
    let aside = ["human.help.kind=guide", "human.help.object=toy", "object.toy.lateral_offset_m=0.1", "teaching.waypoint.1.at=table"];
    let (said, report) = run(&folder, &[&aside[..], &["human.help.force_max_n=3"]].concat());
    assert_eq!(said.code, Some(0), "{}{}", said.stdout, said.stderr);
    let peak = report["human"]["peak_force_n"].as_f64().expect("a force");
    assert!(peak > 2.5 && peak <= 3.0 + 1e-9, "asked for more than 3 N, the person pushes with {peak} N");
    let (said, report) = run(&folder, &[&aside[..], &["human.help.reach_m=0"]].concat());
    assert_eq!(said.code, Some(0));
    assert_eq!((report["human"]["peak_force_n"].as_f64(), report["human"]["contact_s"].as_f64()), (Some(0.0), Some(0.0)));
    assert!(said.stdout.contains("did not touch the arm"), "{}", said.stdout);
    let helped = "[[criterion]]\nname = \"helped\"\nkind = \"human_force\"\nmax_n = 1\nexpect = \"fail\"\n";
    std::fs::write(folder.path().join("a.toml"), GOOD.to_owned() + helped).expect("written");
    let (said, _) = run(&folder, &[&aside[..], &["human.help.force_max_n=3"]].concat());
    assert_eq!(said.code, Some(0), "it is asked that the person pushes harder than 1 N: {}", said.stdout);
    let (said, _) = run(&folder, &[&aside[..], &["human.help.reach_m=0"]].concat());
    assert!(said.code == Some(10) && said.stdout.contains("helped"), "a person who is needed and does not come: {}", said.stdout);
    let limit = ["human.help.kind=push", "human.help.force_n=[20, 0, 0]", "human.help.windows_s=[[1, 2]]"];
    let criterion = GOOD.to_owned() + "[[criterion]]\nname = \"gentle\"\nkind = \"human_force\"\nmax_n = 15\n";
    std::fs::write(folder.path().join("a.toml"), criterion).expect("written");
    let (said, _) = run(&folder, &limit);
    assert!(said.code == Some(10) && said.stdout.contains("gentle"), "{:?} {}", said.code, said.stdout);
}

/// The worst sensors that a scenario may have, and a coupling as soft as it may be.
#[test]
fn row_28_wrong_forces_move_the_skill_no_further_than_the_saturation() {
    let folder = good();
    let worst = ["effort_bias_nm", "effort_noise_nm", "dry_friction_nm"].map(|key| format!("robot.sensor.{key}=5"));
    let soft = ["learning.motion.states=3", "coupling.enabled=true", "coupling.mode=per_state", "coupling.beta=[-1, -1, -1]"];
    let gain = ["coupling.compliance_m_per_n=[10, 10, 10]", "coupling.saturation_m=0.05"];
    let set: Vec<&str> = worst.iter().map(String::as_str).chain(soft).chain(gain).collect();
    let (said, report) = run(&folder, &set);
    assert_eq!(said.code, Some(0), "{}{}", said.stdout, said.stderr);
    assert!(!report.to_string().contains("NaN") && report["criteria"][0]["value"].is_number(), "{report}");
    let coupling = columns(&folder.path().join("out/steps.parquet"), "coupling_");
    assert_eq!(coupling.len(), 3, "x, y and z");
    let largest = coupling.iter().flatten().fold(0.0, |largest: f64, m| if m.is_finite() { largest.max(m.abs()) } else { f64::INFINITY });
    assert!(largest > 0.04 && largest <= 0.05 + 1e-12, "{largest} m");
}

#[test]
fn row_29_a_run_that_takes_too_long_ends_with_12_and_says_how_far_it_came() {
    let folder = good();
    let said = folder.call(&["run", "a.toml", "--timeout", "0.02", "--out", "out"]);
    assert_eq!(said.code, Some(12), "{}{}", said.stdout, said.stderr);
    let report = json(&std::fs::read_to_string(folder.path().join("out/report.json")).expect("a report is written"));
    assert_eq!((report["outcome"].as_str(), report["exit_code"].as_i64()), (Some("time_limit"), Some(12)));
    let error = report["error"].as_str().expect("a reason");
    assert!(error.contains("time limit") && (error.contains("lesson ") || error.contains("`teach`")), "{report}");
    let said = folder.call(&["check", "a.toml", "--timeout", "0.02", "--format", "junit"]);
    assert_eq!(said.code, Some(12));
    assert!(said.stdout.contains("<error") && said.stdout.contains("time_limit"), "{}", said.stdout);
    assert_eq!(folder.call(&["run", "a.toml", "--timeout", "600", "-q"]).code, Some(0), "a limit that is not reached changes nothing");
    let planar = Folder::with(&[("p.toml", include_str!("../../scenarios/obstacle_avoidance.toml").as_bytes())]);
    let said = planar.call(&["run", "p.toml", "--timeout", "0.001", "--out", "out", "-q"]);
    assert_eq!(said.code, Some(12), "{}{}", said.stdout, said.stderr);
    let report = json(&std::fs::read_to_string(planar.path().join("out/report.json")).expect("a report is written"));
    assert!(report["error"].as_str().is_some_and(|error| error.contains("the time limit was reached before ")), "{report}");
    assert_eq!(planar.call(&["check", "p.toml", "--timeout", "0.001"]).code, Some(12));
    assert_eq!(planar.call(&["check", "p.toml", "--timeout", "600"]).code, Some(0));
    for wrong in ["0", "-1", "nan", "inf", "1e300", "soon"] {
        assert_eq!(folder.call(&["run", "a.toml", "--timeout", wrong]).code, Some(2), "{wrong}");
    }
}

/// Contract: the time limit ends the learning of one model too, which would take many minutes here, and a report is left.
#[test]
fn row_29_learning_that_takes_too_long_ends_with_12() {
    let folder = good();
    assert_eq!(folder.call(&["run", "a.toml", "--out", "taught", "-q"]).code, Some(0));
    let long =
        ["learning.motion.states=100", "learning.motion.tolerance=0", "learning.motion.max_iterations=100000", "learning.rate_hz=100"];
    let taught = ["demonstrations=taught/demonstrations"];
    let said = with_set(&folder, &["run", "a.toml", "--out", "out", "-q", "--timeout", "2"], &[&taught[..], &long].concat());
    assert_eq!(said.code, Some(12), "{}{}", said.stdout, said.stderr);
    let report = json(&std::fs::read_to_string(folder.path().join("out/report.json")).expect("a report is written"));
    let told = "the time limit was reached before a model was learned";
    assert!(report["error"].as_str().is_some_and(|error| error.contains(told)), "{report}");
    assert_eq!((report["outcome"].as_str(), report["phases"].as_array().map(Vec::len)), (Some("time_limit"), Some(0)), "{report}");
}

/// Neither a display nor the clock of the machine has to do with a run: time is a whole number of steps.
#[test]
fn rows_34_and_38_no_display_is_needed_and_simulated_time_is_counted_in_steps() {
    let folder = good();
    let mut command = cpdmp();
    for name in ["DISPLAY", "WAYLAND_DISPLAY", "XDG_RUNTIME_DIR", "HOME"] {
        command.env_remove(name);
    }
    command.env("TZ", "Pacific/Kiritimati");
    let output = command.current_dir(folder.path()).args(["run", "a.toml", "--out", "out", "-q"]).output().expect("it starts");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let log = folder.path().join("out/steps.parquet");
    let [steps, times] = ["step", "time_s"].map(|name| columns(&log, name).remove(0));
    assert!(steps.len() > 100 && steps.windows(2).all(|pair| pair[1] - pair[0] == steps[1] - steps[0]), "evenly logged");
    for (step, time_s) in steps.iter().zip(&times) {
        assert!((time_s - step * 1e-3).abs() < 1e-12, "step {step} at {time_s} s");
    }
}

/// Contract: every joint that a posture of the scenario puts beyond a limit is named with angle and limit, whatever else is wrong, and nothing is
/// simulated.
#[test]
fn postures_beyond_the_limits_of_joints_are_named() {
    let folder = good();
    let idle = "robot.idle_posture_rad=[0.6, 1.5, 0.0, 1.6, 0.0, 0.6, 0.0]";
    let rest = "robot.rest_posture_rad=[-0.4347, -1.0645, -0.4138, 1.934, 0.2873, 0.7587, 3.2]";
    for command in [&["validate", "a.toml"][..], &["run", "a.toml", "--out", "out", "-q"]] {
        let said = with_set(&folder, command, &[idle, rest]);
        assert_eq!(said.code, Some(3), "{}", said.stderr);
        for told in [
            "robot.idle_posture_rad puts joint `right_s1` at 1.5000 rad, above its upper limit of 1.0470 rad",
            "robot.rest_posture_rad puts joint `left_w2` at 3.2000 rad, above its upper limit of 3.0590 rad",
            "`torso` is 61.6 mm inside `right_lower_elbow`",
        ] {
            assert!(said.stderr.contains(told), "`{told}` is not in: {}", said.stderr);
        }
        assert_eq!(folder.names(), ["a.toml"], "nothing is written");
    }
    assert_eq!(with_set(&folder, &["validate", "a.toml"], &[&idle.replace("1.5", "0.5")]).code, Some(0));
}

/// Contract: a dataset that does not show what the skill is asked is warned about before anything runs.
#[test]
fn a_setting_beyond_a_recorded_dataset_is_told_by_validate() {
    let folder = good();
    assert_eq!(with_set(&folder, &["run", "a.toml", "--out", "taught", "-q"], &[]).code, Some(0));
    let of_dataset = "demonstrations=taught/demonstrations";
    let said = with_set(&folder, &["validate", "a.toml"], &[of_dataset, "parameters.block_height_m=0.3"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert!(
        said.stderr.contains("`block_height_m` is 0.3, but was demonstrated from 0.17 to 0.26 only: the skill extrapolates"),
        "{}",
        said.stderr
    );
    let said = with_set(&folder, &["validate", "a.toml"], &[of_dataset]);
    assert!(said.code == Some(0) && !said.stderr.contains("demonstrated"), "{}", said.stderr);
}
