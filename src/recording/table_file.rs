//! What the Parquet files of a run have in common: named columns with a meaning each, a format with a version. A column has a value in every
//! row, or, where it may, in none.

use std::fs::File;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{DataType, DoubleType};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Integer,
    Real,
    /// A real number in every row or in none.
    RealOrNone,
    Text,
}

/// A column: its name, its meaning, and what it holds.
pub(super) type Column<'a> = (&'a str, &'a str, Kind);

/// Opens a table whose rows are named `row` and whose format is `row-log`; the keys of the file tell version and columns.
pub(super) fn open(file: File, row: &str, version: u32, columns: &[Column<'_>]) -> Result<SerializedFileWriter<File>, ParquetError> {
    SerializedFileWriter::new(file, schema(row, columns)?, Arc::new(properties(row, version, columns)))
}

/// Writes the next column of a group of rows.
pub(super) fn write_next<T: DataType>(group: &mut SerializedRowGroupWriter<'_, File>, values: &[T::T]) -> Result<(), ParquetError> {
    let mut column = group.next_column()?.ok_or_else(missing)?;
    column.typed::<T>().write_batch(values, None, None)?;
    column.close()
}

/// Writes the next column, one that may have no values: these, or null in each of `rows` rows.
pub(super) fn write_next_or_none(
    group: &mut SerializedRowGroupWriter<'_, File>,
    rows: usize,
    values: Option<&[f64]>,
) -> Result<(), ParquetError> {
    let mut column = group.next_column()?.ok_or_else(missing)?;
    let defined = vec![i16::from(values.is_some()); rows];
    column.typed::<DoubleType>().write_batch(values.unwrap_or_default(), Some(&defined), None)?;
    column.close()
}

fn missing() -> ParquetError {
    ParquetError::General("the schema has fewer columns than a row".to_owned())
}

fn schema(row: &str, columns: &[Column<'_>]) -> Result<Arc<Type>, ParquetError> {
    let field = |(name, _, kind): &Column<'_>| {
        let (physical, logical) = match kind {
            Kind::Integer => (Physical::INT64, None),
            Kind::Real | Kind::RealOrNone => (Physical::DOUBLE, None),
            Kind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        let repetition = if *kind == Kind::RealOrNone { Repetition::OPTIONAL } else { Repetition::REQUIRED };
        let builder = Type::primitive_type_builder(name, physical).with_repetition(repetition).with_logical_type(logical);
        Ok(Arc::new(builder.build()?))
    };
    let fields = columns.iter().map(field).collect::<Result<_, ParquetError>>()?;
    Ok(Arc::new(Type::group_type_builder(row).with_fields(fields).build()?))
}

fn properties(row: &str, version: u32, columns: &[Column<'_>]) -> WriterProperties {
    let entry = |key: String, value: &str| KeyValue::new(key, value.to_owned());
    let mut keys = vec![entry("cpdmp.format".into(), &format!("{row}-log")), entry("cpdmp.version".into(), &version.to_string())];
    keys.extend(columns.iter().map(|(name, meaning, _)| entry(format!("column.{name}"), meaning)));
    WriterProperties::builder()
        .set_created_by(format!("cpdmp {}", env!("CARGO_PKG_VERSION")))
        .set_compression(Compression::SNAPPY)
        .set_key_value_metadata(Some(keys))
        .build()
}
