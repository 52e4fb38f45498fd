//! In words, what was done to data on the way in, and what a person should know about them.

use super::{Dataset, Trajectory};

/// A gap is told when it is longer than this many steps of time on average (-).
const GAP: f64 = 5.0;

/// Notes by the file or demonstration they are about.
#[derive(Debug, Default)]
pub(super) struct Notes {
    notes: Vec<(String, String)>,
}

impl Notes {
    /// Adds a note; `place` is empty when it is about all of the data.
    pub(super) fn add(&mut self, place: &str, text: String) {
        self.notes.push((place.to_owned(), text));
    }

    /// One line per note; what holds for several files is said once.
    pub(super) fn in_words(&self) -> Vec<String> {
        let mut grouped: Vec<(&str, Vec<&str>)> = Vec::new();
        let mut index = std::collections::BTreeMap::new();
        for (place, text) in &self.notes {
            let at = *index.entry(text.as_str()).or_insert(grouped.len());
            if at == grouped.len() {
                grouped.push((text, Vec::new()));
            }
            grouped[at].1.push(place);
        }
        let line = |(text, places): (&str, Vec<&str>)| match places.as_slice() {
            [""] => text.to_owned(),
            [place] => format!("{place}: {text}"),
            [place, others @ ..] => format!("{place} and {} more: {text}", others.len()),
            [] => String::new(),
        };
        grouped.into_iter().map(line).collect()
    }
}

/// Rates, gaps and signs of quaternions.
pub(super) fn about(dataset: &Dataset, notes: &mut Notes) {
    let range = |values: &mut dyn Iterator<Item = f64>| values.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
    let trajectories = || dataset.demonstrations.iter().map(|demonstration| &demonstration.trajectory);
    let [shortest, longest] = range(&mut trajectories().map(Trajectory::duration_s));
    let [slow, fast] = range(&mut trajectories().map(|trajectory| 1.0 / step(trajectory)));
    let count = dataset.demonstrations.len();
    let text = match count {
        1 => format!("1 demonstration of {shortest:.3} s, sampled at {slow:.2} Hz on average"),
        _ => format!("{count} demonstrations of {shortest:.3} to {longest:.3} s, sampled at {slow:.2} to {fast:.2} Hz on average"),
    };
    notes.add("", text);
    for demonstration in &dataset.demonstrations {
        let trajectory = &demonstration.trajectory;
        if trajectory.largest_gap_s() > GAP * step(trajectory) {
            let text = format!("a gap of {:.4} s, where a step is {:.4} s on average", trajectory.largest_gap_s(), step(trajectory));
            notes.add(&demonstration.name, text);
        }
        let flips = sign_changes(trajectory);
        if flips > 0 {
            notes.add(&demonstration.name, format!("the quaternion changes sign {flips} times; learning makes it continuous"));
        }
    }
}

/// Time between samples on average (s).
fn step(trajectory: &Trajectory) -> f64 {
    trajectory.duration_s() / (trajectory.samples() - 1) as f64
}

fn sign_changes(trajectory: &Trajectory) -> usize {
    let Some(indices) = trajectory.quaternion_indices() else { return 0 };
    let dot = |t: usize| indices.iter().map(|i| trajectory.values()[(t, *i)] * trajectory.values()[(t - 1, *i)]).sum::<f64>();
    (1..trajectory.samples()).filter(|t| dot(*t) < 0.0).count()
}
