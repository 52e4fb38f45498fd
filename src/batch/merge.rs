//! Tables of shards to the table of the whole sweep: the same file that one machine would have written.

use std::path::{Path, PathBuf};

use super::table::Head;
use super::table_file::{TableFile, write_table};
use super::{BatchError, Cell};
use crate::report::Outcome;

/// What a joined table holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MergedRows {
    /// Rows.
    pub rows: u64,
    /// Rows of runs that did not pass.
    pub not_passed: u64,
    /// The worst outcome of all runs.
    pub worst: Outcome,
}

/// Joins tables into `out`: their rows in the order of the members.
///
/// # Errors
/// When a table is damaged or of another sweep than the first, when a member is in two of them or in none, or `out` cannot be written.
pub fn merge(tables: &[PathBuf], out: &Path) -> Result<MergedRows, BatchError> {
    let target = out.canonicalize().ok();
    if let Some(own) = tables.iter().find(|path| target.is_some() && of_table(path).canonicalize().ok() == target) {
        return Err(BatchError::NotAWhole(format!("{} is to be joined, and cannot be where the whole goes too", own.display())));
    }
    let mut sources = tables.iter().map(|path| Source::open(path)).collect::<Result<Vec<_>, _>>()?;
    let Some(first) = sources.first() else { return Err(BatchError::NotAWhole("there are none".to_owned())) };
    let head = Head { shard: None, ..first.table.head.clone() };
    for source in &sources {
        same_sweep(&sources[0].table, &source.table)?;
    }
    let outcome_column = head.columns.iter().position(|column| column.name == "outcome");
    let mut merged = MergedRows { rows: 0, not_passed: 0, worst: Outcome::Passed };
    let rows = std::iter::from_fn(|| {
        let row = next_row(&mut sources, merged.rows, head.members).transpose();
        if let Some(Ok(row)) = &row {
            merged.add(outcome_column.and_then(|column| row.get(column)));
        }
        row
    })
    .fuse();
    write_table(out, &head, rows)?;
    Ok(merged)
}

impl MergedRows {
    /// Counts a run by the name of its outcome.
    fn add(&mut self, outcome: Option<&Cell>) {
        let named = if let Some(Cell::Text(name)) = outcome { Outcome::named(name) } else { None };
        let outcome = named.unwrap_or(Outcome::InternalError);
        self.rows += 1;
        self.not_passed += u64::from(outcome != Outcome::Passed);
        self.worst = self.worst.max(outcome);
    }
}

/// The table itself: the folder of a sweep stands for its own.
fn of_table(path: &Path) -> PathBuf {
    if path.is_dir() { path.join("sweep.parquet") } else { path.to_path_buf() }
}

/// A table and the row that it stands at.
struct Source {
    table: TableFile,
    row: Option<Vec<Cell>>,
}

impl Source {
    fn open(path: &Path) -> Result<Self, BatchError> {
        let mut table = TableFile::open(&of_table(path))?;
        let row = table.next()?;
        Ok(Self { table, row })
    }

    /// The member whose row it stands at.
    fn index(&self) -> Option<i64> {
        match self.row.as_ref()?.first() {
            Some(Cell::Whole(index)) => Some(*index),
            _ => None,
        }
    }
}

fn same_sweep(first: &TableFile, other: &TableFile) -> Result<(), BatchError> {
    let same = first.head.hash == other.head.hash && first.head.members == other.head.members && first.head.columns == other.head.columns;
    if same {
        return Ok(());
    }
    let (a, b) = (first.path.display(), other.path.display());
    let about = |table: &TableFile| format!("`{}`, {} members, sweep {}", table.head.scenario, table.head.members, table.head.hash);
    Err(BatchError::NotAWhole(format!("{a} is of {}, but {b} is of {}", about(first), about(other))))
}

/// The row of member `wanted`, from the only table that has it; nothing after the last one.
fn next_row(sources: &mut [Source], wanted: u64, members: u64) -> Result<Option<Vec<Cell>>, BatchError> {
    let refuse = |what: String| Err(BatchError::NotAWhole(what));
    let least = sources.iter().enumerate().filter_map(|(place, source)| Some((source.index()?, place))).min();
    let wanted = i64::try_from(wanted).unwrap_or(i64::MAX);
    match least {
        None if wanted as u64 == members => Ok(None),
        Some((index, place)) if index == wanted && index.unsigned_abs() < members => {
            let source = &mut sources[place];
            let following = source.table.next()?;
            Ok(std::mem::replace(&mut source.row, following))
        }
        Some((index, place)) if index < wanted => {
            refuse(format!("member {index} is in {} and in another table, or twice in one", sources[place].table.path.display()))
        }
        _ => refuse(format!("member {wanted} of {members} is in none of them: is a shard missing, or not finished?")),
    }
}
