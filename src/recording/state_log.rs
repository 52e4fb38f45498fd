//! The state log `state_hashes.parquet`: hashes of every moving body's state every few steps, so that a repetition can be held against a run.

use std::fs::File;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::SerializedFileReader;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::record::{Row, RowAccessor};
use parquet::schema::types::Type;

use super::RecordingError;
use crate::simulation::WorldTrace;
use crate::world::StateTrace;

/// Version of the state log's columns, under the key `cpdmp.version` of the file.
pub const STATE_LOG_VERSION: u32 = 1;

/// The columns of a state log: name and meaning.
pub const STATE_COLUMNS: [(&str, &str); 9] = [
    ("phase", "part of the run"),
    ("number", "number of the world in the phase, from 0"),
    ("step", "number of the engine step; of the sample, for what is no world"),
    ("state_hash", "XXH3-64 over all states of the world up to this step, as a signed number"),
    ("body", "the moving body"),
    ("position", "lower 32 bits of the XXH3-64 of its position in this step"),
    ("orientation", "the same of its orientation"),
    ("linear_velocity", "the same of its linear velocity"),
    ("angular_velocity", "the same of its angular velocity"),
];

/// Writes traces with [`STATE_COLUMNS`], one row per step and body, one row group per world. Equal traces give equal bytes.
///
/// # Errors
/// When the file cannot be created or written.
pub fn write_state_log(path: &Path, traces: &[WorldTrace]) -> Result<(), RecordingError> {
    let file = File::create(path).map_err(|source| RecordingError::Io { path: path.to_owned(), source })?;
    write(file, traces).map_err(|source| RecordingError::Parquet { path: path.to_owned(), source })
}

/// Reads what [`write_state_log`] wrote.
///
/// # Errors
/// When the file is not there or damaged.
pub fn read_state_log(path: &Path) -> Result<Vec<WorldTrace>, RecordingError> {
    let file = File::open(path).map_err(|source| RecordingError::Io { path: path.to_owned(), source })?;
    // The library is not free of panics on damaged files; nothing that it leaves behind is used afterwards.
    let read = catch_unwind(AssertUnwindSafe(|| read(file)));
    let read = read.unwrap_or_else(|_| Err(ParquetError::General("a damaged file".to_owned())));
    read.map_err(|source| RecordingError::Parquet { path: path.to_owned(), source })
}

fn write(file: File, traces: &[WorldTrace]) -> Result<(), ParquetError> {
    let mut writer = SerializedFileWriter::new(file, schema()?, Arc::new(properties()))?;
    for world in traces {
        let trace = &world.trace;
        let bodies = trace.bodies.len();
        let rows = trace.steps.len() * bodies;
        let of_steps = |value: &dyn Fn(usize) -> i64| (0..rows).map(|row| value(row / bodies)).collect::<Vec<_>>();
        let mut group = writer.next_row_group()?;
        texts(&mut group, (0..rows).map(|_| world.phase.as_str()))?;
        numbers(&mut group, &vec![world.number as i64; rows])?;
        numbers(&mut group, &of_steps(&|index| trace.steps[index] as i64))?;
        numbers(&mut group, &of_steps(&|index| trace.hashes[index] as i64))?;
        texts(&mut group, (0..rows).map(|row| trace.bodies[row % bodies].as_str()))?;
        for quantity in 0..4 {
            numbers(&mut group, &trace.quantities.iter().map(|hashes| i64::from(hashes[quantity])).collect::<Vec<_>>())?;
        }
        group.close()?;
    }
    writer.close()?;
    Ok(())
}

fn schema() -> Result<Arc<Type>, ParquetError> {
    let field = |(name, _): &(&str, &str)| {
        let text = matches!(*name, "phase" | "body");
        let physical = if text { Physical::BYTE_ARRAY } else { Physical::INT64 };
        let logical = text.then_some(LogicalType::String);
        let builder = Type::primitive_type_builder(name, physical).with_repetition(Repetition::REQUIRED).with_logical_type(logical);
        Ok(Arc::new(builder.build()?))
    };
    let fields = STATE_COLUMNS.iter().map(field).collect::<Result<_, ParquetError>>()?;
    Ok(Arc::new(Type::group_type_builder("state").with_fields(fields).build()?))
}

fn properties() -> WriterProperties {
    let entry = |key: String, value: &str| KeyValue::new(key, value.to_owned());
    let mut keys = vec![entry("cpdmp.format".into(), "state-log"), entry("cpdmp.version".into(), &STATE_LOG_VERSION.to_string())];
    keys.extend(STATE_COLUMNS.iter().map(|(name, meaning)| entry(format!("column.{name}"), meaning)));
    WriterProperties::builder()
        .set_created_by(format!("cpdmp {}", env!("CARGO_PKG_VERSION")))
        .set_compression(Compression::SNAPPY)
        .set_key_value_metadata(Some(keys))
        .build()
}

fn texts<'a>(group: &mut SerializedRowGroupWriter<'_, File>, words: impl Iterator<Item = &'a str>) -> Result<(), ParquetError> {
    let mut column = group.next_column()?.ok_or_else(too_few_columns)?;
    column.typed::<ByteArrayType>().write_batch(&words.map(ByteArray::from).collect::<Vec<_>>(), None, None)?;
    column.close()
}

fn numbers(group: &mut SerializedRowGroupWriter<'_, File>, values: &[i64]) -> Result<(), ParquetError> {
    let mut column = group.next_column()?.ok_or_else(too_few_columns)?;
    column.typed::<Int64Type>().write_batch(values, None, None)?;
    column.close()
}

fn too_few_columns() -> ParquetError {
    ParquetError::General("the schema has fewer columns than a state".to_owned())
}

fn read(file: File) -> Result<Vec<WorldTrace>, ParquetError> {
    let mut traces: Vec<WorldTrace> = Vec::new();
    for row in SerializedFileReader::new(file)?.into_iter() {
        add(&mut traces, &row?)?;
    }
    Ok(traces)
}

/// Adds one row: rows come world by world, step by step, body by body.
fn add(traces: &mut Vec<WorldTrace>, row: &Row) -> Result<(), ParquetError> {
    let (phase, number) = (row.get_string(0)?.clone(), row.get_long(1)? as u64);
    let (step, hash, body) = (row.get_long(2)? as u64, row.get_long(3)? as u64, row.get_string(4)?);
    if traces.last().is_none_or(|world| (&world.phase, world.number) != (&phase, number)) {
        traces.push(WorldTrace { phase, number, trace: StateTrace::default() });
    }
    let Some(world) = traces.last_mut() else { return Ok(()) };
    let trace = &mut world.trace;
    if trace.steps.last() != Some(&step) {
        trace.steps.push(step);
        trace.hashes.push(hash);
    }
    if trace.steps.len() == 1 {
        trace.bodies.push(body.clone());
    }
    let mut quantities = [0; 4];
    for (index, quantity) in quantities.iter_mut().enumerate() {
        *quantity = row.get_long(5 + index)? as u32;
    }
    trace.quantities.push(quantities);
    Ok(())
}
