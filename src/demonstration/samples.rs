//! The trajectories in one table: its time, its repetitions, its parameters.

use nalgebra::DMatrix;

use super::csv::odd_faults;
use super::list::List;
use super::notes::Notes;
use super::sequences::{self, Sequence};
use super::table::{Column, Table};
use super::{Fault, GRIPPER_COLUMN, Parameters, QUATERNION_COLUMNS, Trajectory, column_map};

/// Names of time that are understood without `[columns]`, and the factor to s.
const TIME_COLUMNS: [(&str, f64); 10] = [
    ("time_s", 1.0),
    ("time", 1.0),
    ("t", 1.0),
    ("t_s", 1.0),
    ("timestamp", 1.0),
    ("timestamp_s", 1.0),
    ("time_ms", 1e-3),
    ("t_ms", 1e-3),
    ("time_us", 1e-6),
    ("time_ns", 1e-9),
];

/// The most repetitions in one file.
const MOST_SEQUENCES: usize = 10_000;

/// One repetition of a file.
pub(super) struct Piece {
    pub(super) label: Option<String>,
    pub(super) trajectory: Trajectory,
    pub(super) theta_m: Parameters,
    pub(super) theta_f: Parameters,
}

/// The repetitions of a table, or everything wrong with them.
pub(super) fn pieces(table: Table, list: &List, notes: &mut Notes) -> Result<Vec<Piece>, Vec<Fault>> {
    let table = column_map::applied(table, &list.columns, notes)?;
    let taken = [list.motion.as_deref(), list.wrench.as_deref(), Some(&list.theta_m), Some(&list.theta_f)];
    let taken: Vec<String> = taken.into_iter().flatten().flatten().cloned().collect();
    let sequence = match &list.sequence {
        Some(name) => Some(table.column(name).ok_or_else(|| vec![missing(&table, name, "the sequence column of dataset.toml")])?),
        None => sequences::recognised(&table, &taken),
    };
    let time = time(&table, list, notes)?;
    let sequences = match (sequence, &time) {
        (Some(column), _) => sequences::by_label(column),
        (None, Some((_, times))) => sequences::by_time(times),
        (None, None) => vec![Sequence { label: None, samples: (0..table.rows.len()).collect() }],
    };
    if sequences.len() > MOST_SEQUENCES {
        let found = format!("{} repetitions", sequences.len());
        return Err(vec![Fault::new(&table.place, found, format!("at most {MOST_SEQUENCES}"))]);
    }
    let told = |how: String| format!("{} repetitions, told apart by {how}", sequences.len());
    match sequence {
        Some(column) => notes.add(&table.place, told(format!("column {}", column.name))),
        None if sequences.len() > 1 => notes.add(&table.place, told("time, which starts again".to_owned())),
        None => {}
    }
    let mut used = [&list.theta_m[..], &list.theta_f[..]].concat();
    used.extend(sequence.map(|column| column.name.clone()));
    used.extend(time.as_ref().map(|(name, _)| name.clone()));
    let columns = kept(&table, &used, list, notes);
    let mut faults: Vec<Fault> = columns.iter().flat_map(|column| odd_faults(column, &table)).collect();
    let mut pieces = Vec::new();
    for sequence in sequences {
        match piece(&table, &columns, time.as_ref().map(|(_, times)| times.as_slice()), sequence, list) {
            Ok(piece) => pieces.push(piece),
            Err(more) => faults.extend(more),
        }
    }
    if faults.is_empty() { Ok(pieces) } else { Err(faults) }
}

/// The name of the time column and all times (s); `None` when there is none and the list gives a rate.
fn time(table: &Table, list: &List, notes: &mut Notes) -> Result<Option<(String, Vec<f64>)>, Vec<Fault>> {
    let column = TIME_COLUMNS.iter().find_map(|(name, factor)| Some((table.column(name)?, *factor)));
    match (column, list.rate_hz) {
        (Some((column, factor)), rate) => {
            let faults = odd_faults(column, table);
            if !faults.is_empty() {
                return Err(faults);
            }
            if column.name != "time_s" {
                notes.add(&table.place, format!("column {} is the time, times {factor} in s", column.name));
            }
            if rate.is_some() {
                notes.add(&table.place, format!("rate_hz is not needed, the file has times"));
            }
            Ok(Some((column.name.clone(), column.values.iter().map(|value| value * factor).collect())))
        }
        (None, Some(rate)) => {
            notes.add(&table.place, format!("times made from rate_hz = {rate}"));
            Ok(None)
        }
        (None, None) => {
            let expected = "a column time_s (or rate_hz in dataset.toml, or [columns] with time_s)";
            Err(vec![Fault::new(&table.place, format!("the columns [{}]", table.names()), expected).at_row(1)])
        }
    }
}

/// The columns of the trajectories: neither used otherwise, nor text, nor damaged without being asked for.
fn kept<'a>(table: &'a Table, used: &[String], list: &List, notes: &mut Notes) -> Vec<&'a Column> {
    let listed = |name: &String| {
        let motion = list.motion.as_ref().is_none_or(|motion| motion.contains(name));
        motion || list.wrench.iter().flatten().any(|n| n == name) || QUATERNION_COLUMNS.contains(&name.as_str()) || name == GRIPPER_COLUMN
    };
    let asked = |name: &String| list.motion.iter().flatten().chain(list.wrench.iter().flatten()).any(|n| n == name);
    let sound = |column: &Column| column.odd.is_empty() && column.values.iter().all(|value| value.is_finite());
    let mut left_out = Vec::new();
    let columns = table.columns.iter().filter(|column| !used.contains(&column.name));
    let kept = columns.filter(|column| {
        let keep = if column.is_text() && column.values.len() > 1 { asked(&column.name) } else { sound(column) || listed(&column.name) };
        if !keep {
            left_out.push(column.name.as_str());
        }
        keep
    });
    let kept = kept.collect();
    if !left_out.is_empty() {
        notes.add(&table.place, format!("columns {} hold no or not only numbers and are left out", left_out.join(", ")));
    }
    kept
}

fn piece(table: &Table, columns: &[&Column], times: Option<&[f64]>, sequence: Sequence, list: &List) -> Result<Piece, Vec<Fault>> {
    let Sequence { label, samples } = sequence;
    let time = |(i, sample): (usize, &usize)| times.map_or_else(|| i as f64 / list.rate_hz.unwrap_or(1.0), |times| times[*sample]);
    let times = samples.iter().enumerate().map(time).collect();
    let values = DMatrix::from_fn(samples.len(), columns.len(), |t, i| columns[i].values[samples[t]]);
    let trajectory = Trajectory::unchecked(times, columns.iter().map(|column| column.name.clone()).collect(), values);
    let place = label.as_ref().map_or_else(|| table.place.clone(), |label| format!("{}, sequence {label}", table.place));
    // Cells that are no numbers have been told with what stood there.
    let told = |fault: &Fault| {
        let column = columns.iter().find(|column| Some(&column.name) == fault.column.as_ref());
        let sample = fault.row.and_then(|row| samples.get(row));
        column.zip(sample).is_some_and(|(column, sample)| column.odd.binary_search_by_key(sample, |(at, _)| *at).is_ok())
    };
    let mut faults: Vec<Fault> = trajectory.faults(&place, 0).into_iter().filter(|fault| !told(fault)).collect();
    for fault in &mut faults {
        fault.row = fault.row.and_then(|row| samples.get(row)).map(|sample| table.rows[*sample]);
    }
    let theta_m = constants(table, &place, &samples, &list.theta_m, &mut faults);
    let theta_f = constants(table, &place, &samples, &list.theta_f, &mut faults);
    if faults.is_empty() { Ok(Piece { label, trajectory, theta_m, theta_f }) } else { Err(faults) }
}

/// Parameters that stand in columns: one value per repetition.
fn constants(table: &Table, place: &str, samples: &[usize], names: &[String], faults: &mut Vec<Fault>) -> Parameters {
    let mut parameters = Vec::new();
    for name in names {
        let Some(column) = table.column(name) else {
            faults.push(missing(table, name, "a parameter of dataset.toml"));
            continue;
        };
        let Some(first) = samples.first() else { continue };
        let value = column.values[*first];
        let other = samples.iter().find(|sample| column.values[**sample] != value || !value.is_finite());
        if let Some(other) = other {
            let expected = format!("a number that is the same in every row of a repetition, here {value}");
            faults.push(Fault::new(place, format!("`{}`", column.label(*other)), expected).at_row(table.rows[*other]).in_column(name));
        }
        parameters.push((name.clone(), value));
    }
    parameters.sort_by(|a, b| a.0.cmp(&b.0));
    parameters
}

fn missing(table: &Table, name: &str, role: &str) -> Fault {
    Fault::new(&table.place, format!("no such column, though it is {role}"), format!("one of {}", table.names())).in_column(name)
}
