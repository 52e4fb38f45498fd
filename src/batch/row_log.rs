//! The row log: one checked line per finished run, in the order in which the runs ended. What a killed sweep goes on from.

use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use twox_hash::XxHash3_64;

use super::{BatchError, Row};

/// Marks a row that is not there.
const ABSENT: u64 = u64::MAX;

/// The row log of a sweep. In memory are the places of the rows (8 bytes per member), not the rows.
#[derive(Debug)]
pub struct RowLog {
    path: PathBuf,
    file: File,
    end: u64,
    /// Where the line of each member begins.
    places: Vec<u64>,
    /// Rows that are there.
    pub rows: u64,
    /// Lines that were damaged and are not counted.
    pub damaged: u64,
}

/// A line of the log.
#[derive(Serialize, Deserialize)]
struct Line {
    /// XXH3-64 of the row as JSON, in hexadecimal.
    xxh3_64: String,
    row: Row,
}

impl RowLog {
    /// Opens the log of a sweep with so many members, or begins it. A last line that was not finished is cut off; a damaged one is left out, so
    /// that its run is made again.
    pub fn open(path: &Path, members: u64) -> Result<Self, BatchError> {
        let mut options = OpenOptions::new();
        let file = options.create(true).truncate(false).read(true).write(true).open(path).map_err(BatchError::writing(path))?;
        let places = vec![ABSENT; usize::try_from(members).unwrap_or(usize::MAX)];
        let mut log = Self { path: path.to_path_buf(), file, end: 0, places, rows: 0, damaged: 0 };
        log.read_all().map_err(BatchError::reading(path))?;
        log.file.set_len(log.end).and_then(|()| log.file.sync_all()).map_err(BatchError::writing(path))?;
        Ok(log)
    }

    fn read_all(&mut self) -> std::io::Result<()> {
        let mut reader = BufReader::new(self.file.try_clone()?);
        let mut line = Vec::new();
        loop {
            line.clear();
            let length = reader.read_until(b'\n', &mut line)? as u64;
            if line.last() != Some(&b'\n') {
                return Ok(());
            }
            match checked(&line).and_then(|row| usize::try_from(row.index).ok()).and_then(|index| self.places.get_mut(index)) {
                Some(place) => {
                    self.rows += u64::from(*place == ABSENT);
                    *place = self.end;
                }
                None => self.damaged += 1,
            }
            self.end += length;
        }
    }

    /// Whether the row of that member is there.
    pub fn holds(&self, index: u64) -> bool {
        usize::try_from(index).ok().and_then(|index| self.places.get(index)).is_some_and(|place| *place != ABSENT)
    }

    /// Appends a row. It is on the disk when this returns.
    pub fn append(&mut self, row: &Row) -> Result<(), BatchError> {
        let text = json(row);
        let line = format!("{{\"xxh3_64\":\"{}\",\"row\":{text}}}\n", hash(&text));
        let write = || {
            let mut file = &self.file;
            file.seek(SeekFrom::Start(self.end))?;
            file.write_all(line.as_bytes())?;
            file.sync_data()
        };
        write().map_err(BatchError::writing(&self.path))?;
        if let Some(place) = self.places.get_mut(row.index as usize) {
            self.rows += u64::from(*place == ABSENT);
            *place = self.end;
        }
        self.end += line.len() as u64;
        Ok(())
    }

    /// The row of a member, read from the disk.
    pub fn row(&self, index: u64) -> Result<Option<Row>, BatchError> {
        if !self.holds(index) {
            return Ok(None);
        }
        let read = || {
            let mut file = &self.file;
            file.seek(SeekFrom::Start(self.places[index as usize]))?;
            let mut line = Vec::new();
            BufReader::with_capacity(1 << 11, file.take(self.end)).read_until(b'\n', &mut line)?;
            checked(&line).ok_or_else(|| std::io::Error::other(format!("the row of member {index} changed while it was in use")))
        };
        read().map(Some).map_err(BatchError::reading(&self.path))
    }
}

/// The row of a whole line, if it is as it was written.
fn checked(line: &[u8]) -> Option<Row> {
    let line: Line = serde_json::from_slice(line).ok()?;
    (hash(&json(&line.row)) == line.xxh3_64).then_some(line.row)
}

fn json(row: &Row) -> String {
    serde_json::to_string(row).expect("a row holds nothing that JSON cannot")
}

fn hash(text: &str) -> String {
    format!("{:016x}", XxHash3_64::oneshot(text.as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::super::{Cell, CriterionCell};
    use super::*;

    fn row(index: u64) -> Row {
        let answer = CriterionCell { value: Some(0.1 + 0.2), margin: None, unit: "m".to_owned(), passed: true, as_expected: true };
        Row {
            index,
            seed: 7,
            settings: vec![Cell::Number(1.0), Cell::Text("a \"b\"\n".to_owned()), Cell::Null],
            outcome: "passed".to_owned(),
            exit_code: 0,
            criteria: vec![answer],
            collisions: Some(0),
            collision_pairs: None,
            clearance_m: Some(1e-300),
            clearance_pair: None,
            human_peak_force_n: None,
            steps: 3,
            state_hash: Some("00ff".to_owned()),
            failure_reason: None,
            command: "cpdmp run".to_owned(),
        }
    }

    /// Contract: whatever byte the process is killed at, the rows before it are there, the torn one is not, and the log can go on.
    #[test]
    fn a_log_cut_at_any_byte_keeps_every_whole_row_and_goes_on() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("rows.jsonl");
        let mut log = RowLog::open(&path, 3).expect("a new log");
        [2, 0, 1].iter().for_each(|&index| log.append(&row(index)).expect("written"));
        let whole = std::fs::read(&path).expect("there");
        let ends: Vec<usize> = whole.iter().enumerate().filter(|(_, byte)| **byte == b'\n').map(|(index, _)| index + 1).collect();
        for cut in 0..=whole.len() {
            std::fs::write(&path, &whole[..cut]).expect("written");
            let mut log = RowLog::open(&path, 3).expect("a log");
            let kept = ends.iter().filter(|end| **end <= cut).count();
            assert_eq!((log.rows, log.damaged), (kept as u64, 0), "cut at {cut}");
            for &index in &[2, 0, 1][kept..] {
                log.append(&row(index)).expect("written");
            }
            assert_eq!(std::fs::read(&path).expect("there"), whole, "cut at {cut}");
            for index in 0..3 {
                assert_eq!(log.row(index).expect("read"), Some(row(index)));
            }
        }
    }

    #[test]
    fn a_damaged_line_is_left_out() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("rows.jsonl");
        let mut log = RowLog::open(&path, 2).expect("a new log");
        (0..2).for_each(|index| log.append(&row(index)).expect("written"));
        let text = std::fs::read_to_string(&path).expect("there");
        std::fs::write(&path, text.replacen("\"seed\":7", "\"seed\":8", 1)).expect("written");
        let log = RowLog::open(&path, 2).expect("a log");
        assert_eq!((log.rows, log.damaged, log.holds(0), log.holds(1)), (1, 1, false, true));
    }
}
