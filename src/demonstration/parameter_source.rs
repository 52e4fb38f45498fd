//! Where the motion parameters come from: given by the person, or read off the demonstrations themselves.

use super::{Dataset, Trajectory};

/// Where `theta_m` of a demonstration comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ParameterSource {
    /// Given with the demonstration.
    #[default]
    Given,
    /// The first sample: `start_x_m` …
    Start,
    /// The last sample: `goal_x_m` …
    Goal,
    /// First minus last sample: `relative_start_x_m` …
    StartRelativeToGoal,
}

impl ParameterSource {
    /// All sources.
    pub const ALL: [Self; 4] = [Self::Given, Self::Start, Self::Goal, Self::StartRelativeToGoal];

    /// The word of `dataset.toml` and the command line.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Given => "given",
            Self::Start => "start",
            Self::Goal => "goal",
            Self::StartRelativeToGoal => "start_relative_to_goal",
        }
    }

    /// The source of a word.
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|source| source.word() == word)
    }
}

impl Dataset {
    /// This dataset with `theta_m` of every demonstration filled from `source`, sorted by name; [`ParameterSource::Given`] leaves the
    /// parameters as they are. Motion columns that a trajectory lacks are left out ([`Self::check`] names them).
    #[must_use]
    pub fn with_parameter_source(mut self, source: ParameterSource) -> Self {
        self.parameter_source = source;
        let prefix = match source {
            ParameterSource::Given => return self,
            ParameterSource::Start => "start_",
            ParameterSource::Goal => "goal_",
            ParameterSource::StartRelativeToGoal => "relative_start_",
        };
        for demonstration in &mut self.demonstrations {
            let read = |name: &String| value(&demonstration.trajectory, name, source).map(|value| (format!("{prefix}{name}"), value));
            demonstration.theta_m = self.motion.iter().filter_map(read).collect();
            demonstration.theta_m.sort_by(|a, b| a.0.cmp(&b.0));
        }
        self
    }
}

fn value(trajectory: &Trajectory, column: &str, source: ParameterSource) -> Option<f64> {
    let values = trajectory.values().column(trajectory.column_index(column)?);
    let (first, last) = (values[0], values[values.len() - 1]);
    Some(match source {
        ParameterSource::Goal => last,
        ParameterSource::StartRelativeToGoal => first - last,
        ParameterSource::Given | ParameterSource::Start => first,
    })
}
