//! The step log `steps.parquet`: every logged step as one row, for analysis without rerun and without this program.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{Compression, Repetition, Type as Physical};
use parquet::data_type::{DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

use super::RecordingError;
use super::step_columns::{StepColumn, StepValue, step_columns};
use crate::simulation::{RunOutcome, StepRecord};

/// Version of the step log's columns, under the key `cpdmp.version` of the file.
pub const STEP_LOG_VERSION: u32 = 1;

/// Rows per row group: 11 min of a log at 100 Hz.
const ROWS_PER_GROUP: usize = 1 << 16;

/// Writes the steps of `outcome` to a Parquet file: [`step_columns`] as its columns, what each means under the file's keys
/// `column.NAME`. Equal outcomes give equal bytes.
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
    let mut writer = SerializedFileWriter::new(file, schema(&columns)?, Arc::new(properties(&columns)))?;
    for rows in outcome.steps.chunks(ROWS_PER_GROUP) {
        let mut group = writer.next_row_group()?;
        for column in &columns {
            write_column(&mut group, column, rows)?;
        }
        group.close()?;
    }
    writer.close()?;
    Ok(())
}

fn schema(columns: &[StepColumn]) -> Result<Arc<Type>, ParquetError> {
    let field = |column: &StepColumn| {
        let physical = match column.value {
            StepValue::Integer(_) => Physical::INT64,
            StepValue::Real(_) => Physical::DOUBLE,
        };
        Ok(Arc::new(Type::primitive_type_builder(&column.name, physical).with_repetition(Repetition::REQUIRED).build()?))
    };
    let fields = columns.iter().map(field).collect::<Result<_, ParquetError>>()?;
    Ok(Arc::new(Type::group_type_builder("step").with_fields(fields).build()?))
}

fn properties(columns: &[StepColumn]) -> WriterProperties {
    let entry = |key: String, value: &str| KeyValue::new(key, value.to_owned());
    let mut keys = vec![entry("cpdmp.format".into(), "step-log"), entry("cpdmp.version".into(), &STEP_LOG_VERSION.to_string())];
    keys.extend(columns.iter().map(|column| entry(format!("column.{}", column.name), &column.meaning)));
    WriterProperties::builder()
        .set_created_by(format!("cpdmp {}", env!("CARGO_PKG_VERSION")))
        .set_compression(Compression::SNAPPY)
        .set_key_value_metadata(Some(keys))
        .build()
}

fn write_column(group: &mut SerializedRowGroupWriter<File>, column: &StepColumn, rows: &[StepRecord]) -> Result<(), ParquetError> {
    let missing = || ParquetError::General(format!("the schema has no column for {}", column.name));
    let mut writer = group.next_column()?.ok_or_else(missing)?;
    match &column.value {
        StepValue::Integer(value) => {
            let values: Vec<i64> = rows.iter().map(value).collect();
            writer.typed::<Int64Type>().write_batch(&values, None, None)?;
        }
        StepValue::Real(value) => {
            let values: Vec<f64> = rows.iter().map(value).collect();
            writer.typed::<DoubleType>().write_batch(&values, None, None)?;
        }
    }
    writer.close()
}
