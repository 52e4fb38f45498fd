//! Samples as text: a header, then one line per sample. Numbers survive the round trip bit for bit.

use std::borrow::Cow;

use super::table::{Column, Layout, MOST_CELLS, Table};
use super::{DemonstrationError, Fault, Trajectory};

/// The most columns of one text file.
const MOST_COLUMNS: usize = 4096;

/// The most faults one file is searched for.
const MOST_FAULTS: usize = 1000;

/// Reads a file's bytes; `place` is how faults call it.
pub(super) fn read(bytes: &[u8], place: &str, layout: Layout) -> Result<Table, DemonstrationError> {
    let text = text_of(bytes, place)?;
    let mut lines = text.lines().enumerate().filter(|(_, l)| !l.trim().is_empty() && !l.trim_start().starts_with('#')).peekable();
    let invalid = |fault| Err(DemonstrationError::Invalid(vec![fault]));
    let Some((first, top)) = lines.peek().copied() else {
        return invalid(Fault::new(place, "no line with samples", "a header such as time_s,x_m,y_m, then one line per sample"));
    };
    let delimiter = layout.delimiter.unwrap_or_else(|| recognised(top));
    let cells = split(top, delimiter);
    if cells.len() > MOST_COLUMNS {
        return invalid(Fault::new(place, format!("{} columns", cells.len()), format!("at most {MOST_COLUMNS}")).at_row(first + 1));
    }
    let header = layout.header.unwrap_or_else(|| !cells.iter().all(|cell| cell.parse::<f64>().is_ok()));
    let name = |(i, cell): (usize, &Cow<str>)| if header { cell.to_string() } else { i.to_string() };
    let columns = cells.iter().enumerate().map(name).map(|name| Column { name, ..Column::default() }).collect();
    let mut table = Table { place: place.to_owned(), columns, rows: Vec::new(), header };
    if header {
        lines.next();
    }
    let mut faults = Vec::new();
    for (index, line) in lines {
        let cells = split(line, delimiter);
        if cells.len() != table.columns.len() {
            let expected = format!("{}, as in the first line; a decimal comma is not read", table.columns.len());
            faults.push(Fault::new(place, format!("{} cells", cells.len()), expected).at_row(index + 1));
            if faults.len() >= MOST_FAULTS {
                break;
            }
            continue;
        }
        let sample = table.rows.len();
        table.rows.push(index + 1);
        for (column, cell) in table.columns.iter_mut().zip(cells) {
            column.values.push(cell.parse().unwrap_or(f64::NAN));
            if cell.parse::<f64>().is_err() {
                column.odd.push((sample, cell.into_owned()));
            }
        }
        if table.rows.len() * table.columns.len() > MOST_CELLS {
            return invalid(Fault::new(place, format!("more than {MOST_CELLS} cells"), "a smaller file: split it"));
        }
    }
    // A ragged file is still searched for bad cells: all faults at once.
    if !faults.is_empty() {
        faults.extend(table.columns.iter().filter(|column| !column.is_text()).flat_map(|column| odd_faults(column, &table)));
        faults.sort_by_key(|fault| fault.row);
        return Err(DemonstrationError::Invalid(faults));
    }
    Ok(table)
}

/// A fault for every cell of a column that is not a number.
pub(super) fn odd_faults(column: &Column, table: &Table) -> Vec<Fault> {
    let fault = |(sample, cell): &(usize, String)| {
        let found = if cell.is_empty() { "an empty cell".to_owned() } else { format!("`{}`", shortened(cell)) };
        let comma = cell.contains(',') && cell.replace(',', ".").parse::<f64>().is_ok();
        let expected = if comma { "a decimal point: replace the decimal commas of the file" } else { "a number with a decimal point" };
        Fault::new(&table.place, found, expected).at_row(table.rows[*sample]).in_column(&column.name)
    };
    column.odd.iter().take(MOST_FAULTS).map(fault).collect()
}

fn shortened(cell: &str) -> String {
    if cell.chars().count() > 40 { format!("{}…", cell.chars().take(40).collect::<String>()) } else { cell.to_owned() }
}

fn text_of<'a>(bytes: &'a [u8], place: &str) -> Result<&'a str, DemonstrationError> {
    let row = |end: usize| bytes[..end].iter().filter(|byte| **byte == b'\n').count() + 1;
    let invalid = |found: &str, end| Err(DemonstrationError::Invalid(vec![Fault::new(place, found, "text in UTF-8").at_row(row(end))]));
    if let Some(at) = bytes.iter().position(|byte| *byte == 0) {
        return invalid("a zero byte: a binary or UTF-16 file", at);
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(text.strip_prefix('\u{feff}').unwrap_or(text)),
        Err(error) => invalid("bytes that are not UTF-8", error.valid_up_to()),
    }
}

/// The delimiter of a line: semicolon before comma before tab before blanks.
fn recognised(line: &str) -> char {
    [';', ',', '\t'].into_iter().find(|delimiter| line.contains(*delimiter)).unwrap_or(' ')
}

/// The cells of a line; a blank as the delimiter stands for any run of blanks.
fn split(line: &str, delimiter: char) -> Vec<Cow<'_, str>> {
    if delimiter == ' ' {
        return line.split_whitespace().map(Cow::Borrowed).collect();
    }
    if line.contains('"') {
        let builder = &mut ::csv::ReaderBuilder::new();
        let builder = builder.has_headers(false).delimiter(delimiter as u8).trim(::csv::Trim::All);
        if let Some(Ok(record)) = builder.from_reader(line.as_bytes()).records().next() {
            return record.iter().map(|cell| Cow::Owned(cell.to_owned())).collect();
        }
    }
    line.split(delimiter).map(|cell| Cow::Borrowed(cell.trim())).collect()
}

/// The file's text: shortest decimals that read back as the same bits.
pub(super) fn text(trajectory: &Trajectory) -> String {
    let mut text = String::from("time_s");
    for name in trajectory.columns() {
        text.push(',');
        text.push_str(&cell(name));
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

/// A name, quoted where the delimiter demands it.
fn cell(name: &str) -> Cow<'_, str> {
    if name.contains([',', '"', ';']) { Cow::Owned(format!("\"{}\"", name.replace('"', "\"\""))) } else { Cow::Borrowed(name) }
}
