//! Reads a step log back, so that a stored run can be looked at again.

use std::fs::File;
use std::path::Path;

use nalgebra::{Point3, Vector3, Vector6};

use super::RecordingError;
use super::step_log::STEP_LOG_VERSION;
use super::step_table::StepTable;
use crate::simulation::{AppliedForce, StepRecord};

/// Reads the records of a step log, bit for bit as they were, apart from the poses of the robot's bodies, which it does not hold.
///
/// # Errors
/// When the file cannot be read, is not a step log, is one of a later version, or lacks a column.
pub fn read_step_log(path: &Path) -> Result<Vec<StepRecord>, RecordingError> {
    let io = |source| RecordingError::Io { path: path.to_owned(), source };
    // Opening a pipe could wait for ever.
    if !std::fs::metadata(path).map_err(io)?.is_file() {
        return Err(io(std::io::Error::other("it is no regular file")));
    }
    let file = File::open(path).map_err(io)?;
    let table = StepTable::read(file).map_err(|source| RecordingError::Parquet { path: path.to_owned(), source })?;
    let fault = |message: String| RecordingError::StepLog { path: path.to_owned(), message };
    if table.keys.get("cpdmp.format").map(String::as_str) != Some("step-log") {
        return Err(fault("this Parquet file is not a step log of a run".to_owned()));
    }
    let version = table.keys.get("cpdmp.version").and_then(|version| version.parse().ok()).unwrap_or(0);
    if !(1..=STEP_LOG_VERSION).contains(&version) {
        return Err(fault(format!("version {version} of the step log; this program reads versions up to {STEP_LOG_VERSION}")));
    }
    let objects = objects(&table);
    let missing = |column: String| fault(format!("the step log lacks a column `{column}` of numbers in every row"));
    (0..table.rows).map(|row| record(&table, row, &objects).map_err(missing)).collect()
}

/// The prefixes of the objects' columns, in their order: every pose that belongs to nothing else.
fn objects(table: &StepTable) -> Vec<String> {
    let prefixes = table.names.iter().filter_map(|name| name.strip_suffix("_qw"));
    prefixes.filter(|prefix| !["tool", "reference"].contains(prefix)).map(str::to_owned).collect()
}

/// One row; the name of the column that is missing otherwise.
fn record(table: &StepTable, row: usize, objects: &[String]) -> Result<StepRecord, String> {
    let (real, integer) = (|name: &str| table.real(row, name), |name: &str| table.integer(row, name));
    let vector = |prefix: &str, unit: &str| table.vector(row, prefix, unit);
    let (force, torque) = (vector("force", "_n")?, vector("torque", "_nm")?);
    Ok(StepRecord {
        step: integer("step")? as u64,
        time_s: real("time_s")?,
        joint_position: table.joints(row, "q", "_rad"),
        joint_velocity: table.joints(row, "v", "_rad_per_s"),
        joint_effort: table.joints(row, "effort", "_nm"),
        tool: table.pose(row, "tool")?,
        reference: table.pose(row, "reference")?,
        wrench: Vector6::from_iterator(force.iter().chain(torque.iter()).copied()),
        // Nothing without a force model.
        expected_force: if table.is_null("expected_force_x_n") { Vector3::zeros() } else { vector("expected_force", "_n")? },
        coupling_displacement: vector("coupling", "_m")?,
        deviation: vector("deviation", "_m")?,
        phase: real("phase")?,
        time_fraction: real("time_fraction")?,
        state: integer("state")? as usize,
        beta: real("beta")?,
        activation: real("activation")?,
        gripper_command: real("gripper_command")?,
        gripper_opening: real("gripper_opening")?,
        human: AppliedForce { point: Point3::from(vector("human_point", "_m")?), force: vector("human_force", "_n")? },
        // Logs of earlier programs do not have these.
        tool_force: vector("tool_force", "_n").unwrap_or_else(|_| Vector3::repeat(f64::NAN)),
        tool_impulse: vector("tool_impulse", "_ns").unwrap_or_else(|_| Vector3::repeat(f64::NAN)),
        bodies: Vec::new(),
        objects: objects.iter().map(|prefix| table.pose(row, prefix)).collect::<Result<_, _>>()?,
        touches: Vec::new(),
        kinetic_energy_j: real("kinetic_energy_j")?,
    })
}
