//! The numbers that differ from setting to setting, by name.

/// The task parameters of one setting by name (for example `block_height_m`), in the order of the scenario file. Values in SI.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parameters(pub Vec<(String, f64)>);

impl Parameters {
    /// The value of the parameter `name`, if this setting has it.
    pub fn get(&self, name: &str) -> Option<f64> {
        self.0.iter().find(|(key, _)| key == name).map(|(_, value)| *value)
    }

    /// A copy in which the given parameters have the given values; a name that is new is appended.
    pub fn with(&self, changes: &[(String, f64)]) -> Self {
        let mut changed = self.clone();
        for (name, value) in changes {
            match changed.0.iter_mut().find(|(key, _)| key == name) {
                Some(entry) => entry.1 = *value,
                None => changed.0.push((name.clone(), *value)),
            }
        }
        changed
    }
}

/// A number, or the name of the task parameter that gives it.
#[derive(Clone, Debug, PartialEq)]
pub enum Quantity {
    /// The number itself, in the unit of its key.
    Value(f64),
    /// The name of a task parameter.
    Parameter(String),
}

impl From<f64> for Quantity {
    fn from(value: f64) -> Self {
        Self::Value(value)
    }
}

impl Quantity {
    /// The number in this setting. An unknown parameter name is NaN; scenario validation refuses it beforehand.
    pub fn resolve(&self, parameters: &Parameters) -> f64 {
        match self {
            Self::Value(value) => *value,
            Self::Parameter(name) => parameters.get(name).unwrap_or(f64::NAN),
        }
    }
}
