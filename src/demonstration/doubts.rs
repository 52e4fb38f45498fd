//! Columns that are read as motion, or not at all, though they look like something else.

use nalgebra::DVectorView;

use super::{Dataset, Demonstration, QUATERNION_COLUMNS, Trajectory};

/// A warning for everything that may be another thing than it is taken for. What a list says by name is not doubted; `listed` is whether one
/// names the motion.
pub(super) fn doubts(dataset: &Dataset, listed: bool) -> Vec<String> {
    let mut warnings = if listed { Vec::new() } else { constant_columns(&dataset.demonstrations, &dataset.motion) };
    warnings.extend(unknown_names(dataset, listed));
    warnings
}

/// A warning for every orientation under names that are not known for one, and for every force that is learned as motion.
fn unknown_names(dataset: &Dataset, listed: bool) -> Vec<String> {
    let columns = dataset.demonstrations.first().map_or(&[][..], |demonstration| demonstration.trajectory.columns());
    let orientation = |name: &String| {
        let four = quaternion(name, columns)?;
        let taken = if dataset.motion.contains(name) { "learned as motion" } else { "left out" };
        let known = QUATERNION_COLUMNS.join(", ");
        let told = format!("{} look like a quaternion, and are {taken}", four.join(", "));
        Some(format!("{told}: orientations are known as {known}, or by `quaternion` under [columns] of dataset.toml"))
    };
    let doubted = columns.iter().filter(|name| !(listed && dataset.motion.contains(name)));
    let orientations: Vec<String> = doubted.filter_map(orientation).collect();
    let forces = dataset.motion.iter().filter(|name| !listed && (name.ends_with("_n") || name.ends_with("_nm")));
    let force = |name| {
        format!("{name} looks like a force or torque, and is learned as motion: name it in `wrench` of dataset.toml, or fx_n … tz_nm")
    };
    orientations.into_iter().chain(forces.map(force)).collect()
}

/// The four columns of a quaternion under other names, when this is their `w`: equal but for the letter.
fn quaternion(w: &str, columns: &[String]) -> Option<[String; 4]> {
    let stem = w.strip_suffix(['w', 'W'])?;
    let component = |letter: &str| {
        let is_it = |name: &&String| name.strip_prefix(stem).is_some_and(|last| last.eq_ignore_ascii_case(letter));
        columns.iter().find(is_it).filter(|name| !QUATERNION_COLUMNS.contains(&name.as_str())).cloned()
    };
    Some([component("x")?, component("y")?, component("z")?, component("w")?])
}

/// A warning for every motion column that is constant inside every repetition but differs between them: a number of the repetition or a
/// parameter looks like that. `motion` are columns that nobody listed.
fn constant_columns(demonstrations: &[Demonstration], motion: &[String]) -> Vec<String> {
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
