//! What a dataset holds, in figures.

use super::{Dataset, Demonstration, ParameterSource, Parameters};

/// A dataset in figures.
#[derive(Debug, Clone, PartialEq)]
pub struct DatasetSummary {
    /// Columns of the motion model.
    pub motion: Vec<String>,
    /// Columns of the force model.
    pub wrench: Vec<String>,
    /// Where the motion parameters come from.
    pub parameter_source: ParameterSource,
    /// One entry per demonstration.
    pub demonstrations: Vec<DemonstrationSummary>,
}

/// One demonstration in figures.
#[derive(Debug, Clone, PartialEq)]
pub struct DemonstrationSummary {
    /// Its name.
    pub name: String,
    /// Number of samples.
    pub samples: usize,
    /// First to last sample (s).
    pub duration_s: f64,
    /// The lowest and highest rate between two samples (Hz).
    pub rate_hz: [f64; 2],
    /// The longest time between two samples (s).
    pub largest_gap_s: f64,
    /// Every column, in the order of the file.
    pub columns: Vec<ColumnSummary>,
    /// Parameters of the motion model.
    pub theta_m: Parameters,
    /// Parameters of the force model.
    pub theta_f: Parameters,
}

/// One column of one demonstration, in the unit of its name.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnSummary {
    /// Its name.
    pub name: String,
    /// The first sample.
    pub start: f64,
    /// The last sample.
    pub end: f64,
    /// The smallest value.
    pub min: f64,
    /// The largest value.
    pub max: f64,
}

impl Dataset {
    /// The dataset in figures.
    #[must_use]
    pub fn summary(&self) -> DatasetSummary {
        DatasetSummary {
            motion: self.motion.clone(),
            wrench: self.wrench.clone(),
            parameter_source: self.parameter_source,
            demonstrations: self.demonstrations.iter().map(demonstration).collect(),
        }
    }
}

fn demonstration(demonstration: &Demonstration) -> DemonstrationSummary {
    let trajectory = &demonstration.trajectory;
    let shortest = trajectory.times_s().windows(2).map(|t| t[1] - t[0]).fold(f64::INFINITY, f64::min);
    let column = |(name, values): (&String, nalgebra::DVectorView<f64>)| ColumnSummary {
        name: name.clone(),
        start: values[0],
        end: values[values.len() - 1],
        min: values.min(),
        max: values.max(),
    };
    DemonstrationSummary {
        name: demonstration.name.clone(),
        samples: trajectory.samples(),
        duration_s: trajectory.duration_s(),
        rate_hz: [1.0 / trajectory.largest_gap_s(), 1.0 / shortest],
        largest_gap_s: trajectory.largest_gap_s(),
        columns: trajectory.columns().iter().zip(trajectory.values().column_iter()).map(column).collect(),
        theta_m: demonstration.theta_m.clone(),
        theta_f: demonstration.theta_f.clone(),
    }
}
