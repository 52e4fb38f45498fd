//! How parameters are inferred.

use crate::learning::{LearningError, SettingFault};

/// How parameters are inferred.
#[derive(Debug, Clone, PartialEq)]
pub struct InferenceSettings {
    /// How long the whole movement will take (s, > 0); `None`: as long as the demonstrations.
    pub duration_s: Option<f64>,
    /// Rate at which the model sees the movement (Hz, 0.1 to 1000): that of learning. Default 25.
    pub rate_hz: f64,
    /// Width of the window that differentiates the movement (s, 0.001 to 60). Default 0.5, as in learning.
    pub smoothing_window_s: f64,
    /// Degree of the polynomials in that window (2 to 6). Default 4.
    pub smoothing_degree: usize,
}

impl Default for InferenceSettings {
    fn default() -> Self {
        Self { duration_s: None, rate_hz: 25.0, smoothing_window_s: 0.5, smoothing_degree: 4 }
    }
}

impl InferenceSettings {
    pub(super) fn check(&self) -> Result<(), LearningError> {
        let mut faults = Vec::new();
        let mut check = |name: &str, value: f64, from: f64, to: f64, unit: &str| {
            faults.extend(SettingFault::outside(name, value, from, to, unit));
        };
        check("duration_s", self.duration_s.unwrap_or(1.0), 1e-3, 1e6, "s");
        check("rate_hz", self.rate_hz, 0.1, 1000.0, "Hz");
        check("smoothing_window_s", self.smoothing_window_s, 0.001, 60.0, "s");
        check("smoothing_degree", self.smoothing_degree as f64, 2.0, 6.0, "");
        if faults.is_empty() { Ok(()) } else { Err(LearningError::Settings(faults)) }
    }
}
