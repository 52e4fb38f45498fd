//! The part of a movement that was seen, as the model sees it.

use nalgebra::DVector;

use super::InferenceSettings;
use crate::demonstration::Trajectory;
use crate::learning::LearningError;
use crate::learning::cpdmp::MotionModel;
use crate::learning::dmp::forcing_target;
use crate::math::SmoothingDerivative;

/// The observed part: phase inputs, phases and the forcing targets for a goal at the origin.
pub(super) struct Part {
    pub(super) inputs: Vec<f64>,
    pub(super) phases: Vec<f64>,
    pub(super) targets: Vec<DVector<f64>>,
}

impl Part {
    pub(super) fn of(motion: &MotionModel, observed: &Trajectory, settings: &InferenceSettings) -> Result<Self, LearningError> {
        let duration = settings.duration_s.unwrap_or(motion.duration_s);
        let seen = observed.duration_s();
        if seen > duration * (1.0 + 1e-6) {
            let hint = "observe less, or say how long the movement takes";
            return Err(LearningError::Request(format!("{seen:.3} s are observed, but the movement lasts {duration:.3} s: {hint}")));
        }
        // Differentiated at the rate it was recorded at, then thinned out to the rate of learning.
        let recorded = (observed.samples() - 1) as f64 / seen;
        let thinning = (recorded / settings.rate_hz).round().max(1.0);
        let uniform = observed.resampled(settings.rate_hz * thinning)?;
        let (samples, step) = (uniform.samples(), uniform.duration_s() / (uniform.samples() - 1) as f64);
        let wanted = ((settings.smoothing_window_s / step / 2.0).round() as usize) * 2 + 1;
        let window = wanted.max((settings.smoothing_degree + 2) | 1);
        // The last half window is left out: derivatives at an open end are many times noisier.
        let last = samples.saturating_sub(window / 2 + 1);
        if samples < window || last == 0 {
            let least = window as f64 * step;
            return Err(LearningError::Request(format!("{seen:.3} s are observed, but inference needs at least {least:.3} s")));
        }
        let filter = SmoothingDerivative::new(step, window, settings.smoothing_degree)?;
        let omega = motion.stiffness.sqrt() / duration;
        let positions = uniform.select(&motion.columns)?;
        let columns = positions.column_iter().map(|column| filter.apply(column.into_owned().as_slice()));
        let smooth = columns.collect::<Result<Vec<_>, _>>()?;
        let mut part = Self { inputs: Vec::new(), phases: Vec::new(), targets: Vec::new() };
        for t in (0..=last).step_by(thinning as usize) {
            let u = t as f64 * step / duration;
            let phase = (-motion.alpha * u).exp();
            let target = smooth.iter().map(|c| forcing_target([c.value[t], c.first[t], c.second[t]], c.value[0], 0.0, phase, omega));
            part.inputs.push(motion.phase_input.at(u, motion.alpha));
            part.phases.push(phase);
            part.targets.push(DVector::from_iterator(smooth.len(), target));
        }
        Ok(part)
    }
}
