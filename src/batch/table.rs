//! The table of a sweep: its columns, and a row as cells of them.

use super::{Cell, CellKind, Row};

/// One column.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name, which ends in the unit (SI) where it has a fixed one.
    pub name: String,
    /// What its cells hold.
    pub kind: CellKind,
    /// What it means.
    pub meaning: String,
}

/// What a table says about itself.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Head {
    /// Name of the scenario.
    pub scenario: String,
    /// Which sweep it is of.
    pub hash: String,
    /// Members of the whole sweep.
    pub members: u64,
    /// Which part it is; `None` for the whole.
    pub shard: Option<String>,
    pub columns: Vec<Column>,
}

/// The columns of a sweep that varies those keys and asks those criteria, in the order of the file.
#[must_use]
pub fn columns(keys: &[(String, CellKind)], criteria: &[String]) -> Vec<Column> {
    let column = |name: &str, kind, meaning: &str| Column { name: name.to_owned(), kind, meaning: meaning.to_owned() };
    let mut all = vec![column("index", CellKind::Whole, "number of the member, from 0"), column("seed", CellKind::Whole, "its seed")];
    all.extend(keys.iter().map(|(key, kind)| column(key, *kind, "a key of the scenario that varies")));
    all.push(column("outcome", CellKind::Text, "how the run ended"));
    all.push(column("exit_code", CellKind::Whole, "the exit code that belongs to it"));
    for name in criteria {
        let of = |what: &str| format!("criterion.{name}.{what}");
        all.push(column(&of("value"), CellKind::Number, "measured value"));
        all.push(column(&of("margin"), CellKind::Number, "how far the value is on the right side of the limit"));
        all.push(column(&of("unit"), CellKind::Text, "unit of value and margin"));
        all.push(column(&of("passed"), CellKind::Flag, "whether the criterion holds"));
        all.push(column(&of("as_expected"), CellKind::Flag, "whether that is what the scenario expects"));
    }
    all.extend([
        column("collisions", CellKind::Whole, "pairs of parts that touched although the scene does not allow it"),
        column("collision_pairs", CellKind::Text, "these pairs"),
        column("clearance_m", CellKind::Number, "smallest distance to any watched object"),
        column("clearance_pair", CellKind::Text, "between whom"),
        column("human_peak_force_n", CellKind::Number, "the person's largest force"),
        column("steps", CellKind::Whole, "engine steps of all phases"),
        column("state_hash", CellKind::Text, "hash over every state of the run: equal hashes, equal runs"),
        column("failure_reason", CellKind::Text, "why the run did not pass, if it did not"),
        column("command", CellKind::Text, "the command that runs this member alone"),
    ]);
    all
}

/// A row as cells of the columns of a sweep with so many criteria.
pub(super) fn cells(row: &Row, criteria: usize) -> Vec<Cell> {
    let whole = |count: u64| i64::try_from(count).map_or(Cell::Null, Cell::Whole);
    let mut all = vec![whole(row.index), whole(row.seed)];
    all.extend(row.settings.iter().cloned());
    all.push(Cell::Text(row.outcome.clone()));
    all.push(Cell::Whole(i64::from(row.exit_code)));
    for index in 0..criteria {
        match row.criteria.get(index) {
            None => all.extend(std::iter::repeat_n(Cell::Null, 5)),
            Some(criterion) => all.extend([
                Cell::number(criterion.value),
                Cell::number(criterion.margin),
                Cell::Text(criterion.unit.clone()),
                Cell::Flag(criterion.passed),
                Cell::Flag(criterion.as_expected),
            ]),
        }
    }
    all.extend([
        row.collisions.map_or(Cell::Null, whole),
        Cell::text(row.collision_pairs.as_deref()),
        Cell::number(row.clearance_m),
        Cell::text(row.clearance_pair.as_deref()),
        Cell::number(row.human_peak_force_n),
        whole(row.steps),
        Cell::text(row.state_hash.as_deref()),
        Cell::text(row.failure_reason.as_deref()),
        Cell::Text(row.command.clone()),
    ]);
    all
}
