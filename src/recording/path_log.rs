//! The path log `paths.parquet` of planar runs: every point of every path as one row.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

use super::RecordingError;

/// Version of the path log's columns, under the key `cpdmp.version` of the file.
pub const PATH_LOG_VERSION: u32 = 1;

/// The columns of a path log: name and meaning.
pub const PATH_COLUMNS: [(&str, &str); 5] = [
    ("method", "what made the path; `demonstration` for what was shown"),
    ("setting", "the setting that it is for, as in report.json, or the name of the demonstration"),
    ("time_fraction", "elapsed fraction of the movement, from 0 to 1"),
    ("x_m", "place along x (m)"),
    ("y_m", "place along y (m)"),
];

/// One path.
#[derive(Clone, Debug, PartialEq)]
pub struct LoggedPath<'a> {
    /// What made it.
    pub method: &'a str,
    /// The setting that it is for.
    pub setting: &'a str,
    /// Places (m), equally timed.
    pub points_m: &'a [[f64; 2]],
}

/// Writes paths to a Parquet file with [`PATH_COLUMNS`], one row group per path, in their order. Equal paths give equal bytes.
///
/// # Errors
/// When the file cannot be created or written.
pub fn write_path_log(path: &Path, paths: &[LoggedPath<'_>]) -> Result<(), RecordingError> {
    let file = File::create(path).map_err(|source| RecordingError::Io { path: path.to_owned(), source })?;
    write(file, paths).map_err(|source| RecordingError::Parquet { path: path.to_owned(), source })
}

fn write(file: File, paths: &[LoggedPath<'_>]) -> Result<(), ParquetError> {
    let mut writer = SerializedFileWriter::new(file, schema()?, Arc::new(properties()))?;
    for path in paths {
        let rows = path.points_m.len();
        let last = rows.saturating_sub(1).max(1) as f64;
        let mut group = writer.next_row_group()?;
        words(&mut group, path.method, rows)?;
        words(&mut group, path.setting, rows)?;
        numbers(&mut group, &(0..rows).map(|row| row as f64 / last).collect::<Vec<_>>())?;
        for axis in 0..2 {
            numbers(&mut group, &path.points_m.iter().map(|point| point[axis]).collect::<Vec<_>>())?;
        }
        group.close()?;
    }
    writer.close()?;
    Ok(())
}

fn schema() -> Result<Arc<Type>, ParquetError> {
    let field = |(name, _): &(&str, &str)| {
        let text = matches!(*name, "method" | "setting");
        let physical = if text { Physical::BYTE_ARRAY } else { Physical::DOUBLE };
        let logical = text.then_some(LogicalType::String);
        let builder = Type::primitive_type_builder(name, physical).with_repetition(Repetition::REQUIRED).with_logical_type(logical);
        Ok(Arc::new(builder.build()?))
    };
    let fields = PATH_COLUMNS.iter().map(field).collect::<Result<_, ParquetError>>()?;
    Ok(Arc::new(Type::group_type_builder("path").with_fields(fields).build()?))
}

fn properties() -> WriterProperties {
    let entry = |key: String, value: &str| KeyValue::new(key, value.to_owned());
    let mut keys = vec![entry("cpdmp.format".into(), "path-log"), entry("cpdmp.version".into(), &PATH_LOG_VERSION.to_string())];
    keys.extend(PATH_COLUMNS.iter().map(|(name, meaning)| entry(format!("column.{name}"), meaning)));
    WriterProperties::builder()
        .set_created_by(format!("cpdmp {}", env!("CARGO_PKG_VERSION")))
        .set_compression(Compression::SNAPPY)
        .set_key_value_metadata(Some(keys))
        .build()
}

fn words(group: &mut SerializedRowGroupWriter<'_, File>, word: &str, rows: usize) -> Result<(), ParquetError> {
    let mut column = group.next_column()?.ok_or_else(too_few_columns)?;
    column.typed::<ByteArrayType>().write_batch(&vec![ByteArray::from(word); rows], None, None)?;
    column.close()
}

fn numbers(group: &mut SerializedRowGroupWriter<'_, File>, values: &[f64]) -> Result<(), ParquetError> {
    let mut column = group.next_column()?.ok_or_else(too_few_columns)?;
    column.typed::<DoubleType>().write_batch(values, None, None)?;
    column.close()
}

fn too_few_columns() -> ParquetError {
    ParquetError::General("the schema has fewer columns than a path".to_owned())
}
