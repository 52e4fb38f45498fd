//! What must be refused or counted although it looks harmless: poses that are none, contacts of two that are named, newer folders, pipes.

use std::fs;

use serde_json::Value;

use super::{Folder, GOOD};

const ROBOT: &str = include_str!("../../assets/baxter/baxter.urdf");

/// Samples of an arm at rest, twice, with the toy at these heights (m) and with that quaternion.
fn toy_at(heights_m: [f64; 2], turn: &str, more: &str) -> String {
    let joints = (1..=7).map(|joint| format!("q{joint}_rad")).collect::<Vec<_>>().join(",");
    let pose = ["x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"].map(|axis| format!("toy_{axis}")).join(",");
    let also = if more.is_empty() { String::new() } else { format!(",{}", pose.replace("toy_", "object_toy_")) };
    let rest = "-0.4347,-1.0645,-0.4138,1.934,0.2873,0.7587,-0.2272";
    let row = |(time_s, z): (usize, f64)| format!("{time_s},{rest},0.6,0.1,{z},{turn}{more}\n");
    format!("time_s,{joints},{pose}{also}\n{}", heights_m.into_iter().enumerate().map(row).collect::<String>())
}

/// Contract: naming one more object asks more, and what is pushed into a table does not stand on it.
#[test]
fn no_contact_means_none_of_what_it_names() {
    let asked = |objects: &str| format!("{GOOD}\n[[criterion]]\nname = \"apart\"\nkind = \"no_contact\"\nobjects = [{objects}]\n");
    let folder = Folder::with(&[
        ("table.toml", asked("\"table\"").as_bytes()),
        ("both.toml", asked("\"table\", \"toy\"").as_bytes()),
        ("stands.csv", toy_at([0.0305, 0.0302], "0,0,0,1", "").as_bytes()),
        ("pushed.csv", toy_at([0.0305, 0.005], "0,0,0,1", "").as_bytes()),
    ]);
    for scene in ["table.toml", "both.toml"] {
        let passed = |samples: &str| {
            let said = folder.call(&["check", samples, "--scene", scene, "--format", "json", "-q"]);
            let told: Value = serde_json::from_str(&said.stdout).expect("JSON");
            let criteria = told["checks"][0]["report"]["criteria"].as_array().expect("criteria").clone();
            criteria.iter().find(|one| one["name"] == "apart").expect("it is asked")["passed"].clone()
        };
        assert_eq!((passed("stands.csv"), passed("pushed.csv")), (Value::from(true), Value::from(false)), "{scene}");
    }
}

/// Contract: an object that is told twice, or turned by no quaternion, is refused as the tool would be.
#[test]
fn poses_of_objects_are_told_once_and_are_poses() {
    let again = ",0.6,0.1,0.5,0,0,0,1";
    let folder = Folder::with(&[
        ("a.toml", GOOD.as_bytes()),
        ("twice.csv", toy_at([0.031, 0.031], "0,0,0,1", again).as_bytes()),
        ("zero.csv", toy_at([0.031, 0.031], "0,0,0,0", "").as_bytes()),
    ]);
    for (samples, told) in [("twice.csv", "the pose of `toy` twice"), ("zero.csv", "of sample 1 has the length 0")] {
        let said = folder.call(&["check", samples, "--scene", "a.toml"]);
        assert!(said.code == Some(3) && said.stdout.contains(told), "{samples}: {}{}", said.stdout, said.stderr);
    }
}

/// Contract: a scenario that only reports cannot fail, and a newer run's folder may mean something else.
#[test]
fn what_cannot_fail_and_what_is_newer_is_told() {
    let reported = GOOD.replace("max_m = 0.02\n", "max_m = 0.02\nexpect = \"report\"\n");
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes()), ("b.toml", reported.as_bytes())]);
    let said = folder.call(&["validate", "b.toml", "--deny-warnings"]);
    assert!(said.code == Some(3) && said.stderr.contains("only reported"), "{}", said.stderr);
    assert_eq!(folder.call(&["run", "a.toml", "--out", "run", "-q"]).code, Some(0));
    let manifest = folder.path().join("run/manifest.json");
    let text = fs::read_to_string(&manifest).expect("there");
    for version in ["7", "\"7\"", "2.0"] {
        fs::write(&manifest, text.replacen("\"schema_version\": 1", &format!("\"schema_version\": {version}"), 1)).expect("written");
        for command in ["check", "replay", "inspect", "figures"] {
            let said = folder.call(&[command, "run"]);
            let told = format!("{}{}", said.stdout, said.stderr).contains(&format!("version {version}"));
            assert!(said.code == Some(3) && told, "{command}: {}{}", said.stdout, said.stderr);
        }
    }
}

/// Contract: a pipe where a file of the run should be keeps nobody waiting.
#[cfg(unix)]
#[test]
fn pipes_in_the_folder_of_a_run_are_refused() {
    let folder = Folder::with(&[("a.toml", GOOD.as_bytes())]);
    for (name, commands) in [
        ("report.json", &["check", "inspect"][..]),
        ("manifest.json", &["check", "replay", "inspect", "figures"]),
        ("steps.parquet", &["check", "figures"]),
        ("state_hashes.parquet", &["replay"]),
    ] {
        assert_eq!(folder.call(&["run", "a.toml", "--out", "run", "-q"]).code, Some(0));
        let file = folder.path().join("run").join(name);
        fs::remove_file(&file).expect("removed");
        assert!(std::process::Command::new("mkfifo").arg(&file).status().is_ok_and(|made| made.success()));
        for command in commands {
            let said = folder.call(&[command, "run"]);
            assert_eq!(said.code, Some(3), "{command} with {name}: {}", said.stderr);
        }
        fs::remove_dir_all(folder.path().join("run")).expect("removed");
    }
}

/// Contract: a folder of one's own is none of a run, though a skill lies beside the scenario.
#[test]
fn a_scenario_beside_a_skill_is_a_scenario() {
    let folder = Folder::with(&[("mine/scenario.toml", GOOD.as_bytes()), ("mine/skill.json", b"{}")]);
    let said = folder.call(&["check", "mine", "--format", "json", "-q"]);
    assert!(said.code == Some(0) && said.stdout.contains("\"kind\":\"scenario\""), "{}{}", said.stdout, said.stderr);
}

/// Contract: a flag mends a file with a sweep as it mends one without.
#[test]
fn flags_mend_a_file_that_has_a_sweep() {
    let sweep = "\n[robot]\nurdf = \"not_here.urdf\"\n\n[[sweep]]\nkind = \"repeat\"\ncount = 2\n";
    let folder = Folder::with(&[("a.toml", format!("{GOOD}{sweep}").as_bytes()), ("r.urdf", ROBOT.as_bytes())]);
    assert_eq!(folder.call(&["validate", "a.toml"]).code, Some(3));
    let said = folder.call(&["validate", "a.toml", "--robot", "r.urdf"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);

    // Flags that make a single run of it may mend it too; and what only they make wrong in other members is not the file's fault.
    let seeds = format!("{GOOD}\n[robot]\nurdf = \"not_here.urdf\"\n\n[[sweep]]\nkind = \"grid\"\nkey = \"seed\"\nvalues = [1, 2]\n");
    let rates = format!("{GOOD}\n[[sweep]]\nkind = \"grid\"\nkey = \"simulation.log_rate_hz\"\nvalues = [100.0, 1000.0]\n");
    let files = [("seeds.toml", seeds.as_bytes()), ("rates.toml", rates.as_bytes()), ("r.urdf", ROBOT.as_bytes())];
    let folder = Folder::with(&files);
    for command in ["validate", "check"] {
        let said = folder.call(&[command, "seeds.toml", "--robot", "r.urdf", "--seed", "5"]);
        assert_eq!(said.code, Some(0), "{command}: {}", said.stderr);
    }
    let said = folder.call(&["validate", "rates.toml", "--set", "simulation.step_s=0.002"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    let said = folder.call(&["sweep", "rates.toml", "--set", "simulation.step_s=0.002", "--dry-run"]);
    assert!(said.code == Some(3) && said.stderr.contains("more than the engine's steps"), "the sweep is another matter: {}", said.stderr);

    // A sweep that is wrong with and without a flag is wrong, in whatever words; and so is one that flags make wrong by what they say of it.
    let durations = format!("{GOOD}\n[[sweep]]\nkind = \"grid\"\nkey = \"teaching.duration_s\"\nvalues = [3.0, 5.0]\n");
    let two = "ranges = { \"object.toy.radius_m\" = [0.03, 0.031], \"object.toy.radus_m\" = [0.03, 0.031] }";
    let two = format!("{GOOD}\n[[sweep]]\nkind = \"latin_hypercube\"\ncount = 2\n{two}\n");
    let kinds = format!("{GOOD}\n[[sweep]]\nkind = \"grid\"\nkey = \"object.toy.kind\"\nvalues = [\"ball\", \"box\"]\n");
    let radii = format!("{GOOD}\n[[sweep]]\nkind = \"grid\"\nkey = \"object.toy.radius_m\"\nvalues = [0.03, 0.031]\n");
    let folder = Folder::with(&[
        ("durations.toml", durations.as_bytes()),
        ("radii.toml", radii.as_bytes()),
        ("two.toml", two.as_bytes()),
        ("kinds.toml", kinds.as_bytes()),
    ]);
    for (flags, code) in [
        (&["durations.toml"][..], 3),
        (&["durations.toml", "--set", "teaching.waypoint.1.time_s=3.9"], 3),
        (&["two.toml"], 3),
        (&["two.toml", "--set", "object.toy.radius_m=0.03"], 3),
        (&["kinds.toml"], 3),
        (&["kinds.toml", "--set", "object.toy.size_m=[0.1, 0.1, 9.0]"], 3),
        (&["radii.toml"], 0),
        (&["radii.toml", "--set", "object.toy.radius_m=0.032"], 0),
        (&["radii.toml", "--set", "sweep.0.values=[-1.0]"], 3),
        (&["radii.toml", "--set", "sweep.0.key=object.toy.radus_m"], 3),
    ] {
        let said = folder.call(&[&["validate"], flags].concat());
        assert_eq!(said.code, Some(code), "{flags:?}: {}", said.stderr);
    }
}
