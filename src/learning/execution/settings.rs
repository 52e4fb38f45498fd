//! What a skill is asked to do.

use crate::learning::cpdmp::CouplingSettings;

/// One execution of a skill. By default as demonstrated: start, goal and duration from the model, no coupling.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ExecutionSettings {
    /// Parameters of the motion, by name; all of the skill's.
    pub theta_m: Vec<(String, f64)>,
    /// Parameters of the expected wrench, by name; all of the skill's.
    pub theta_f: Vec<(String, f64)>,
    /// Where the movement starts (d; unit of the columns). Default the model's `x0(theta_m)`.
    pub start: Option<Vec<f64>>,
    /// Where it ends (d). Default the model's `g(theta_m)`.
    pub goal: Option<Vec<f64>>,
    /// How long it takes (`tau`, s, > 0). Default as demonstrated.
    pub duration_s: Option<f64>,
    /// How forces act. Default not at all.
    pub coupling: CouplingSettings,
}
