//! The table as a Parquet file: written row group by row group, read row by row, so that its length never matters to memory.

use std::fs::File;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::record::Field;
use parquet::record::reader::RowIter;
use parquet::schema::types::Type;

use super::table::Head;
use super::{BatchError, Cell, CellKind, Column};

/// What marks a table as one of ours, under the key `cpdmp.format` of the file.
const FORMAT: &str = "sweep-table";

/// Version of the table's columns, under the key `cpdmp.version`.
const VERSION: u32 = 1;

/// Rows that are in memory at a time.
const ROWS_PER_GROUP: usize = 1024;

/// Writes a table beside its place and renames it, so that there is never half of it. Equal rows give equal bytes.
///
/// # Errors
/// The first row that cannot be had, or what the file system refuses.
pub(super) fn write_table(path: &Path, head: &Head, rows: impl Iterator<Item = Result<Vec<Cell>, BatchError>>) -> Result<(), BatchError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let beside = path.with_file_name(format!("{name}.partial"));
    let file = File::create(&beside).map_err(BatchError::writing(path))?;
    write(file, path, head, rows).inspect_err(|_| _ = std::fs::remove_file(&beside))?;
    std::fs::rename(&beside, path).map_err(BatchError::writing(path))
}

fn write(file: File, path: &Path, head: &Head, mut rows: impl Iterator<Item = Result<Vec<Cell>, BatchError>>) -> Result<(), BatchError> {
    let refused = |source| BatchError::Table { path: path.to_path_buf(), source };
    let schema = schema(&head.columns).map_err(refused)?;
    let mut writer = SerializedFileWriter::new(&file, schema, Arc::new(properties(head))).map_err(refused)?;
    loop {
        let group = rows.by_ref().take(ROWS_PER_GROUP).collect::<Result<Vec<_>, _>>()?;
        if group.is_empty() {
            break;
        }
        write_group(&mut writer, &head.columns, group).map_err(refused)?;
    }
    writer.close().map_err(refused)?;
    file.sync_all().map_err(BatchError::writing(path))
}

fn write_group(writer: &mut SerializedFileWriter<&File>, columns: &[Column], rows: Vec<Vec<Cell>>) -> Result<(), ParquetError> {
    let mut group = writer.next_row_group()?;
    for (index, column) in columns.iter().enumerate() {
        let cells = || rows.iter().map(|row| row.get(index).cloned().unwrap_or(Cell::Null).among(column.kind));
        match column.kind {
            CellKind::Flag => fill::<BoolType>(&mut group, cells(), |cell| if let Cell::Flag(flag) = cell { Some(flag) } else { None }),
            CellKind::Whole => {
                fill::<Int64Type>(&mut group, cells(), |cell| if let Cell::Whole(whole) = cell { Some(whole) } else { None })
            }
            CellKind::Number => fill::<DoubleType>(&mut group, cells(), |cell| if let Cell::Number(x) = cell { Some(x) } else { None }),
            CellKind::Text => fill::<ByteArrayType>(&mut group, cells(), |cell| {
                if let Cell::Text(text) = cell { Some(ByteArray::from(text.into_bytes())) } else { None }
            }),
        }?;
    }
    group.close()?;
    Ok(())
}

fn fill<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, &File>,
    cells: impl Iterator<Item = Cell>,
    value: impl Fn(Cell) -> Option<T::T>,
) -> Result<(), ParquetError> {
    let (mut values, mut levels) = (Vec::new(), Vec::new());
    for found in cells.map(value) {
        levels.push(i16::from(found.is_some()));
        values.extend(found);
    }
    let too_few = || ParquetError::General("the schema has fewer columns than a row".to_owned());
    let mut column = group.next_column()?.ok_or_else(too_few)?;
    column.typed::<T>().write_batch(&values, Some(&levels), None)?;
    column.close()
}

fn schema(columns: &[Column]) -> Result<Arc<Type>, ParquetError> {
    let field = |column: &Column| {
        let physical = match column.kind {
            CellKind::Flag => Physical::BOOLEAN,
            CellKind::Whole => Physical::INT64,
            CellKind::Number => Physical::DOUBLE,
            CellKind::Text => Physical::BYTE_ARRAY,
        };
        let logical = (column.kind == CellKind::Text).then_some(LogicalType::String);
        let builder = Type::primitive_type_builder(&column.name, physical);
        Ok(Arc::new(builder.with_repetition(Repetition::OPTIONAL).with_logical_type(logical).build()?))
    };
    let fields = columns.iter().map(field).collect::<Result<_, ParquetError>>()?;
    Ok(Arc::new(Type::group_type_builder("run").with_fields(fields).build()?))
}

fn properties(head: &Head) -> WriterProperties {
    let entry = |key: &str, value: String| KeyValue::new(key.to_owned(), value);
    let mut keys = vec![
        entry("cpdmp.format", FORMAT.to_owned()),
        entry("cpdmp.version", VERSION.to_string()),
        entry("cpdmp.scenario", head.scenario.clone()),
        entry("cpdmp.sweep_hash", head.hash.clone()),
        entry("cpdmp.members", head.members.to_string()),
    ];
    keys.extend(head.shard.iter().map(|shard| entry("cpdmp.shard", shard.clone())));
    keys.extend(head.columns.iter().map(|column| entry(&format!("column.{}", column.name), column.meaning.clone())));
    WriterProperties::builder()
        .set_created_by(format!("cpdmp {}", env!("CARGO_PKG_VERSION")))
        .set_compression(Compression::SNAPPY)
        .set_key_value_metadata(Some(keys))
        .build()
}

/// A table that is read row by row.
pub(super) struct TableFile {
    pub path: PathBuf,
    pub head: Head,
    rows: RowIter<'static>,
}

impl TableFile {
    /// Opens a table.
    ///
    /// # Errors
    /// When the file is not there, or is no whole table of a sweep.
    pub fn open(path: &Path) -> Result<Self, BatchError> {
        let odd = |what: String| BatchError::NotATable { path: path.to_path_buf(), what };
        // Opening a pipe could wait for ever.
        if !std::fs::metadata(path).map_err(BatchError::reading(path))?.is_file() {
            return Err(odd("no regular file".to_owned()));
        }
        let file = File::open(path).map_err(BatchError::reading(path))?;
        // The library is not free of panics on damaged files; nothing that it leaves behind is used afterwards.
        let reader = match catch_unwind(AssertUnwindSafe(|| SerializedFileReader::new(file))) {
            Ok(Ok(reader)) => reader,
            Ok(Err(error)) => return Err(odd(error.to_string())),
            Err(_) => return Err(odd("a damaged file".to_owned())),
        };
        let head = head(&reader).map_err(odd)?;
        Ok(Self { path: path.to_path_buf(), head, rows: RowIter::from_file_into(Box::new(reader)) })
    }

    /// The next row.
    ///
    /// # Errors
    /// When the file is damaged.
    pub fn next(&mut self) -> Result<Option<Vec<Cell>>, BatchError> {
        let odd = |what: String| BatchError::NotATable { path: self.path.clone(), what };
        match catch_unwind(AssertUnwindSafe(|| self.rows.next())) {
            Ok(None) => Ok(None),
            Ok(Some(Ok(row))) => Ok(Some(row.get_column_iter().map(|(_, field)| cell(field)).collect())),
            Ok(Some(Err(error))) => Err(odd(error.to_string())),
            Err(_) => Err(odd("a damaged file".to_owned())),
        }
    }
}

fn cell(field: &Field) -> Cell {
    match field {
        Field::Bool(flag) => Cell::Flag(*flag),
        Field::Long(whole) => Cell::Whole(*whole),
        Field::Double(number) => Cell::Number(*number),
        Field::Str(text) => Cell::Text(text.clone()),
        _ => Cell::Null,
    }
}

/// What a table says about itself, or what is odd about it.
fn head(reader: &SerializedFileReader<File>) -> Result<Head, String> {
    let about = reader.metadata().file_metadata();
    let keys = about.key_value_metadata().cloned().unwrap_or_default();
    let find = |key: &str| keys.iter().find(|entry| entry.key == key).and_then(|entry| entry.value.clone());
    if find("cpdmp.format").as_deref() != Some(FORMAT) {
        return Err("a Parquet file of another program, or another kind of file".to_owned());
    }
    let version = find("cpdmp.version").unwrap_or_default();
    if version != VERSION.to_string() {
        return Err(format!("version {version} of the format; this program reads version {VERSION}"));
    }
    let need = |key: &str| find(key).ok_or_else(|| format!("it lacks `{key}`"));
    let column = |index: usize| {
        let described = about.schema_descr().column(index);
        let name = described.name().to_owned();
        let kind = match described.physical_type() {
            Physical::BOOLEAN => CellKind::Flag,
            Physical::INT64 => CellKind::Whole,
            Physical::DOUBLE => CellKind::Number,
            _ => CellKind::Text,
        };
        let meaning = find(&format!("column.{name}")).unwrap_or_default();
        Column { name, kind, meaning }
    };
    Ok(Head {
        scenario: need("cpdmp.scenario")?,
        hash: need("cpdmp.sweep_hash")?,
        members: need("cpdmp.members")?.parse().map_err(|_| "`cpdmp.members` is no number".to_owned())?,
        shard: find("cpdmp.shard"),
        columns: (0..about.schema_descr().num_columns()).map(column).collect(),
    })
}
