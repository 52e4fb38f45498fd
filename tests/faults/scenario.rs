//! Faults inside a scenario file: each is told with its line, what was expected, and how to mend it.

use crate::cli::{Folder, GOOD};

/// The line of the good scenario on which `text` stands.
fn line_of(text: &str) -> usize {
    GOOD[..GOOD.find(text).expect("there")].matches('\n').count() + 1
}

/// Replaces `old` by `new`, and expects a fault of that code at that line which says all of `told`.
fn fault(old: &str, new: &str, code: &str, told: &[&str]) {
    let stderr = Folder::with_change(old, new).refused();
    assert!(stderr.contains(&format!("error[{code}]")), "{stderr}");
    assert!(stderr.contains(&format!("a.toml:{}:", line_of(old))), "line {}: {stderr}", line_of(old));
    for text in told {
        assert!(stderr.contains(text), "`{text}` is not in: {stderr}");
    }
}

#[test]
fn text_that_is_not_toml_is_shown_with_a_caret() {
    fault("mass_kg = 0.05", "mass_kg = = 0.05", "syntax", &["mass_kg = = 0.05", "━"]);
}

#[test]
fn an_unknown_key_is_named_with_what_was_meant_and_what_there_is() {
    fault("mass_kg = 0.05", "frictoin = 0.5\nmass_kg = 0.05", "unknown_key", &["did you mean `friction`?", "`rolling_damping_per_s`"]);
}

/// Contract: `--lenient` makes unknown keys a warning, and nothing else.
#[test]
fn lenient_only_warns_of_unknown_keys() {
    let unknown = GOOD.replace("mass_kg = 0.05", "frictoin = 0.5\nmass_kg = 0.05");
    let also_wrong = unknown.replace("mass_kg = 0.05", "mass_kg = -1");
    let folder = Folder::with(&[("a.toml", unknown.as_bytes()), ("b.toml", also_wrong.as_bytes()), ("good.toml", GOOD.as_bytes())]);
    for command in [&["validate", "a.toml"][..], &["sweep", "a.toml", "--repeat", "2", "--dry-run"]] {
        assert_eq!(folder.call(command).code, Some(3));
        let said = folder.call(&[command, &["--lenient"]].concat());
        assert_eq!(said.code, Some(0), "{}", said.stderr);
    }
    let said = folder.call(&["validate", "a.toml", "--lenient"]);
    assert!(said.stderr.contains("warning[unknown_key]") && said.stderr.contains("did you mean `friction`?"), "{}", said.stderr);
    let said = folder.call(&["validate", "good.toml", "--set", "sed=1", "--lenient"]);
    assert!(said.code == Some(0) && said.stderr.contains("warning[unknown_key]"), "{}", said.stderr);
    let said = folder.call(&["validate", "b.toml", "--lenient"]);
    assert_eq!(said.code, Some(3));
    assert!(said.stderr.contains("error[out_of_range]") && said.stderr.contains("warning[unknown_key]"), "{}", said.stderr);
}

#[test]
fn a_key_of_another_kind_says_whose_it_is() {
    fault("mass_kg = 0.05", "aperture_m = 0.5\nmass_kg = 0.05", "unknown_key", &["it belongs to kind `u_block`"]);
}

#[test]
fn numbers_are_finite_and_in_range() {
    for number in ["nan", "inf", "-inf", "-1", "0", "1e9"] {
        fault("mass_kg = 0.05", &format!("mass_kg = {number}"), "out_of_range", &["expected 0.001 … 50 kg"]);
    }
}

#[test]
fn a_number_in_another_unit_is_recognised() {
    fault("radius_m = 0.03", "radius_m = 3", "out_of_range", &["if 3 cm was meant, write 0.03"]);
    fault("radius_m = 0.03", "radius_m = \"3 cm\"", "wrong_type", &["write 0.03 without quotes, in m"]);
    fault("radius_m = 0.03", "radius = 0.03", "unknown_key", &["did you mean `radius_m`?"]);
}

#[test]
fn values_have_types_and_lengths() {
    fault("mass_kg = 0.05", "mass_kg = true", "wrong_type", &["is true or false", "expected a number"]);
    fault("center_m = [0.6, 0.1]", "center_m = 0.6", "wrong_type", &["expected a list of 2 numbers"]);
    fault("center_m = [0.6, 0.1]", "center_m = [0.6, 0.1, 0.0]", "wrong_length", &["has 3 entries"]);
    fault("name = \"toy\"", "name = \"to/y\"", "wrong_type", &["cannot be a name"]);
}

#[test]
fn names_must_refer_to_something() {
    fault("at = \"toy\"", "at = \"toi\"", "unknown_name", &["did you mean `toy`?"]);
    fault("theta_m = [\"block_height_m\"]", "theta_m = [\"block_hight_m\"]", "unknown_name", &["did you mean `block_height_m`?"]);
    fault("base_height_m = \"block_height_m\"", "base_height_m = \"height\"", "unknown_name", &["`block_height_m`"]);
    fault("kind = \"ball\"", "kind = \"bal\"", "unknown_name", &["did you mean `ball`?", "`u_block`"]);
}

#[test]
fn names_are_unique() {
    fault("name = \"toy\"", "name = \"block\"", "duplicate_name", &["a second object"]);
}

#[test]
fn a_parameter_must_suit_every_key_it_stands_for() {
    fault("block_height_m = 0.2\n", "block_height_m = 23.5\n", "out_of_range", &["stands for `base_height_m`", "expected 0.005 … 1 m"]);
    fault("grid = { block_height_m = [0.17, 0.20, 0.26] }", "grid = { block_height_m = [0.17, -0.2] }", "out_of_range", &["-0.2"]);
}

#[test]
fn times_rise_from_zero_to_the_end() {
    fault("time_s = 0.0", "time_s = 0.1", "order", &["expected 0 s"]);
    fault("time_s = 4.0", "time_s = 0.0", "order", &["not after the one before"]);
    fault("time_s = 4.0", "time_s = 4.5", "order", &["after the demonstration's end"]);
}

#[test]
fn lists_of_joints_agree() {
    let stderr = Folder::with_change("[parameters]", "[robot]\nidle_posture_rad = [0.0, 0.0]\n[parameters]").refused();
    assert!(stderr.contains("`idle_posture_rad` has 2 entries, but `rest_posture_rad` has 7"), "{stderr}");
}

#[test]
fn the_coupling_has_one_compliance_or_one_per_axis() {
    let stderr = Folder::with_change("[parameters]", "[coupling]\ncompliance_m_per_n = [0.01, 0.01]\n[parameters]").refused();
    assert!(stderr.contains("one number for all axes, or one each"), "{stderr}");
}

#[test]
fn a_newer_language_is_refused_without_guessing_at_the_rest() {
    let stderr = Folder::with_change("schema_version = 1", "schema_version = 2\nholograms = true").refused();
    assert!(stderr.contains("version 2") && stderr.contains("reads version 1") && !stderr.contains("holograms ="), "{stderr}");
}

#[test]
fn demonstrations_come_from_one_place() {
    let stderr = Folder::with_change("[parameters]", "demonstrations = \".\"\n[parameters]").refused();
    assert!(stderr.contains("both `demonstrations` and [teaching]"), "{stderr}");
    let stderr = Folder::with(&[("a.toml", b"schema_version = 1\nname = \"a\"")]).refused();
    assert!(stderr.contains("nothing says where the demonstrations come from"), "{stderr}");
}

#[test]
fn all_faults_are_told_at_once() {
    let text =
        GOOD.replace("mass_kg = 0.05", "mas_kg = nan").replace("radius_m = 0.03", "radius_m = -1").replace("at = \"toy\"", "at = \"x\"");
    let folder = Folder::with(&[("a.toml", text.as_bytes())]);
    let said = folder.call(&["run", "a.toml"]);
    assert_eq!(said.code, Some(3));
    for code in ["missing_key", "unknown_key", "out_of_range", "unknown_name"] {
        assert!(said.stderr.contains(&format!("error[{code}]")), "{code}: {}", said.stderr);
    }
    assert!(said.stderr.contains("4 faults, nothing was simulated or written"), "{}", said.stderr);
    assert_eq!(folder.names(), ["a.toml"]);
}

#[test]
fn what_only_looks_odd_is_a_warning() {
    let folder = Folder::with_change("block_height_m = 0.2\n", "block_height_m = 0.3\n");
    let said = folder.call(&["validate", "a.toml"]);
    assert_eq!(said.code, Some(0));
    assert!(said.stderr.contains("warning[untaught]") && said.stderr.contains("from 0.17 to 0.26"), "{}", said.stderr);
}

/// Contract: a scene in which the gripper would let slip what it closes around is odd; with enough solver iterations, for a ball, or for what
/// stands fast it is not.
#[test]
fn a_gripper_that_closes_around_what_would_slip_is_a_warning() {
    let can = |more: &str| {
        format!(
            "{GOOD}\n[[object]]\nname = \"can\"\nkind = \"cylinder\"\ncenter_m = [0.7, 0.2]\nradius_m = 0.03\nheight_m = 0.1\nmass_kg = 0.1\n{more}"
        )
    };
    let closing = |text: &str| text.replacen("time_s = 4.0", "time_s = 4.0\ngripper = 0.0", 1);
    let warned = |text: &str| {
        let said = Folder::with(&[("a.toml", text.as_bytes())]).call(&["validate", "a.toml"]);
        assert_eq!(said.code, Some(0), "{}", said.stderr);
        said.stderr.contains("let a cylinder slip out of it")
    };
    assert!(warned(&closing(&can(""))));
    assert!(!warned(&can("")), "the gripper stays open");
    assert!(!warned(&closing(&can("fixed = true\n"))), "it stands fast");
    assert!(!warned(&closing(&can("[simulation]\nsolver_iterations = 4\n"))));
}

/// Contract: what is executed beside the run is told apart from it everywhere.
#[test]
fn what_is_beside_the_run_is_not_called_as_the_run_is() {
    let text = format!("{GOOD}\n[[beside]]\nname = \"Executed\"\nset = [\"coupling.enabled=false\"]\n");
    let said = Folder::with(&[("a.toml", text.as_bytes())]).call(&["validate", "a.toml"]);
    assert_eq!(said.code, Some(3), "{}", said.stderr);
    assert!(said.stderr.contains("error[duplicate_name]") && said.stderr.contains("of the run itself"), "{}", said.stderr);
}

/// Contract: every handle of a cabinet is on its door, all of its row and all of its bar.
#[test]
fn a_handle_off_its_door_is_refused_with_what_would_fit() {
    let folder = Folder::with(&[("a.toml", include_bytes!("../../scenarios/cabinet_door.toml"))]);
    // The door is 0.46 m wide and 0.40 m high, the bars have a radius of 6 mm.
    for (typed, told, fits) in [
        ("first_handle_m=0.9", ["the first handle is 0.9 m from the hinge", "0.006 m … 0.454 m"], "first_handle_m=0.25"),
        (
            "handle_spacing_m=0.2",
            ["handle 5 of the row is 1 m from the hinge", "at most 0.0635 m between 5 handles"],
            "handle_spacing_m=0.0635",
        ),
        ("handle_length_m=1", ["a handle of 1 m", "at most 0.388 m"], "handle_length_m=0.388"),
    ] {
        let said = folder.call(&["validate", "a.toml", "--set", &format!("object.cabinet.{typed}")]);
        assert_eq!(said.code, Some(3), "{typed}: {}", said.stdout);
        assert!(said.stderr.contains("error[conflict]") && said.stderr.contains("--set:1:"), "{typed}: {}", said.stderr);
        assert!(told.iter().all(|text| said.stderr.contains(text)), "{typed}: {}", said.stderr);
        let stderr = folder.call(&["validate", "a.toml", "--set", &format!("object.cabinet.{fits}")]).stderr;
        assert!(!stderr.contains("off the door") && !stderr.contains("longer than the door"), "{fits}: {stderr}");
    }
}

/// Contract: with `--deny-warnings` what is otherwise only told refuses a scenario, or the robot, before anything is simulated, and makes a run
/// that warns of something one that is not as expected.
#[test]
fn denied_warnings_are_faults() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    let beyond = ["a.toml", "--set", "parameters.block_height_m=0.4"];
    for command in ["validate", "run", "check"] {
        let said = folder.call(&[&[command][..], &beyond, &["--deny-warnings", "--format", "json", "-q"]].concat());
        assert_eq!(said.code, Some(3), "{command}: {}{}", said.stdout, said.stderr);
        assert!(said.stdout.contains("untaught") && !folder.path().join("runs").exists(), "{command}: {}", said.stdout);
    }
    let said = folder.call(&[&["validate"][..], &beyond].concat());
    assert!(said.code == Some(0) && said.stderr.contains("warning[untaught]"), "{}", said.stderr);
    // One demonstration says nothing of where people do it differently.
    let alone = ["a.toml", "--set", "teaching.grid.block_height_m=[0.2]", "--set", "learning.theta_m=[]"];
    for (command, report) in [("run", "/error"), ("check", "/checks/0/report/error")] {
        assert_eq!(folder.call(&[&[command][..], &alone, &["-q"]].concat()).code, Some(0), "{command} without the flag");
        let said = folder.call(&[&[command][..], &alone, &["--deny-warnings", "--format", "json", "-q"]].concat());
        assert_eq!(said.code, Some(10), "{command}: {}{}", said.stdout, said.stderr);
        let told: serde_json::Value = serde_json::from_str(&said.stdout).expect("JSON");
        let error = told.pointer(report).and_then(serde_json::Value::as_str).unwrap_or_else(|| panic!("no {report}: {told:#}"));
        assert!(error.starts_with("--deny-warnings: ") && error.contains("one demonstration"), "{error}");
    }
}

/// Contract: a window shorter than a logged step would silently be a longer one.
#[test]
fn a_mean_over_less_than_a_logged_step_is_refused() {
    let text = format!("{GOOD}\n[[criterion]]\nname = \"blow\"\nkind = \"tool_force\"\nmean_over_s = 0.02\nmax_n = 100\n");
    let folder = Folder::with(&[("a.toml", text.as_bytes())]);
    assert_eq!(folder.call(&["validate", "a.toml"]).code, Some(0), "two logged steps");
    let said = folder.call(&["validate", "a.toml", "--set", "simulation.log_rate_hz=10"]);
    assert!(said.code == Some(3) && said.stderr.contains("0.02 s are shorter than a logged step"), "{}", said.stderr);
    assert!(said.stderr.contains("a.toml:") && said.stderr.contains("0.1 s or longer"), "{}", said.stderr);
}
