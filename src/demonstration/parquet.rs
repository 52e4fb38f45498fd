//! Samples as Parquet: flat columns of doubles, floats or integers; written as doubles, bit for bit.

use std::fs::File;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;

use ::parquet::basic::{Compression, ConvertedType, LogicalType, Repetition, Type as Physical};
use ::parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use ::parquet::data_type::{DataType, DoubleType};
use ::parquet::errors::ParquetError;
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::reader::{FileReader, SerializedFileReader};
use ::parquet::file::writer::SerializedFileWriter;
use ::parquet::schema::types::{ColumnDescriptor, Type};

use super::table::{Column, MOST_CELLS, Table};
use super::{DemonstrationError, Fault, Trajectory, parquet_pages};

/// Records read at a time.
const CHUNK: usize = 1 << 14;

/// Reads a file; `place` is how faults call it.
pub(super) fn read(bytes: &[u8], path: &Path, place: &str) -> Result<Table, DemonstrationError> {
    let invalid = |found: String| Err(DemonstrationError::Invalid(vec![Fault::new(place, found, "a whole Parquet file")]));
    // Both marks are looked at first: the common damage, a file cut short, gets words of its own.
    if bytes.len() < 12 || !bytes.starts_with(b"PAR1") || !bytes.ends_with(b"PAR1") {
        return invalid("no Parquet file, or one that was cut short".to_owned());
    }
    // The library is not free of panics on damaged files; nothing it leaves behind is used afterwards.
    match catch_unwind(AssertUnwindSafe(|| columns(bytes, path))) {
        Ok(Ok(columns)) => {
            let samples = columns.first().map_or(0, |column| column.values.len());
            if columns.iter().any(|column| column.values.len() != samples) {
                return invalid("columns of different lengths: a damaged file".to_owned());
            }
            Ok(Table { place: place.to_owned(), columns, rows: (1..=samples).collect(), header: true })
        }
        Ok(Err(error)) if error.to_string().contains("Disabled feature") => {
            let packed = "packed in a way that this program does not unpack";
            Err(DemonstrationError::Invalid(vec![Fault::new(
                place,
                format!("{packed} ({error})"),
                "snappy, zstd, lz4 (raw) or no packing: a gzip page does not say how large it is",
            )]))
        }
        Ok(Err(error)) => invalid(format!("a damaged file ({error})")),
        Err(_) => invalid("a damaged file".to_owned()),
    }
}

fn columns(bytes: &[u8], path: &Path) -> Result<Vec<Column>, ParquetError> {
    let reader = SerializedFileReader::new(File::open(path)?)?;
    parquet_pages::check(bytes, reader.metadata())?;
    let schema = reader.metadata().file_metadata().schema_descr_ptr();
    let rows = usize::try_from(reader.metadata().file_metadata().num_rows()).unwrap_or(usize::MAX);
    if rows.saturating_mul(schema.num_columns()) > MOST_CELLS {
        return Err(ParquetError::General(format!("it claims more than {MOST_CELLS} cells")));
    }
    let name = |i: usize| schema.column(i).path().string();
    let mut columns: Vec<Column> = (0..schema.num_columns()).map(|i| Column { name: name(i), ..Column::default() }).collect();
    for group in 0..reader.num_row_groups() {
        let group = reader.get_row_group(group)?;
        for (i, column) in columns.iter_mut().enumerate() {
            if schema.column(i).max_rep_level() > 0 {
                return Err(ParquetError::General(format!("column {} holds lists; one number per row is read", column.name)));
            }
            let most = schema.column(i).max_def_level();
            let scale = decimals(&schema.column(i), &column.name)?;
            match group.get_column_reader(i)? {
                ColumnReader::DoubleColumnReader(r) => append(r, most, rows, column, |x| Ok(*x))?,
                ColumnReader::FloatColumnReader(r) => append(r, most, rows, column, |x| Ok(f64::from(*x)))?,
                ColumnReader::Int32ColumnReader(r) => append(r, most, rows, column, |x| Ok(f64::from(*x) / scale))?,
                ColumnReader::Int64ColumnReader(r) => append(r, most, rows, column, |x| Ok(*x as f64 / scale))?,
                ColumnReader::BoolColumnReader(r) => append(r, most, rows, column, |x| Ok(f64::from(u8::from(*x))))?,
                ColumnReader::ByteArrayColumnReader(r) => {
                    append(r, most, rows, column, |x| Err(String::from_utf8_lossy(x.data()).into_owned()))?;
                }
                _ => return Err(ParquetError::General(format!("column {} is of a type that holds no numbers", column.name))),
            }
        }
    }
    Ok(columns)
}

/// By what the whole numbers of a column are divided: ten for every decimal place of a decimal, one otherwise.
fn decimals(column: &ColumnDescriptor, name: &str) -> Result<f64, ParquetError> {
    let scale = match column.logical_type_ref() {
        Some(LogicalType::Decimal { scale, .. }) => *scale,
        _ if column.converted_type() == ConvertedType::DECIMAL => column.type_scale(),
        _ => return Ok(1.0),
    };
    if matches!(column.physical_type(), Physical::INT32 | Physical::INT64) {
        return Ok(10f64.powi(scale.max(0)));
    }
    Err(ParquetError::General(format!("column {name} holds decimals of more than 18 digits, or as bytes; doubles are read")))
}

/// All records of one column of one group; nulls are odd cells.
fn append<T: DataType>(
    mut reader: ColumnReaderImpl<T>,
    most: i16,
    rows: usize,
    column: &mut Column,
    number: impl Fn(&T::T) -> Result<f64, String>,
) -> Result<(), ParquetError> {
    loop {
        let (mut values, mut levels) = (Vec::new(), Vec::new());
        let (records, ..) = reader.read_records(CHUNK, Some(&mut levels), None, &mut values)?;
        if records == 0 {
            return Ok(());
        }
        let mut values = values.iter();
        for i in 0..records {
            let null = most > 0 && levels.get(i).is_none_or(|level| *level < most);
            let read = if null { Err(String::new()) } else { values.next().map_or_else(|| Err(String::new()), &number) };
            if let Err(text) = &read {
                column.odd.push((column.values.len(), text.clone()));
            }
            column.values.push(read.unwrap_or(f64::NAN));
        }
        if column.values.len() > rows {
            return Err(ParquetError::General("more rows than it says".to_owned()));
        }
    }
}

/// Writes one trajectory: `time_s`, then its columns.
pub(super) fn write(file: File, trajectory: &Trajectory) -> Result<(), ParquetError> {
    let names = std::iter::once("time_s").chain(trajectory.columns().iter().map(String::as_str));
    let field = |name| Type::primitive_type_builder(name, Physical::DOUBLE).with_repetition(Repetition::REQUIRED).build().map(Arc::new);
    let fields = names.map(field).collect::<Result<_, _>>()?;
    let schema = Arc::new(Type::group_type_builder("demonstration").with_fields(fields).build()?);
    let properties = WriterProperties::builder().set_created_by("cpdmp".to_owned()).set_compression(Compression::SNAPPY).build();
    let mut writer = SerializedFileWriter::new(file, schema, Arc::new(properties))?;
    let mut group = writer.next_row_group()?;
    let mut index = 0;
    while let Some(mut column) = group.next_column()? {
        let values: Vec<f64> = match index {
            0 => trajectory.times_s().to_vec(),
            i => trajectory.values().column(i - 1).iter().copied().collect(),
        };
        column.typed::<DoubleType>().write_batch(&values, None, None)?;
        column.close()?;
        index += 1;
    }
    group.close()?;
    writer.close()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use ::parquet::data_type::Int32Type;

    use super::*;

    /// Contract: a decimal of two places is a hundredth of the whole number that is stored for it.
    #[test]
    fn decimals_are_read_with_their_places() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.parquet");
        let whole = Type::primitive_type_builder("whole", Physical::INT32).with_repetition(Repetition::REQUIRED);
        let hundredths = Type::primitive_type_builder("hundredths", Physical::INT32).with_repetition(Repetition::REQUIRED);
        let hundredths = hundredths.with_converted_type(ConvertedType::DECIMAL).with_precision(4).with_scale(2);
        let fields = [whole, hundredths].map(|field| Arc::new(field.build().expect("a field"))).to_vec();
        let schema = Arc::new(Type::group_type_builder("a").with_fields(fields).build().expect("a schema"));
        let file = File::create(&path).expect("created");
        let mut writer = SerializedFileWriter::new(file, schema, Arc::default()).expect("begun");
        let mut group = writer.next_row_group().expect("a group");
        while let Some(mut column) = group.next_column().expect("a column") {
            column.typed::<Int32Type>().write_batch(&[7, -150], None, None).expect("written");
            column.close().expect("closed");
        }
        group.close().expect("closed");
        writer.close().expect("closed");
        let read = columns(&std::fs::read(&path).expect("read"), &path).expect("read");
        assert_eq!(read[0].values, [7.0, -150.0]);
        assert_eq!(read[1].values, [0.07, -1.5]);
    }
}
