//! `--set`, the flags that stand for a key, and the environment: what wins, and what a slip leads to.

use super::{Folder, GOOD, cpdmp};

fn good() -> Folder {
    Folder::with(&[("a.toml", GOOD.as_bytes())])
}

#[test]
fn an_override_reaches_tables_lists_by_name_and_lists_by_number() {
    let said = good().call(&[
        "validate",
        "a.toml",
        "--set",
        "object.toy.radius_m=0.02",
        "--set",
        "teaching.waypoint.1.time_s=3.5",
        "--set",
        "human.help.kind=none",
        "--set",
        "learning.theta_f=[\"block_height_m\"]",
    ]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
}

#[test]
fn an_override_is_checked_like_the_file_and_named_as_what_it_is() {
    for (typed, told) in [
        ("object.toi.radius_m=0.02", "did you mean `toy`?"),
        ("object.toy.radius=0.02", "did you mean `radius_m`?"),
        ("object.toy.radius_m=-1", "expected 0.001 … 0.5 m"),
        ("object.toy.radius_m=2cm", "this value cannot be read"),
        ("object.toy.radius_m", "has no `=`"),
        ("step_s=0.001", "it belongs to [simulation]: `simulation.step_s`"),
        ("learning.motion.states_criterion=bic", "it belongs to [learning]: `learning.states_criterion`"),
        ("teaching.waypoint.7.time_s=1", "expected a number below 2"),
        ("name.first=a", "has no keys"),
        ("parameters.block_hight_m=0.2", "did you mean `block_height_m`?"),
        ("parameters.speed=1", "nothing in the scenario asks for a parameter `speed`"),
    ] {
        let said = good().call(&["validate", "a.toml", "--set", typed]);
        assert_eq!(said.code, Some(3), "{typed}");
        assert!(said.stderr.contains("--set:1:") && said.stderr.contains(told), "{typed}: {}", said.stderr);
    }
}

#[test]
fn a_flag_wins_over_the_environment_and_that_over_the_scenario() {
    let folder = good();
    let robot = |arguments: &[&str], environment: Option<&str>| {
        let mut command = cpdmp();
        command.current_dir(folder.path()).args(["validate", "a.toml", "--set", "robot.urdf=scenario.urdf"]).args(arguments);
        if let Some(value) = environment {
            command.env("CPDMP_ROBOT", value);
        }
        String::from_utf8(command.output().expect("it starts").stderr).expect("text")
    };
    assert!(robot(&[], None).contains("scenario.urdf, which does not exist"));
    assert!(robot(&[], Some("environment.urdf")).contains("environment.urdf, which does not exist"));
    assert!(robot(&["--robot", "flag.urdf"], Some("environment.urdf")).contains("flag.urdf, which does not exist"));
}

#[test]
fn a_robot_that_cannot_be_used_is_told_before_anything_is_written() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("b.urdf", b"<robot name='b'><link name='x'></robot>")]);
    for command in ["validate", "run"] {
        let said = folder.call(&[command, "a.toml", "--robot", "b.urdf"]);
        assert_eq!(said.code, Some(3), "{}", said.stderr);
        assert!(said.stderr.contains("b.urdf"), "{}", said.stderr);
    }
    assert!(!folder.path().join("runs/good-0").exists());
}

/// Contract: a parameter that a flag or a sweep names must be asked for by something, which flags may say too.
#[test]
fn a_parameter_that_nothing_asks_for_cannot_be_set() {
    let folder = good();
    let said = folder.call(&["sweep", "a.toml", "--grid", "parameters.block_hight_m=0.2,0.3", "--dry-run"]);
    assert!(said.code == Some(3) && said.stderr.contains("did you mean `block_height_m`?"), "{}", said.stderr);
    let said = folder.call(&["validate", "a.toml", "--set", "parameters.aside_m=0.02", "--set", "object.toy.lateral_offset_m=aside_m"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
}
