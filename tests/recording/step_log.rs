//! The step log: every number comes back with the bits that the record had, and every column says what it is.

use std::fs::File;
use std::path::{Path, PathBuf};

use cpdmp::recording::{RecordingError, read_step_log, step_columns, write_step_log};
use cpdmp::simulation::{RunOutcome, StepRecord};
use nalgebra::Vector3;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use tempfile::TempDir;

use super::made_up_run::{STEPS, outcome, outcome_of_the_baseline};

fn written(outcome: &RunOutcome) -> (TempDir, PathBuf) {
    let folder = TempDir::new().expect("a folder can be made");
    let path = folder.path().join("steps.parquet");
    write_step_log(&path, outcome).expect("the log is written");
    (folder, path)
}

/// How a record gives the value of a column.
type Value = fn(&StepRecord) -> f64;

/// The values of a column, as bits.
fn column(path: &Path, name: &str) -> Vec<u64> {
    let reader = SerializedFileReader::new(File::open(path).expect("the log is there")).expect("it is Parquet");
    let value = |row: Result<parquet::record::Row, _>| {
        let row = row.expect("the row can be read");
        let (_, field) = row.get_column_iter().find(|(column, _)| *column == name).unwrap_or_else(|| panic!("no column {name}"));
        match field {
            Field::Double(value) => value.to_bits(),
            Field::Long(value) => *value as u64,
            other => panic!("{name} holds {other}"),
        }
    };
    reader.get_row_iter(None).expect("rows can be read").map(value).collect()
}

#[test]
fn every_number_comes_back_bit_for_bit() {
    let mut outcome = outcome();
    outcome.steps[3].expected_force.x = f64::NAN;
    outcome.steps[4].expected_force.x = -0.0;
    let (_folder, path) = written(&outcome);
    let expected: [(&str, Value); 27] = [
        ("time_s", |r| r.time_s),
        ("q1_rad", |r| r.joint_position[0]),
        ("q7_rad", |r| r.joint_position[6]),
        ("v2_rad_per_s", |r| r.joint_velocity[1]),
        ("effort7_nm", |r| r.joint_effort[6]),
        ("tool_x_m", |r| r.tool.translation.x),
        ("tool_z_m", |r| r.tool.translation.z),
        ("tool_qx", |r| r.tool.rotation.i),
        ("tool_qw", |r| r.tool.rotation.w),
        ("reference_y_m", |r| r.reference.translation.y),
        ("reference_qz", |r| r.reference.rotation.k),
        ("force_x_n", |r| r.wrench[0]),
        ("force_z_n", |r| r.wrench[2]),
        ("torque_x_nm", |r| r.wrench[3]),
        ("torque_z_nm", |r| r.wrench[5]),
        ("expected_force_x_n", |r| r.expected_force.x),
        ("coupling_y_m", |r| r.coupling_displacement.y),
        ("phase", |r| r.phase),
        ("time_fraction", |r| r.time_fraction),
        ("beta", |r| r.beta),
        ("activation", |r| r.activation),
        ("gripper_command", |r| r.gripper_command),
        ("gripper_opening", |r| r.gripper_opening),
        ("human_force_x_n", |r| r.human.force.x),
        ("human_point_z_m", |r| r.human.point.z),
        ("toy_x_m", |r| r.objects[3].translation.x),
        ("kinetic_energy_j", |r| r.kinetic_energy_j),
    ];
    for (name, value) in expected {
        let bits: Vec<u64> = outcome.steps.iter().map(|record| value(record).to_bits()).collect();
        assert_eq!(column(&path, name), bits, "{name}");
    }
    for (name, value) in [("step", (|r| r.step) as fn(&StepRecord) -> u64), ("state", |r| r.state as u64)] {
        assert_eq!(column(&path, name), outcome.steps.iter().map(value).collect::<Vec<_>>(), "{name}");
    }
}

/// Contract: what is read is what was written. The text of a number names its bits, and a record's text names every one of its numbers.
#[test]
fn a_log_that_is_read_gives_the_records_back() {
    let outcome = outcome();
    let (_folder, path) = written(&outcome);
    let read = read_step_log(&path).expect("the log is read");
    assert_eq!(read.len(), STEPS);
    for (read, written) in read.iter().zip(&outcome.steps) {
        let without_bodies = StepRecord { bodies: Vec::new(), ..written.clone() };
        assert_eq!(format!("{read:?}"), format!("{without_bodies:?}"));
    }
}

/// Contract: a skill without a force model expects no force, which is not a force of zero; such a log is read back, too.
#[test]
fn what_nobody_expects_is_null() {
    let outcome = outcome_of_the_baseline();
    let (_folder, path) = written(&outcome);
    let reader = SerializedFileReader::new(File::open(&path).expect("the log is there")).expect("it is Parquet");
    for row in reader.get_row_iter(None).expect("rows can be read") {
        let row = row.expect("the row can be read");
        let null: Vec<&String> = row.get_column_iter().filter(|(_, field)| **field == Field::Null).map(|(name, _)| name).collect();
        assert_eq!(null, ["expected_force_x_n", "expected_force_y_n", "expected_force_z_n"]);
    }
    let read = read_step_log(&path).expect("the log is read");
    assert_eq!(read.len(), outcome.steps.len());
    assert!(read.iter().zip(&outcome.steps).all(|(read, made)| read.wrench == made.wrench && read.expected_force == Vector3::zeros()));
}

#[test]
fn what_is_not_a_step_log_is_told_with_its_name() {
    let folder = TempDir::new().expect("a folder can be made");
    let path = folder.path().join("steps.parquet");
    for content in [&b""[..], b"PAR1", b"step,time_s\n0,0.0\n"] {
        std::fs::write(&path, content).expect("written");
        let error = read_step_log(&path).expect_err("no Parquet");
        assert!(matches!(error, RecordingError::Parquet { .. }) && error.to_string().contains("steps.parquet"), "{error}");
    }
    cpdmp::recording::write_path_log(&path, &[]).expect("a log of another kind");
    let error = read_step_log(&path).expect_err("paths");
    assert!(error.to_string().contains("not a step log"), "{error}");
}

#[test]
fn every_column_is_documented_in_the_file_and_named_once() {
    let (_folder, path) = written(&outcome());
    let reader = SerializedFileReader::new(File::open(path).unwrap()).unwrap();
    let metadata = reader.metadata().file_metadata();
    let keys = metadata.key_value_metadata().expect("the file has keys");
    let mut names: Vec<&str> = metadata.schema_descr().columns().iter().map(|column| column.name()).collect();
    for name in &names {
        let documented = keys.iter().any(|key| key.key == format!("column.{name}") && key.value.as_ref().is_some_and(|v| !v.is_empty()));
        assert!(documented, "{name} is not documented");
    }
    assert_eq!(metadata.num_rows(), STEPS as i64);
    names.sort_unstable();
    assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "a name twice in {names:?}");
}

#[test]
fn an_object_that_is_called_like_a_column_gets_a_name_of_its_own() {
    let names: Vec<String> = step_columns(7, &["tool", "toy"]).into_iter().map(|column| column.name).collect();
    assert_eq!(names.iter().filter(|name| *name == "tool_x_m").count(), 1);
    assert!(names.contains(&"object_tool_x_m".to_owned()) && names.contains(&"toy_qw".to_owned()));
}

#[test]
fn equal_runs_give_equal_bytes() {
    let ((_a, first), (_b, second)) = (written(&outcome()), written(&outcome()));
    assert!(std::fs::read(first).unwrap() == std::fs::read(second).unwrap());
}

#[test]
fn a_run_without_steps_gives_an_empty_table() {
    let (_folder, path) = written(&RunOutcome { steps: Vec::new(), ..outcome() });
    assert_eq!(column(&path, "time_s"), Vec::<u64>::new());
}

#[test]
fn a_log_that_cannot_be_written_names_the_file() {
    let error = write_step_log(Path::new("/nowhere/steps.parquet"), &outcome()).unwrap_err();
    assert!(matches!(error, RecordingError::Io { .. }) && error.to_string().contains("/nowhere/steps.parquet"), "{error}");
    if cfg!(target_os = "linux") {
        let error = write_step_log(Path::new("/dev/full"), &outcome()).expect_err("the disk is full");
        assert!(error.to_string().contains("/dev/full"), "{error}");
    }
}
