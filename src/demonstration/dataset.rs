//! Demonstrations of one skill, with the parameters they were given under.

use super::{DemonstrationError, Fault, GRIPPER_COLUMN, ParameterSource, QUATERNION_COLUMNS, Trajectory};

/// Named task parameters, e.g. `block_height_m = 0.17`, sorted by name.
pub type Parameters = Vec<(String, f64)>;

/// One demonstration.
#[derive(Debug, Clone, PartialEq)]
pub struct Demonstration {
    /// Its name, which is its file's name without extension.
    pub name: String,
    /// What was recorded: motion, wrench, orientation, gripper.
    pub trajectory: Trajectory,
    /// Parameters of the motion model (`theta_m`).
    pub theta_m: Parameters,
    /// Parameters of the force model (`theta_f`).
    pub theta_f: Parameters,
}

/// Several demonstrations of one skill, and which columns its models learn.
#[derive(Debug, Clone, PartialEq)]
pub struct Dataset {
    /// Columns of the motion model (1 to 32).
    pub motion: Vec<String>,
    /// Columns of the force model; may be empty.
    pub wrench: Vec<String>,
    /// Where `theta_m` comes from; kept on disk, so that the parameters follow the data.
    pub parameter_source: ParameterSource,
    /// The demonstrations, at least one.
    pub demonstrations: Vec<Demonstration>,
}

impl Dataset {
    /// Checks what single trajectories cannot know: that all demonstrations have the columns and the same parameters.
    ///
    /// # Errors
    /// All faults at once; each names the demonstration.
    pub fn check(&self) -> Result<(), DemonstrationError> {
        let mut faults = self.column_faults();
        if self.demonstrations.is_empty() {
            faults.push(Fault::new("dataset.toml", "no demonstration", "at least one [[demonstration]]"));
        }
        for demonstration in &self.demonstrations {
            faults.extend(self.demonstration_faults(demonstration));
        }
        if faults.is_empty() { Ok(()) } else { Err(DemonstrationError::Invalid(faults)) }
    }

    /// Names of the motion model's parameters.
    #[must_use]
    pub fn parameters_m(&self) -> Vec<String> {
        names(self.demonstrations.first().map_or(&[], |d| &d.theta_m))
    }

    /// Names of the force model's parameters.
    #[must_use]
    pub fn parameters_f(&self) -> Vec<String> {
        names(self.demonstrations.first().map_or(&[], |d| &d.theta_f))
    }

    fn column_faults(&self) -> Vec<Fault> {
        let mut faults = Vec::new();
        if !(1..=32).contains(&self.motion.len()) {
            faults.push(Fault::new("motion", format!("{} columns", self.motion.len()), "1 to 32 columns for the motion model"));
        }
        for (key, list) in [("motion", &self.motion), ("wrench", &self.wrench)] {
            let beside = list.iter().filter(|name| QUATERNION_COLUMNS.contains(&name.as_str()) || *name == GRIPPER_COLUMN);
            let beside: Vec<&str> = beside.map(String::as_str).collect();
            if !beside.is_empty() {
                let expected = "other columns only: orientation and gripper are learned beside them by themselves";
                faults.push(Fault::new(key, beside.join(", "), expected));
            }
            for (i, name) in list.iter().enumerate() {
                if list[..i].contains(name) {
                    faults.push(Fault::new(key, format!("{name} twice"), "every column once"));
                }
                if key == "wrench" && self.motion.contains(name) {
                    faults.push(Fault::new(key, format!("{name}, which is in motion too"), "every column in one of the two"));
                }
                faults.extend(other_unit(key, name));
            }
        }
        faults
    }

    fn demonstration_faults(&self, demonstration: &Demonstration) -> Vec<Fault> {
        let mut faults = Vec::new();
        for (key, list) in [("motion", &self.motion), ("wrench", &self.wrench)] {
            for name in list.iter().filter(|name| demonstration.trajectory.column_index(name).is_none()) {
                let found = format!("no such column, though it belongs to {key}");
                let expected = format!("one of {}", demonstration.trajectory.columns().join(", "));
                faults.push(Fault::new(&demonstration.name, found, expected).in_column(name));
            }
        }
        let first = &self.demonstrations[0];
        for (key, theta, reference) in
            [("theta_m", &demonstration.theta_m, &first.theta_m), ("theta_f", &demonstration.theta_f, &first.theta_f)]
        {
            if names(theta) != names(reference) {
                let found = format!("{key} with [{}]", names(theta).join(", "));
                let expected = format!("[{}], sorted, as in {}", names(reference).join(", "), first.name);
                faults.push(Fault::new(&demonstration.name, found, expected));
            }
            for (name, value) in theta.iter().filter(|(_, value)| !value.is_finite()) {
                faults.push(Fault::new(&demonstration.name, format!("{key}.{name} = {value}"), "a finite number"));
            }
        }
        faults
    }
}

/// Endings of names in other units, how `[columns]` calls the unit, and the ending in the SI unit.
const OTHER_UNITS: [(&str, &str, &str); 8] = [
    ("_mm", "mm", "_m"),
    ("_cm", "cm", "_m"),
    ("_km", "km", "_m"),
    ("_deg", "deg", "_rad"),
    ("_ms", "ms", "_s"),
    ("_us", "us", "_s"),
    ("_kn", "kN", "_n"),
    ("_nmm", "Nmm", "_nm"),
];

/// A column of `key` that counts in another unit, and what brings it to SI.
fn other_unit(key: &str, name: &str) -> Option<Fault> {
    let (stem, unit, si) = OTHER_UNITS.iter().find_map(|(ending, unit, si)| Some((name.strip_suffix(ending)?, unit, si)))?;
    let plain = stem.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    let target = if plain { format!("{stem}{si}") } else { format!("\"{stem}{si}\"") };
    let mapping = format!("dataset.toml: [columns] {target} = {{ from = \"{name}\", unit = \"{unit}\" }}");
    Some(Fault::new(key, format!("{name}, in {unit}"), format!("SI units: _m, _rad, _n, _nm, _s ({mapping})")))
}

fn names(theta: &[(String, f64)]) -> Vec<String> {
    theta.iter().map(|(name, _)| name.clone()).collect()
}
