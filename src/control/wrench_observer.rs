//! The wrench at the tool as the arm itself can know it: joint efforts against its own model, then a low-pass.

use std::f64::consts::TAU;

use nalgebra::Vector6;
use serde::{Deserialize, Serialize};

use super::{ArmModel, Observation};
use crate::robot::{EffortModel, JointReading, WrenchEstimator};

/// lambda² of the inversion: far below the squared singular values of the workspace (0.09² and up), so that it costs 0.01 % there.
const DAMPING: f64 = 1e-6;

/// Estimates the wrench by the environment on the tool, base axes, at the tool point.
#[derive(Clone, Debug)]
pub struct WrenchObserver {
    estimator: WrenchEstimator,
    model: ArmModel,
    step_s: f64,
    /// Share of a new estimate that enters the low-pass in one step.
    gain: f64,
    /// Posture and velocity at the start of the step whose efforts are now measured.
    last: Option<(Vec<f64>, Vec<f64>)>,
    acceleration: Vec<f64>,
    effort: Vec<f64>,
    filtered: Option<Vector6<f64>>,
}

/// What of an observer changes from step to step.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct ObserverSnapshot {
    last: Option<(Vec<f64>, Vec<f64>)>,
    filtered: Option<Vector6<f64>>,
}

impl WrenchObserver {
    /// What there is to go on from.
    pub(super) fn snapshot(&self) -> ObserverSnapshot {
        ObserverSnapshot { last: self.last.clone(), filtered: self.filtered }
    }

    /// Goes on from there; `false` when that is of another arm.
    pub(super) fn restore(&mut self, from: ObserverSnapshot) -> bool {
        let n = self.effort.len();
        let fits = from.last.as_ref().is_none_or(|(q, v)| [q.len(), v.len()] == [n; 2]);
        if fits {
            (self.last, self.filtered) = (from.last, from.filtered);
        }
        fits
    }

    /// An observer for control steps of `step_s` (s); `cutoff_hz` of the first-order low-pass, infinite for none.
    pub fn new(model: ArmModel, kind: EffortModel, cutoff_hz: f64, step_s: f64) -> Self {
        let n = model.joints();
        let estimator = WrenchEstimator::new(&model.chain, kind, DAMPING);
        let gain = if cutoff_hz.is_finite() { 1.0 - (-TAU * cutoff_hz * step_s).exp() } else { 1.0 };
        Self { estimator, model, step_s, gain, last: None, acceleration: vec![0.0; n], effort: vec![0.0; n], filtered: None }
    }

    /// The wrench during the last step: force (N), torque (N m). Zero at the first call, before anything was measured.
    ///
    /// The efforts were delivered while the arm went from the last posture to this one, so the model is evaluated at the last posture, the
    /// new velocity and their difference quotient: with a perfect sensor that is the simulated step itself, and the estimate is exact.
    pub fn observe(&mut self, now: &Observation) -> Vector6<f64> {
        let Some((q, v)) = &mut self.last else {
            self.last = Some((now.position.clone(), now.velocity.clone()));
            return Vector6::zeros();
        };
        for (acceleration, (after, before)) in self.acceleration.iter_mut().zip(now.velocity.iter().zip(v.iter())) {
            *acceleration = (after - before) / self.step_s;
        }
        self.effort.copy_from_slice(&now.effort);
        if self.estimator.model == EffortModel::FullDynamics {
            // The joints' own damping lies behind the effort sensor.
            for (i, joint) in self.model.chain.joints().enumerate() {
                self.effort[i] -= joint.damping * now.velocity[i];
            }
        }
        let reading = JointReading { q, v: &now.velocity, a: &self.acceleration, effort: &self.effort };
        let estimate = self.estimator.estimate(&self.model.chain, &reading, &self.model.gravity, &mut self.model.state);
        q.copy_from_slice(&now.position);
        v.copy_from_slice(&now.velocity);
        let filtered = self.filtered.unwrap_or_else(Vector6::zeros);
        // In a singular posture nothing new is known: keep the last estimate.
        let raw = estimate.map_or(filtered, |w| Vector6::new(w.force.x, w.force.y, w.force.z, w.torque.x, w.torque.y, w.torque.z));
        let next = if self.filtered.is_none() { raw } else { filtered + (raw - filtered) * self.gain };
        self.filtered = Some(next);
        next
    }
}
