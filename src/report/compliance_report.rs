//! Where the skill complied, and what the person did.

use schemars::JsonSchema;
use serde::Serialize;

/// Where the skill complies, and why.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ComplianceReport {
    /// The statistic that decides.
    pub statistic: &'static str,
    /// What it must exceed (m²); `null` when no threshold separates the states.
    pub threshold_m2: Option<f64>,
    /// Every state.
    pub states: Vec<ComplianceState>,
    /// When the skill complied during the execution.
    pub windows: Vec<Window>,
}

/// One state of the skill.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ComplianceState {
    /// Its number.
    pub index: usize,
    /// Its value of the statistic (m²).
    pub value_m2: Option<f64>,
    /// Its beta: 0 stiff, -1 complies.
    pub beta: f64,
}

/// A stretch of time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Window {
    /// Start (s).
    pub start_s: f64,
    /// End (s).
    pub end_s: f64,
}

/// What the person did while the skill was executed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct HumanReport {
    /// Largest force (N).
    pub peak_force_n: f64,
    /// Work done on the arm (J).
    pub work_j: f64,
    /// Time with the hand on the arm (s).
    pub contact_s: f64,
}
