//! `cpdmp inspect`: what a path holds, recognised by its content; and the examples in the help of the three commands.

use serde_json::Value;

use super::learn::{learn, strokes};
use super::{Folder, Said};

fn inspect(folder: &Folder, path: &str) -> Value {
    let said = folder.call(&["inspect", path, "--format", "json"]);
    assert_eq!(said.code, Some(0), "{}{}", said.stdout, said.stderr);
    serde_json::from_str(&said.stdout).expect("JSON")
}

#[test]
fn kinds_are_known_by_content_not_by_name() {
    let folder = strokes();
    assert_eq!(learn(&folder, &["--out", "a.json"]).code, Some(0));
    std::fs::rename(folder.path().join("a.json"), folder.path().join("thing")).expect("renamed");
    std::fs::write(folder.path().join("arm.txt"), URDF).expect("written");
    let skill = inspect(&folder, "thing");
    assert_eq!((&skill["kind"], skill["skill"]["states"].as_array().map(Vec::len)), (&"skill".into(), Some(8)));
    let data = inspect(&folder, "strokes.csv");
    assert_eq!((&data["kind"], data["data"]["demonstrations"].as_array().map(Vec::len)), (&"dataset".into(), Some(6)));
    let robot = inspect(&folder, "arm.txt");
    assert_eq!((&robot["kind"], &robot["robot"]["joints"][0]["name"]), (&"robot".into(), &"elbow".into()));
    for (path, text) in [("thing", "complies"), ("strokes.csv", "demonstration"), ("arm.txt", "elbow")] {
        assert!(folder.call(&["inspect", path]).stdout.contains(text), "{path}");
    }
}

#[test]
fn what_cannot_be_used_is_told_with_its_place() {
    let scenario = b"schema_version = 1\n[teaching]\n";
    let folder = Folder::with(&[("empty", b""), ("s.toml", scenario), ("x.json", b"{\"a\": 1}"), ("r.xml", b"<robot><link/>")]);
    for (path, text) in [("empty", "empty"), ("s.toml", "cpdmp validate"), ("x.json", "cpdmp-skill"), ("r.xml", "r.xml"), ("no", "No such")]
    {
        let said = folder.call(&["inspect", path]);
        assert_eq!((said.code, said.stdout.as_str()), (Some(3), ""), "{path}: {}", said.stderr);
        assert!(said.stderr.contains(text), "{path}: {}", said.stderr);
    }
}

/// The lines of the help that begin with the program's name, run in their order.
#[test]
fn the_examples_of_the_help_work() {
    let folder = strokes();
    let path = |name: &str| folder.path().join(name);
    std::fs::create_dir(path("demonstrations")).expect("made");
    let one = |height: f64, lift: f64| {
        let row = |i: i32| {
            let u = f64::from(i) / 99.0;
            let s = u * u * (3.0 - 2.0 * u);
            format!("{:.3},{:.6},{:.6}", 3.0 * u, 0.4 * s, height * (std::f64::consts::PI * s).sin() + lift * s)
        };
        format!("time_s,x_m,y_m\n{}\n", (0..100).map(row).collect::<Vec<_>>().join("\n"))
    };
    let mut list = "schema_version = 1\nmotion = [\"x_m\", \"y_m\"]\nwrench = []\n".to_owned();
    for (k, height) in [0.1, 0.2, 0.3, 0.4].into_iter().enumerate() {
        std::fs::write(path(&format!("demonstrations/{k}.csv")), one(height, 0.1)).expect("written");
        list += &format!("[[demonstration]]\nfile = \"{k}.csv\"\ntheta_m = {{ height_m = {height:?} }}\n");
    }
    std::fs::write(path("demonstrations/dataset.toml"), list).expect("written");
    let mut calls = 0;
    for command in ["learn", "generate", "inspect"] {
        let help = folder.call(&[command, "--help"]).stdout;
        // The last example of `learn` that is called skill.json must have height_m as its parameter, for those of `generate`.
        let examples = help.lines().map(str::trim).filter(|line| line.starts_with(&format!("cpdmp {command} ")));
        for line in examples {
            let Said { code, stderr, .. } = folder.call(&line.split_whitespace().skip(1).collect::<Vec<_>>());
            assert_eq!(code, Some(0), "{line}: {stderr}");
            calls += 1;
        }
    }
    assert_eq!(calls, 11);
}

const URDF: &str = r#"<robot name="arm">
  <link name="base"/>
  <link name="forearm"><inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="elbow" type="revolute"><parent link="base"/><child link="forearm"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="10" velocity="2"/></joint>
</robot>"#;
