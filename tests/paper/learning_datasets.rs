//! Datasets on disk: they come back bit for bit, and everything wrong with one is told at once, with file, row and column.

use std::path::Path;

use cpdmp::demonstration::synthetic::PickAndPlace;
use cpdmp::demonstration::{Dataset, DemonstrationError};
use cpdmp::learning::{LearningError, LearningSettings, generate, learn};

fn write(folder: &Path, list: &str, files: &[(&str, &str)]) {
    std::fs::write(folder.join("dataset.toml"), list).unwrap();
    for (name, text) in files {
        std::fs::write(folder.join(name), text).unwrap();
    }
}

fn faults(list: &str, files: &[(&str, &str)]) -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), list, files);
    match Dataset::read(folder.path()) {
        Err(DemonstrationError::Invalid(faults)) => faults.iter().map(ToString::to_string).collect(),
        other => panic!("{other:?}"),
    }
}

const LIST: &str = "schema_version = 1\nmotion = [\"x_m\"]\n[[demonstration]]\nfile = \"a.csv\"\ntheta_m = { h_m = 0.1 }\n";

#[test]
fn a_dataset_comes_back_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    let dataset = PickAndPlace { duration_s: 2.0, ..Default::default() }.dataset(3);
    let target = folder.path().join("inside").join("taught");
    dataset.write(&target).unwrap();
    assert!(Dataset::read(&target).unwrap() == dataset);
    assert!(matches!(dataset.write(&target), Err(DemonstrationError::Io { .. })), "a folder with files is not overwritten");
    assert_eq!(std::fs::read_dir(target.parent().unwrap()).unwrap().count(), 1, "nothing is left behind");
}

#[test]
fn every_bad_cell_is_named() {
    let text = "time_s,x_m\n0.0,1.0\n0.1,oops\n0.2,\n0.3,1.0,5.0\n";
    let found = faults(LIST, &[("a.csv", text)]);
    assert_eq!(found.len(), 3, "{found:#?}");
    assert!(found[0].starts_with("a.csv, row 3, column x_m") && found[0].contains("`oops`"));
    assert!(found[1].contains("row 4") && found[1].contains("empty cell"));
    assert!(found[2].contains("row 5") && found[2].contains("3 cells"));
    let found = faults(LIST, &[("a.csv", "time_s,x_m\n0.0,1.0\n0.1,nan\n0.1,inf\n")]);
    assert!(found.iter().any(|f| f.contains("row 4, column time_s")), "{found:#?}");
    assert!(found.iter().any(|f| f.contains("row 3, column x_m")) && found.iter().any(|f| f.contains("row 4, column x_m")));
}

#[test]
fn every_fault_of_the_list_is_named() {
    let found = faults("schema_version = 2\nmotions = []\n[[demonstration]]\nfile = \"../a.csv\"\ntheta_m = { h_m = \"tall\" }\n", &[]);
    for part in ["newer cpdmp", "motions", "../a.csv", "theta_m.h_m"] {
        assert!(found.iter().any(|f| f.contains(part)), "nothing about {part}: {found:#?}");
    }
    assert!(faults("motion = [", &[])[0].contains("dataset.toml"));
    assert!(faults(LIST, &[]).iter().any(|f| f.contains("a.csv")), "a missing file");
    assert!(faults(LIST, &[("a.csv", "")])[0].contains("time_s"));
    assert!(faults(LIST, &[("a.csv", "time_s,x_m\n0.0,1.0\n")])[0].contains("1 sample"));
    assert!(faults(&LIST.replace("x_m", "x_mm"), &[("a.csv", "time_s,x_mm\n0,1\n1,2\n")])[0].contains("SI"));
}

#[test]
fn demonstrations_that_disagree_are_named() {
    let two = format!("{LIST}[[demonstration]]\nfile = \"b.csv\"\ntheta_m = {{ width_m = 0.1 }}\n");
    let good = "time_s,x_m\n0.0,1.0\n1.0,2.0\n";
    let found = faults(&two, &[("a.csv", good), ("b.csv", "time_s,y_m\n0.0,1.0\n1.0,2.0\n")]);
    assert!(found.iter().any(|f| f.starts_with("b, column x_m")) && found.iter().any(|f| f.contains("[width_m]")), "{found:#?}");
}

#[test]
fn a_byte_order_mark_windows_line_ends_and_spaces_are_no_trouble() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), LIST, &[("a.csv", "\u{feff}time_s, x_m\r\n0.0, 1.0\r\n1.0, 2.5\r\n")]);
    let dataset = Dataset::read(folder.path()).unwrap();
    assert_eq!(dataset.demonstrations[0].trajectory.values()[(1, 0)], 2.5);
}

#[test]
fn too_little_data_is_an_error_and_odd_data_a_warning() {
    let mut dataset = PickAndPlace { duration_s: 4.0, ..Default::default() }.dataset(0);
    let few = LearningSettings { rate_hz: 0.5, ..Default::default() };
    let mut short = dataset.clone();
    short.demonstrations.truncate(1);
    assert!(matches!(learn(&short, &few, 0), Err(LearningError::Data(message)) if message.contains("16 states")));
    let wrong = LearningSettings { stiffness: f64::NAN, gate_start: 2.0, ..Default::default() };
    assert!(matches!(learn(&dataset, &wrong, 0), Err(LearningError::Settings(faults)) if faults.len() == 2));
    for demonstration in &mut dataset.demonstrations {
        demonstration.theta_m[0].1 = 0.2;
    }
    let learned = learn(&dataset, &LearningSettings::default(), 0).unwrap();
    assert!(learned.report.warnings.iter().any(|w| w.contains("vary 0 of 1")), "{:?}", learned.report.warnings);
    let asked = |h: f64| cpdmp::learning::ExecutionSettings { theta_m: vec![("block_height_m".to_owned(), h)], ..Default::default() };
    let [near, far] = [0.2, 1e6].map(|h| generate(&learned.skill, &asked(h), 0.1, 1.0).unwrap());
    assert!(near == far, "a parameter without effect has none far away either");
    assert!(learned.skill.extrapolation(&asked(0.3).theta_m).unwrap().is_infinite());
}

#[test]
fn one_short_demonstration_with_a_constant_column_and_no_extras_is_enough() {
    let folder = tempfile::tempdir().unwrap();
    let mut text = "time_s,x_m,y_m\n".to_owned();
    for t in 0..60 {
        let u = f64::from(t) / 59.0;
        text.push_str(&format!("{},{},0.5\n", 2.0 * u + 10.0, u * u * (3.0 - 2.0 * u)));
    }
    let list = "schema_version = 1\nmotion = [\"x_m\", \"y_m\"]\n[[demonstration]]\nfile = \"a.csv\"\n";
    write(folder.path(), list, &[("a.csv", &text)]);
    let learned = learn(&Dataset::read(folder.path()).unwrap(), &LearningSettings::default(), 0).unwrap();
    let path = generate(&learned.skill, &Default::default(), 0.01, 1.2).unwrap();
    let end = path.values().row(path.samples() - 1);
    assert!((end[0] - 1.0).abs() < 1e-3 && (end[1] - 0.5).abs() < 1e-9, "{end}");
    assert!(path.values().iter().all(|x| x.is_finite()));
}
