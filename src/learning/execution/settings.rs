//! What a skill is asked to do.

use nalgebra::UnitQuaternion;

use crate::learning::SettingFault;
use crate::learning::cpdmp::CouplingSettings;
use crate::learning::dmp::Integrator;

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
    /// With which orientation it starts. Default the model's at `theta_m`.
    pub start_orientation: Option<UnitQuaternion<f64>>,
    /// With which orientation it ends: reached along the shorter way from the model's end. Default the model's.
    pub goal_orientation: Option<UnitQuaternion<f64>>,
    /// How long it takes (`tau`, s, > 0). Default as demonstrated.
    pub duration_s: Option<f64>,
    /// How forces act. Default not at all.
    pub coupling: CouplingSettings,
    /// How the movement is integrated. Default exactly, with held forcing.
    pub integrator: Integrator,
    /// Whether the phase waits for a robot that is off the path. Default no.
    pub phase_stopping: Option<PhaseStopping>,
}

/// The phase waits while the robot is off the undisturbed movement: its rate is `max(slowest, 1 / (1 + gain |e|^2))` of the one asked for.
///
/// Because it never falls below `slowest`, the goal is reached after at most `tau / slowest` whatever disturbs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhaseStopping {
    /// `gain` (1 / unit^2, 0 to 1e9): at 1e4 a deviation of 1 cm halves the rate.
    pub gain: f64,
    /// The slowest rate (-, 0.001 to 1).
    pub slowest: f64,
}

impl PhaseStopping {
    /// The share of the asked rate (-) at a squared deviation `e2` (unit^2).
    pub(super) fn share(&self, e2: f64) -> f64 {
        (1.0 / (1.0 + self.gain * e2)).max(self.slowest)
    }

    /// Everything outside its range.
    pub(super) fn faults(&self) -> Vec<SettingFault> {
        let gain = SettingFault::outside("phase_stopping.gain", self.gain, 0.0, 1e9, "1/unit^2");
        let slowest = SettingFault::outside("phase_stopping.slowest", self.slowest, 0.001, 1.0, "");
        gain.into_iter().chain(slowest).collect()
    }
}
