//! What `cpdmp learn` says of errors, units and columns that may be something else.

use std::fmt::Write;

use serde_json::Value;

use super::Folder;

const QUICK: [&str; 8] = ["--states", "4", "--force-states", "4", "--set", "motion.kmeans_starts=0", "--set", "force.kmeans_starts=0"];

/// A folder with one CSV file per strength of a push, which differs in nothing else, and a list.
fn pushes() -> Folder {
    let mut list = "schema_version = 1\nmotion = [\"x_m\"]\nwrench = [\"fx_n\", \"tz_nm\"]\n".to_owned();
    let mut files = Vec::new();
    for (k, strength) in [2.0, 4.0, 6.0].into_iter().enumerate() {
        let mut csv = "time_s,x_m,qx,qy,qz,qw,gripper,fx_n,tz_nm\n".to_owned();
        for i in 0..=50 {
            let u = f64::from(i) / 50.0;
            let (half, force) = (0.1 * k as f64 + 0.4 * u, strength * u * (1.0 - u));
            let (sin, cos) = half.sin_cos();
            writeln!(csv, "{},{},0,0,{sin},{cos},{},{force},{}", 2.0 * u, 0.3 * u * u, 1.0 - 0.5 * u, 0.1 * force).expect("text grows");
        }
        files.push((format!("{k}.csv"), csv));
        writeln!(list, "[[demonstration]]\nfile = \"{k}.csv\"\ntheta_f = {{ strength_n = {strength} }}").expect("text grows");
    }
    files.push(("dataset.toml".to_owned(), list));
    Folder::with(&files.iter().map(|(name, text)| (name.as_str(), text.as_bytes())).collect::<Vec<_>>())
}

/// Contract: everything that is learned has its error told, to people and to programs: motion, orientation, gripper and wrench.
#[test]
fn the_errors_of_wrench_orientation_and_gripper_are_told() {
    let folder = pushes();
    let call = |more: &[&str]| folder.call(&[&["learn", ".", "--cross-validate"], &QUICK[..], more].concat());
    let said = call(&["--format", "json"]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    let report: Value = serde_json::from_str(&said.stdout).expect("JSON");
    let number = |pointer: &str| report.pointer(pointer).and_then(Value::as_f64).unwrap_or_else(|| panic!("{pointer}: {report}"));
    for row in ["/reproduction_overall", "/cross_validation/with_ends", "/cross_validation/lwr"] {
        assert!(number(&format!("{row}/rms_orientation_rad")) > 0.0 && number(&format!("{row}/rms_gripper")) < 0.1);
    }
    let of_wrench = |row: &str| {
        let [fx, tz] = ["fx_n", "tz_nm"].map(|name| number(&format!("{row}/columns/{name}/rms")));
        assert!((fx - 10.0 * tz).abs() < 0.05 * fx, "the torque is a tenth of the force: {fx} N, {tz} N m");
        assert!(number(&format!("{row}/columns/fx_n/max")) >= fx);
        fx
    };
    // The wrenches are of 0.5, 1 and 1.5 N at most.
    assert!(of_wrench("/wrench_reproduction/0") < 0.2 && of_wrench("/wrench_reproduction_overall") < 0.2);
    assert!(of_wrench("/cross_validation/wrench/overall") < 0.3);
    assert_eq!(number("/cross_validation/wrench/folds"), 3.0);
    assert_eq!(number("/cross_validation/wrench/demonstrations/0/extrapolation"), 1.0, "2 N, where 4 to 6 N were shown");

    let said = call(&["--color", "never"]).stdout;
    let headings = |first: &str| -> Vec<&str> { said.lines().filter(|line| line.trim_start().starts_with(first)).collect() };
    assert!(headings("demonstration  ").iter().any(|line| line.ends_with("rms x_m  rms turn deg  rms gripper")), "{said}");
    assert!(headings("demonstration  ").iter().any(|line| line.ends_with("rms fx_n  max fx_n  rms tz_nm  max tz_nm")), "{said}");
    assert!(headings("left out").iter().any(|line| line.contains("rms turn deg  rms turn deg, LWR-DMP")), "{said}");
    assert!(headings("left out").iter().any(|line| line.ends_with("rms fx_n  max fx_n  rms tz_nm  max tz_nm")), "{said}");
    let turn = cpdmp::report::figure(number("/reproduction_overall/rms_orientation_rad").to_degrees());
    assert!(said.contains(&turn), "{turn} deg in {said}");

    let said = folder.call(&["learn", ".", "--cross-validate", "--no-wrench", "--baseline", "--format", "json"]);
    let report: Value = serde_json::from_str(&said.stdout).expect("JSON");
    assert_eq!((&report["wrench_reproduction"], &report["cross_validation"]["wrench"]), (&serde_json::json!([]), &Value::Null));
}

fn columns(names: &str, row: impl Fn(usize, f64) -> String) -> Folder {
    let mut csv = format!("time_s,{names}\n");
    for repetition in 0..3 {
        for i in 0..=40 {
            let u = f64::from(i) / 40.0;
            writeln!(csv, "{},{}", 2.0 * u, row(repetition, u)).expect("text grows");
        }
    }
    Folder::with(&[("t.csv", csv.as_bytes())])
}

/// Contract: what a skill of joints is held against is told in its own unit, and means are called what they are: of the forcing term.
#[test]
fn the_table_of_states_names_the_forcing_term_and_the_unit() {
    for (name, unit, square) in
        [("x_m", "m^2", "m²"), ("q1_rad", "rad^2", "rad²"), ("pressure_pa", "columns' units squared", "units squared")]
    {
        let folder = columns(name, |k, u| format!("{}", u * u + 0.1 * k as f64 * u));
        let said = folder.call(&[&["learn", "t.csv", "--out", "s.json"], &QUICK[..2]].concat());
        assert_eq!(said.code, Some(0), "{}", said.stderr);
        for said in [said, folder.call(&["inspect", "s.json"])] {
            let heading = said.stdout.lines().find(|line| line.trim_start().starts_with("state ")).expect("a table of states");
            assert!(heading.contains(&format!("mean f {name}  std f {name}")) && heading.contains(square), "{heading}");
            let threshold = said.stdout.lines().find(|line| line.contains("threshold sigma")).expect("a threshold");
            assert!(threshold.contains(square) || threshold.contains("none"), "{threshold}");
        }
        let skill: Value = serde_json::from_str(&folder.call(&["inspect", "s.json", "--format", "json"]).stdout).expect("JSON");
        assert_eq!(skill["skill"]["statistic_unit"], unit);
    }
}

#[test]
fn a_column_in_another_unit_is_told_how_to_bring_it_to_si() {
    for (name, mapping) in [
        ("q1_deg", "q1_rad = { from = \"q1_deg\", unit = \"deg\" }"),
        ("hand_y_mm", "hand_y_m = { from = \"hand_y_mm\", unit = \"mm\" }"),
        ("load_kn", "load_n = { from = \"load_kn\", unit = \"kN\" }"),
        ("joint 1_deg", "\"joint 1_rad\" = { from = \"joint 1_deg\", unit = \"deg\" }"),
    ] {
        let folder = columns(name, |_, u| format!("{u}"));
        let said = folder.call(&[&["learn", "t.csv"], &QUICK[..2]].concat());
        assert_eq!(said.code, Some(3), "{name}: {}", said.stderr);
        assert!(said.stderr.contains(mapping), "{name}: {}", said.stderr);
        let list = format!("schema_version = 1\n[columns]\n{mapping}\n");
        std::fs::write(folder.path().join("dataset.toml"), list).expect("written");
        let said = folder.call(&[&["learn", "."], &QUICK[..2]].concat());
        assert_eq!(said.code, Some(0), "what is told works: {}", said.stderr);
    }
}

/// Contract: a column that may be a parameter or the number of the repetition is asked about, with what to write; and writing it works.
#[test]
fn a_column_that_is_constant_inside_every_repetition_is_asked_about() {
    let folder = columns("x_m,height_m,bias_m", |k, u| format!("{},{},0.5", u * u + 0.1 * k as f64 * u, 0.1 + 0.1 * k as f64));
    let learn = |more: &[&str]| folder.call(&[&["learn", "t.csv", "--color", "never"], &QUICK[..2], more].concat());
    let asked = "warning: column height_m is constant inside every repetition but differs between them";
    let said = learn(&[]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    assert!(said.stdout.contains(asked) && !said.stdout.contains("column bias_m is constant inside"), "{}", said.stdout);
    assert!(said.stdout.contains("theta_m = [\"height_m\"], or motion = [\"x_m\", \"bias_m\"]"), "{}", said.stdout);
    assert!(folder.call(&["inspect", "t.csv"]).stdout.contains(asked));
    let said = learn(&["--motion", "x_m,height_m"]);
    assert!(said.code == Some(0) && !said.stdout.contains(asked), "who lists the columns is not asked: {}", said.stdout);
    for said_so in ["theta_m = [\"height_m\"]", "sequence = \"height_m\"", "motion = [\"x_m\", \"bias_m\"]"] {
        std::fs::write(folder.path().join("dataset.toml"), format!("schema_version = 1\n{said_so}\n")).expect("written");
        let said = folder.call(&[&["learn", ".", "--color", "never"], &QUICK[..2]].concat());
        assert!(said.code == Some(0) && !said.stdout.contains(asked), "{said_so}: {}{}", said.stdout, said.stderr);
    }
}

/// Contract: orientations and forces under names that are not known for them are learned or left out as told, but not without a warning.
#[test]
fn columns_that_look_like_orientations_or_forces_are_warned_about() {
    let rows: String =
        (0..60).map(|i| format!("{},{},0,0,0,1,{}\n", f64::from(i) * 0.05, (f64::from(i) / 20.0).sin(), f64::from(i).cos())).collect();
    let with = |names: &str, list: Option<&str>| {
        let csv = format!("time_s,x_m,{names}\n{rows}");
        let files = [("a.csv", csv.as_bytes()), ("dataset.toml", list.unwrap_or_default().as_bytes())];
        let said = Folder::with(&files[..if list.is_some() { 2 } else { 1 }]).call(&["learn", ".", "--out", "s.json"]);
        assert_eq!(said.code, Some(0), "{}", said.stderr);
        format!("{}{}", said.stdout, said.stderr)
    };
    let unknown = "quat_x,quat_y,quat_z,quat_w,force_x_n";
    let said = with(unknown, None);
    for told in ["quat_x, quat_y, quat_z, quat_w look like a quaternion, and are learned as motion", "force_x_n looks like a force"] {
        assert!(said.contains(told), "{told}: {said}");
    }
    let said = with(unknown, Some("schema_version = 1\nmotion = [\"x_m\"]\nwrench = [\"force_x_n\"]\n"));
    assert!(said.contains("look like a quaternion, and are left out") && !said.contains("looks like a force"), "{said}");
    let said = with("qx,qy,qz,qw,fx_n", None);
    assert!(!said.contains("look like") && !said.contains("looks like"), "{said}");
    // What is listed as motion is meant to be motion.
    let said = with("turn,f_n,a,b,c", Some("schema_version = 1\nmotion = [\"x_m\", \"f_n\"]\n"));
    assert!(!said.contains("looks like"), "{said}");
}
