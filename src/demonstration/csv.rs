//! One demonstration as comma-separated values: a header, then one line per sample. Numbers survive the round trip bit for bit.

use std::path::Path;

use nalgebra::DMatrix;

use super::{DemonstrationError, Fault, Trajectory};

const TIME_COLUMN: &str = "time_s";

/// Reads one file; `place` is how faults call it.
pub(super) fn read(path: &Path, place: &str) -> Result<Trajectory, DemonstrationError> {
    let bytes = std::fs::read(path).map_err(DemonstrationError::io(path))?;
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
    let invalid = |faults| Err(DemonstrationError::Invalid(faults));
    let mut reader = ::csv::ReaderBuilder::new().flexible(true).trim(::csv::Trim::All).from_reader(bytes);
    let header: Vec<String> = match reader.headers() {
        Ok(header) => header.iter().map(str::to_owned).collect(),
        Err(error) => return invalid(vec![Fault::new(place, error.to_string(), "a header such as time_s,x_m,y_m").at_row(1)]),
    };
    let Some(time) = header.iter().position(|name| name == TIME_COLUMN) else {
        let found = format!("the columns [{}]", header.join(", "));
        return invalid(vec![Fault::new(place, found, "a column time_s").at_row(1)]);
    };
    let (cells, faults) = numbers(&mut reader, &header, place);
    if !faults.is_empty() {
        return invalid(faults);
    }
    let samples = cells.len() / header.len();
    let table = DMatrix::from_row_slice(samples, header.len(), &cells);
    let times = table.column(time).iter().copied().collect();
    let columns = header.iter().filter(|name| *name != TIME_COLUMN).cloned().collect();
    let indices: Vec<usize> = (0..header.len()).filter(|i| header[*i] != TIME_COLUMN).collect();
    let trajectory = Trajectory::unchecked(times, columns, table.select_columns(&indices));
    let faults = trajectory.faults(place, 2);
    if faults.is_empty() { Ok(trajectory) } else { invalid(faults) }
}

/// All cells in reading order, and the faults on the way.
fn numbers(reader: &mut ::csv::Reader<&[u8]>, header: &[String], place: &str) -> (Vec<f64>, Vec<Fault>) {
    let (mut cells, mut faults) = (Vec::new(), Vec::new());
    for (index, record) in reader.records().enumerate() {
        let record = match record {
            Ok(record) => record,
            Err(error) => {
                faults.push(Fault::new(place, error.to_string(), "text in UTF-8").at_row(index + 2));
                continue;
            }
        };
        let row = record.position().map_or(index + 2, |p| p.line() as usize);
        if record.len() != header.len() {
            let (found, expected) = (format!("{} cells", record.len()), format!("{}, as in the header", header.len()));
            faults.push(Fault::new(place, found, expected).at_row(row));
            continue;
        }
        for (name, cell) in header.iter().zip(record.iter()) {
            match cell.parse::<f64>() {
                Ok(value) => cells.push(value),
                Err(_) => {
                    let found = if cell.is_empty() { "an empty cell".to_owned() } else { format!("`{cell}`") };
                    faults.push(Fault::new(place, found, "a number with a decimal point").at_row(row).in_column(name));
                }
            }
        }
    }
    (cells, faults)
}

/// The file's text: shortest decimals that read back as the same bits.
pub(super) fn text(trajectory: &Trajectory) -> String {
    let mut text = String::from(TIME_COLUMN);
    for name in trajectory.columns() {
        text.push(',');
        text.push_str(name);
    }
    for (time, row) in trajectory.times_s().iter().zip(trajectory.values().row_iter()) {
        text.push_str(&format!("\n{time:?}"));
        for value in row.iter() {
            text.push_str(&format!(",{value:?}"));
        }
    }
    text.push('\n');
    text
}
