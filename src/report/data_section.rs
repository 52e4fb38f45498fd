//! What a dataset holds, for people and for other programs.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Serialize;

use super::table::{figure, table};
use crate::demonstration::{Dataset, Demonstration};

/// What a dataset holds.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct DataSection {
    /// Columns of the motion model.
    pub motion: Vec<String>,
    /// Columns of the force model.
    pub wrench: Vec<String>,
    /// Where the motion's parameters come from: `given`, `start`, `goal` or `start_relative_to_goal`.
    pub parameter_source: &'static str,
    /// What reading did to the data: sequences, units, columns left out.
    pub notes: Vec<String>,
    /// Every demonstration.
    pub demonstrations: Vec<DemonstrationRow>,
}

/// One demonstration.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct DemonstrationRow {
    /// Its name.
    pub name: String,
    /// Number of samples.
    pub samples: usize,
    /// Its length (s).
    pub duration_s: f64,
    /// Samples per second, on average (Hz).
    pub rate_hz: f64,
    /// Longest time without a sample (s).
    pub largest_gap_s: f64,
    /// Parameters of the motion.
    pub theta_m: BTreeMap<String, f64>,
    /// Parameters of the force.
    pub theta_f: BTreeMap<String, f64>,
    /// Every column: first, last, smallest and largest value.
    pub columns: BTreeMap<String, ColumnRow>,
}

/// One column of a demonstration.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ColumnRow {
    /// First value.
    pub first: f64,
    /// Last value.
    pub last: f64,
    /// Smallest value.
    pub min: f64,
    /// Largest value.
    pub max: f64,
}

impl DataSection {
    /// From a dataset, and the notes of the one who read it.
    pub fn of(dataset: &Dataset, notes: Vec<String>) -> Self {
        Self {
            motion: dataset.motion.clone(),
            wrench: dataset.wrench.clone(),
            parameter_source: dataset.parameter_source.word(),
            notes,
            demonstrations: dataset.demonstrations.iter().map(row).collect(),
        }
    }

    /// The section as lines of text.
    pub fn lines(&self) -> Vec<String> {
        let list = |names: &[String]| if names.is_empty() { "none".to_owned() } else { names.join(", ") };
        let mut lines = vec![
            format!("  motion       {}", list(&self.motion)),
            format!("  force        {}", list(&self.wrench)),
            format!("  parameters   {}", self.parameters()),
        ];
        lines.extend(self.notes.iter().map(|note| format!("  note         {note}")));
        lines.push(String::new());
        let parameters: Vec<&String> = self.demonstrations.first().map_or_else(Vec::new, |one| one.theta_m.keys().collect());
        let mut heading: Vec<String> = ["demonstration", "samples", "duration s", "rate Hz", "gap s"].map(str::to_owned).to_vec();
        heading.extend(parameters.iter().map(|name| (*name).clone()));
        heading.extend(self.motion.iter().map(|name| format!("{name} from … to")));
        let rows = self.demonstrations.iter().map(|one| {
            let mut row = vec![one.name.clone(), one.samples.to_string()];
            row.extend([one.duration_s, one.rate_hz, one.largest_gap_s].map(figure));
            row.extend(one.theta_m.values().map(|value| figure(*value)));
            let ends = |name| one.columns.get(name).map(|c| format!("{} … {}", figure(c.first), figure(c.last)));
            row.extend(self.motion.iter().map(|name| ends(name).unwrap_or_default()));
            row
        });
        lines.extend(table(&std::iter::once(heading).chain(rows).collect::<Vec<_>>()));
        lines
    }

    fn parameters(&self) -> String {
        let names: Vec<String> = self.demonstrations.first().map_or_else(Vec::new, |one| one.theta_m.keys().cloned().collect());
        match (names.is_empty(), self.parameter_source) {
            (true, _) => "none".to_owned(),
            (false, "given") => names.join(", "),
            (false, source) => format!("{} (from the {source})", names.join(", ")),
        }
    }
}

fn row(demonstration: &Demonstration) -> DemonstrationRow {
    let trajectory = &demonstration.trajectory;
    let columns = trajectory.columns().iter().zip(trajectory.values().column_iter());
    let column = |values: nalgebra::DVectorView<'_, f64>| ColumnRow {
        first: values[0],
        last: values[values.len() - 1],
        min: values.min(),
        max: values.max(),
    };
    DemonstrationRow {
        name: demonstration.name.clone(),
        samples: trajectory.samples(),
        duration_s: trajectory.duration_s(),
        rate_hz: (trajectory.samples() - 1) as f64 / trajectory.duration_s(),
        largest_gap_s: trajectory.largest_gap_s(),
        theta_m: demonstration.theta_m.iter().cloned().collect(),
        theta_f: demonstration.theta_f.iter().cloned().collect(),
        columns: columns.map(|(name, values)| (name.clone(), column(values))).collect(),
    }
}
