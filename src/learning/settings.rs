//! How a skill is learned.

use super::cpdmp::ComplianceSettings;
use super::dmp::{DEFAULT_ALPHA, PhaseInput};
use super::phmm::PhmmSettings;
use super::selection::{Selection, StatesSearch};
use super::{EndRule, LearningError, SettingFault};

/// What stands for the forcing term.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShapingKind {
    /// The parametric hidden Markov model, read by Gaussian mixture regression: the paper's CPDMP.
    Phmm,
    /// Locally weighted regression over all demonstrations, blind to parameters and without compliance: the paper's baseline.
    Lwr,
}

/// Settings of a whole skill.
#[derive(Debug, Clone, PartialEq)]
pub struct LearningSettings {
    /// What stands for the forcing term. Default the parametric model.
    pub shaping: ShapingKind,
    /// `K` of the spring (-, 1 to 1e7). Default 5000, the paper's.
    pub stiffness: f64,
    /// `alpha`, decay of the phase (-, 0.1 to 20). Default ln 100.
    pub alpha: f64,
    /// What models see of the phase. Default the time fraction.
    pub phase_input: PhaseInput,
    /// Rate at which models see the demonstrations (Hz, 0.1 to 1000). Default 25: people move below 5 Hz.
    pub rate_hz: f64,
    /// Width of the window that differentiates the movement (s, 0.001 to 60). Default 0.5: shorter than a person's strokes, and 0.1 mm
    /// of noise at 100 Hz then stays below 1 mm in the forcing term of a movement of 30 s.
    pub smoothing_window_s: f64,
    /// Degree of the polynomials in that window (2 to 6). Default 4.
    pub smoothing_degree: usize,
    /// Time fraction from which the net forcing fades out, to be gone at 1 (-, 0.5 to 0.999). Default 0.94. Not used by the baseline,
    /// whose forcing term fades with the phase.
    pub gate_start: f64,
    /// The motion model. Default 16 states.
    pub motion: PhmmSettings,
    /// The force model. Default 10 states, as in the paper's code.
    pub force: PhmmSettings,
    /// Basis functions of the baseline (2 to 1000). Default 100, as in the paper's code.
    pub lwr_basis: usize,
    /// Start and goal of the baseline where parameters are given, and do not say them: the mean over the demonstrations, or the regression
    /// on the parameters, as if somebody told them to it. Default the mean.
    pub lwr_ends: EndRule,
    /// Which states comply.
    pub compliance: ComplianceSettings,
    /// Basis functions of the orientation over the time fraction (2 to 500). Default 40.
    pub orientation_basis: usize,
    /// Whether demonstrations are brought to one timing before they are learned from, by one warp each for all columns. Where the
    /// parameters would then predict places that are left out no better, each keeps its own timing, with a warning. Default no.
    pub align: bool,
    /// What of the motion model is chosen from the data. Default nothing: `motion` says it.
    pub motion_selection: Selection,
    /// What of the force model is chosen from the data. Default nothing: `force` says it.
    pub force_selection: Selection,
}

impl Default for LearningSettings {
    fn default() -> Self {
        Self {
            shaping: ShapingKind::Phmm,
            stiffness: 5000.0,
            alpha: DEFAULT_ALPHA,
            phase_input: PhaseInput::TimeFraction,
            rate_hz: 25.0,
            smoothing_window_s: 0.5,
            smoothing_degree: 4,
            gate_start: 0.94,
            motion: PhmmSettings::default(),
            force: PhmmSettings { states: 10, ..PhmmSettings::default() },
            lwr_basis: 100,
            lwr_ends: EndRule::Mean,
            compliance: ComplianceSettings::default(),
            orientation_basis: 40,
            align: false,
            motion_selection: Selection::default(),
            force_selection: Selection::default(),
        }
    }
}

impl LearningSettings {
    /// Checks every range.
    ///
    /// # Errors
    /// All settings outside their ranges at once.
    pub fn check(&self) -> Result<(), LearningError> {
        let mut faults: Vec<SettingFault> = Vec::new();
        let mut check = |name: &str, value: f64, from: f64, to: f64, unit: &str| {
            faults.extend(SettingFault::outside(name, value, from, to, unit));
        };
        check("stiffness", self.stiffness, 1.0, 1e7, "");
        check("alpha", self.alpha, 0.1, 20.0, "");
        check("rate_hz", self.rate_hz, 0.1, 1000.0, "Hz");
        check("smoothing_window_s", self.smoothing_window_s, 0.001, 60.0, "s");
        check("smoothing_degree", self.smoothing_degree as f64, 2.0, 6.0, "");
        check("gate_start", self.gate_start, 0.5, 0.999, "of the duration");
        check("lwr_basis", self.lwr_basis as f64, 2.0, 1000.0, "functions");
        check("orientation_basis", self.orientation_basis as f64, 2.0, 500.0, "functions");
        for StatesSearch { min, max, .. } in [self.motion_selection, self.force_selection].iter().filter_map(|selection| selection.states) {
            check("states_min", min as f64, 1.0, 200.0, "");
            check("states_max", max as f64, min as f64, 200.0, "(at least states_min)");
        }
        faults.extend(self.motion.faults("motion"));
        faults.extend(self.force.faults("force"));
        faults.extend(self.compliance.faults("compliance"));
        if faults.is_empty() { Ok(()) } else { Err(LearningError::Settings(faults)) }
    }
}
