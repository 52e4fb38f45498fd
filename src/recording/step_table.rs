//! A step log in memory: its columns by name.

use std::collections::BTreeMap;
use std::fs::File;

use nalgebra::{Isometry3, Quaternion, UnitQuaternion, Vector3};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};

/// The columns of a step log.
pub(super) struct StepTable {
    pub rows: usize,
    /// What the file says about itself.
    pub keys: BTreeMap<String, String>,
    /// The names in the order of the file.
    pub names: Vec<String>,
    integers: BTreeMap<String, Vec<i64>>,
    reals: BTreeMap<String, Vec<f64>>,
}

impl StepTable {
    /// Everything in a file. Columns that hold neither whole nor real numbers are passed over.
    pub fn read(file: File) -> Result<Self, ParquetError> {
        let reader = SerializedFileReader::new(file)?;
        let about = reader.metadata().file_metadata();
        let names: Vec<String> = about.schema_descr().columns().iter().map(|column| column.name().to_owned()).collect();
        let keys = about.key_value_metadata().into_iter().flatten();
        let keys = keys.filter_map(|key| Some((key.key.clone(), key.value.clone()?))).collect();
        let mut table = Self { rows: 0, keys, names: names.clone(), integers: BTreeMap::new(), reals: BTreeMap::new() };
        for group in 0..reader.num_row_groups() {
            let group = reader.get_row_group(group)?;
            let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
            table.rows += rows;
            for (index, name) in names.iter().enumerate() {
                match group.get_column_reader(index)? {
                    ColumnReader::Int64ColumnReader(column) => append(column, rows, table.integers.entry(name.clone()).or_default())?,
                    ColumnReader::DoubleColumnReader(column) => append(column, rows, table.reals.entry(name.clone()).or_default())?,
                    _ => {}
                }
            }
        }
        Ok(table)
    }

    /// A whole number; the name when there is none in every row.
    pub fn integer(&self, row: usize, name: &str) -> Result<i64, String> {
        self.integers.get(name).and_then(|values| values.get(row)).copied().ok_or_else(|| name.to_owned())
    }

    /// A real number; the name when there is none in every row.
    pub fn real(&self, row: usize, name: &str) -> Result<f64, String> {
        self.reals.get(name).and_then(|values| values.get(row)).copied().ok_or_else(|| name.to_owned())
    }

    /// Whether a column of real numbers has none in any row.
    pub fn is_null(&self, name: &str) -> bool {
        self.reals.get(name).is_some_and(Vec::is_empty)
    }

    /// `{prefix}1{unit}`, `{prefix}2{unit}` … as far as they go.
    pub fn joints(&self, row: usize, prefix: &str, unit: &str) -> Vec<f64> {
        (1..).map_while(|joint| self.real(row, &format!("{prefix}{joint}{unit}")).ok()).collect()
    }

    /// `{prefix}_x{unit}` and so on.
    pub fn vector(&self, row: usize, prefix: &str, unit: &str) -> Result<Vector3<f64>, String> {
        let [x, y, z] = ["x", "y", "z"].map(|axis| self.real(row, &format!("{prefix}_{axis}{unit}")));
        Ok(Vector3::new(x?, y?, z?))
    }

    /// `{prefix}_x_m` … `{prefix}_qw`, with the bits that they have.
    pub fn pose(&self, row: usize, prefix: &str) -> Result<Isometry3<f64>, String> {
        let [x, y, z, w] = ["qx", "qy", "qz", "qw"].map(|axis| self.real(row, &format!("{prefix}_{axis}")));
        let rotation = UnitQuaternion::new_unchecked(Quaternion::new(w?, x?, y?, z?));
        Ok(Isometry3::from_parts(self.vector(row, prefix, "_m")?.into(), rotation))
    }
}

/// Appends the values of the rows that have one.
fn append<T: DataType>(mut column: ColumnReaderImpl<T>, rows: usize, values: &mut Vec<T::T>) -> Result<(), ParquetError> {
    column.read_records(rows, Some(&mut Vec::new()), None, values)?;
    Ok(())
}
