//! Columns that are read as motion though they look like something else.

use nalgebra::DVectorView;

use super::{Demonstration, Trajectory};

/// A warning for every motion column that is constant inside every repetition but differs between them: a number of the repetition or a
/// parameter looks like that. `motion` are columns that nobody listed.
pub(super) fn constant_columns(demonstrations: &[Demonstration], motion: &[String]) -> Vec<String> {
    let doubtful: Vec<&String> = motion.iter().filter(|name| differs_only_between(demonstrations, name)).collect();
    let quoted = |name: &String| format!("\"{name}\"");
    let others: Vec<String> = motion.iter().filter(|name| !doubtful.contains(name)).map(quoted).collect();
    let warning = |name: &&String| {
        let motion = if others.is_empty() { String::new() } else { format!(", or motion = [{}]", others.join(", ")) };
        format!(
            "column {name} is constant inside every repetition but differs between them: is it a sequence column, or a parameter (theta_m)? \
             It is learned as motion. A dataset.toml in the folder, for cpdmp learn FOLDER, can say sequence = \"{name}\", \
             theta_m = [\"{name}\"]{motion}"
        )
    };
    doubtful.iter().map(warning).collect()
}

fn differs_only_between(demonstrations: &[Demonstration], name: &str) -> bool {
    let constant = |trajectory: &Trajectory| {
        let values: DVectorView<'_, f64> = trajectory.values().column(trajectory.column_index(name)?);
        values.iter().all(|value| *value == values[0]).then_some(values[0])
    };
    let values: Option<Vec<f64>> = demonstrations.iter().map(|demonstration| constant(&demonstration.trajectory)).collect();
    values.is_some_and(|values| values.iter().any(|value| *value != values[0]))
}
