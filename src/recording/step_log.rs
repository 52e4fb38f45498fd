//! The step log `steps.parquet`: every logged step as one row, for analysis without rerun and without this program.

use std::fs::File;
use std::path::Path;

use parquet::data_type::{DoubleType, Int64Type};
use parquet::errors::ParquetError;

use super::RecordingError;
use super::step_columns::{StepColumn, StepValue, step_columns};
use super::table_file::{self, Column, Kind, write_next, write_next_or_none};
use crate::simulation::RunOutcome;

/// Version of the step log's columns, under the key `cpdmp.version` of the file.
pub const STEP_LOG_VERSION: u32 = 1;

/// Rows per row group: 11 min of a log at 100 Hz.
const ROWS_PER_GROUP: usize = 1 << 16;

/// Writes the steps of `outcome` to a Parquet file: [`step_columns`] as its columns, what each means under the file's keys
/// `column.NAME`. What a skill without a force model expects is null. Equal outcomes give equal bytes.
///
/// # Errors
/// When the file cannot be created or written.
pub fn write_step_log(path: &Path, outcome: &RunOutcome) -> Result<(), RecordingError> {
    let file = File::create(path).map_err(|source| RecordingError::Io { path: path.to_owned(), source })?;
    write(file, outcome).map_err(|source| RecordingError::Parquet { path: path.to_owned(), source })
}

fn write(file: File, outcome: &RunOutcome) -> Result<(), ParquetError> {
    let joints = outcome.steps.first().map_or(0, |record| record.joint_position.len());
    let objects: Vec<&str> = outcome.final_objects.iter().map(|object| object.name.as_str()).collect();
    let columns = step_columns(joints, &objects);
    let described: Vec<Column<'_>> = columns.iter().map(|column| (column.name.as_str(), &*column.meaning, kind(column))).collect();
    let mut writer = table_file::open(file, "step", STEP_LOG_VERSION, &described)?;
    for rows in outcome.steps.chunks(ROWS_PER_GROUP) {
        let mut group = writer.next_row_group()?;
        for column in &columns {
            match &column.value {
                StepValue::Integer(value) => write_next::<Int64Type>(&mut group, &rows.iter().map(value).collect::<Vec<_>>())?,
                StepValue::Real(value) => write_next::<DoubleType>(&mut group, &rows.iter().map(value).collect::<Vec<_>>())?,
                StepValue::Expected(value) => {
                    let values: Option<Vec<f64>> = outcome.skill.force.is_some().then(|| rows.iter().map(value).collect());
                    write_next_or_none(&mut group, rows.len(), values.as_deref())?;
                }
            }
        }
        group.close()?;
    }
    writer.close()?;
    Ok(())
}

fn kind(column: &StepColumn) -> Kind {
    match column.value {
        StepValue::Integer(_) => Kind::Integer,
        StepValue::Real(_) => Kind::Real,
        StepValue::Expected(_) => Kind::RealOrNone,
    }
}
