//! The state log `state_hashes.parquet`: hashes of every moving body's state every few steps, so that a repetition can be held against a run.

use std::fs::File;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use parquet::data_type::{ByteArray, ByteArrayType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::reader::SerializedFileReader;
use parquet::record::{Row, RowAccessor};

use super::RecordingError;
use super::table_file::{self, Kind, write_next};
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
    let io = |source| RecordingError::Io { path: path.to_owned(), source };
    // Opening a pipe could wait for ever.
    if !std::fs::metadata(path).map_err(io)?.is_file() {
        return Err(io(std::io::Error::other("it is no regular file")));
    }
    let file = File::open(path).map_err(io)?;
    // The library is not free of panics on damaged files; nothing that it leaves behind is used afterwards.
    let read = catch_unwind(AssertUnwindSafe(|| read(file)));
    let read = read.unwrap_or_else(|_| Err(ParquetError::General("a damaged file".to_owned())));
    read.map_err(|source| RecordingError::Parquet { path: path.to_owned(), source })
}

fn write(file: File, traces: &[WorldTrace]) -> Result<(), ParquetError> {
    let kind = |name: &str| if matches!(name, "phase" | "body") { Kind::Text } else { Kind::Integer };
    let mut writer = table_file::open(file, "state", STATE_LOG_VERSION, &STATE_COLUMNS.map(|(name, meaning)| (name, meaning, kind(name))))?;
    for world in traces {
        let trace = &world.trace;
        let bodies = trace.bodies.len();
        let rows = trace.steps.len() * bodies;
        let of_steps = |value: &dyn Fn(usize) -> i64| (0..rows).map(|row| value(row / bodies)).collect::<Vec<_>>();
        let names: Vec<ByteArray> = (0..rows).map(|row| ByteArray::from(trace.bodies[row % bodies].as_str())).collect();
        let mut group = writer.next_row_group()?;
        write_next::<ByteArrayType>(&mut group, &vec![ByteArray::from(world.phase.as_str()); rows])?;
        write_next::<Int64Type>(&mut group, &vec![world.number as i64; rows])?;
        write_next::<Int64Type>(&mut group, &of_steps(&|index| trace.steps[index] as i64))?;
        write_next::<Int64Type>(&mut group, &of_steps(&|index| trace.hashes[index] as i64))?;
        write_next::<ByteArrayType>(&mut group, &names)?;
        for quantity in 0..4 {
            write_next::<Int64Type>(&mut group, &trace.quantities.iter().map(|hashes| i64::from(hashes[quantity])).collect::<Vec<_>>())?;
        }
        group.close()?;
    }
    writer.close()?;
    Ok(())
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
