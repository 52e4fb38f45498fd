//! Which samples of a file belong together: repetitions told apart by a column, or by time that starts again.

use super::table::{Column, Table};

/// Column names that tell repetitions apart without being named in the list (any case).
const RECOGNISED: [&str; 20] = [
    "sequence",
    "sequence_id",
    "seq",
    "seq_id",
    "demonstration",
    "demonstration_id",
    "demo",
    "demo_id",
    "demo_index",
    "episode",
    "episode_id",
    "episode_index",
    "trial",
    "trial_id",
    "repetition",
    "rep",
    "run",
    "run_id",
    "trajectory",
    "trajectory_id",
];

/// Time starts again where it falls back to within this share of the time passed so far (-); a smaller step back is a fault of the file, and
/// so is a single time out of line, after which the old clock goes on.
const RESTART: f64 = 0.05;

/// One repetition.
#[derive(Debug, PartialEq)]
pub(super) struct Sequence {
    /// Value of the sequence column.
    pub(super) label: Option<String>,
    /// Its samples, as indices of the table, rising.
    pub(super) samples: Vec<usize>,
}

/// The column that tells repetitions apart, if one is called so; `taken` names columns that have another meaning.
pub(super) fn recognised<'a>(table: &'a Table, taken: &[String]) -> Option<&'a Column> {
    let called = |column: &&Column| tells_apart(&column.name) && !taken.contains(&column.name);
    let labels = |column: &&Column| column.is_text() || column.values.iter().all(|value| value.fract() == 0.0);
    table.columns.iter().filter(called).find(labels)
}

/// Whether a column of this name tells repetitions apart without being named in the list.
pub(super) fn tells_apart(name: &str) -> bool {
    RECOGNISED.contains(&name.to_ascii_lowercase().as_str())
}

/// One sequence per label, in the order in which labels appear.
pub(super) fn by_label(column: &Column) -> Vec<Sequence> {
    let mut place = std::collections::BTreeMap::new();
    let mut sequences: Vec<Sequence> = Vec::new();
    for sample in 0..column.values.len() {
        let label = column.label(sample);
        let index = *place.entry(label.clone()).or_insert(sequences.len());
        if index == sequences.len() {
            sequences.push(Sequence { label: Some(label), samples: Vec::new() });
        }
        sequences[index].samples.push(sample);
    }
    sequences
}

/// One sequence from each start of time (s) to the next.
pub(super) fn by_time(times: &[f64]) -> Vec<Sequence> {
    let mut sequences: Vec<Sequence> = Vec::new();
    let mut first = 0;
    for i in 0..times.len() {
        let falls = i > first + 1 && times[i] < times[i - 1] && times[i] - times[first] <= RESTART * (times[i - 1] - times[first]);
        let restarts = falls && times.get(i + 1).is_none_or(|next| *next <= times[i - 1]);
        if restarts {
            sequences.push(Sequence { label: None, samples: (first..i).collect() });
            first = i;
        }
    }
    sequences.push(Sequence { label: None, samples: (first..times.len()).collect() });
    sequences
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_that_starts_again_begins_a_sequence_and_a_slip_does_not() {
        let lengths = |times: &[f64]| by_time(times).iter().map(|sequence| sequence.samples.len()).collect::<Vec<_>>();
        assert_eq!(lengths(&[0.0, 1.0, 2.0, 0.0, 1.0, 0.0, 1.0]), [3, 2, 2]);
        assert_eq!(lengths(&[0.0, 1.0, 2.0, 1.5, 3.0]), [5], "a slip is left for the check of times");
        assert_eq!(lengths(&[5.0, 6.0, 7.0, 0.5, 1.5]), [3, 2], "another recording's clock");
        assert_eq!(lengths(&[0.0, 1.0, 2.0, 0.0, 4.0, 5.0]), [6], "one time stamp that was lost");
        assert_eq!((lengths(&[]), lengths(&[1.0])), (vec![0], vec![1]));
    }
}
