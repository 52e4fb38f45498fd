//! Follows a moving tool pose with joint impedance: differential inverse kinematics makes it a moving posture.

use nalgebra::{Isometry3, Vector6};
use serde::{Deserialize, Serialize};

use super::{ArmModel, ImpedanceSettings};
use crate::robot::{JointCommand, pose_error};

/// A tracker of tool poses. It integrates its own joint reference, so what a person does to the arm never bends the plan.
pub struct PoseTracker {
    model: ArmModel,
    settings: ImpedanceSettings,
    step_s: f64,
    reference_q: Vec<f64>,
    reference_v: Vec<f64>,
    gravity_torque: Vec<f64>,
    last: Option<Isometry3<f64>>,
}

/// What of a tracker changes from step to step.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct TrackerSnapshot {
    reference_q: Vec<f64>,
    reference_v: Vec<f64>,
    last: Option<Isometry3<f64>>,
}

impl PoseTracker {
    /// What there is to go on from.
    pub(super) fn snapshot(&self) -> TrackerSnapshot {
        TrackerSnapshot { reference_q: self.reference_q.clone(), reference_v: self.reference_v.clone(), last: self.last }
    }

    /// Goes on from there; `false` when that is of another arm.
    pub(super) fn restore(&mut self, from: TrackerSnapshot) -> bool {
        let n = self.reference_q.len();
        let fits = [from.reference_q.len(), from.reference_v.len()] == [n; 2];
        if fits {
            (self.reference_q, self.reference_v, self.last) = (from.reference_q, from.reference_v, from.last);
        }
        fits
    }

    /// A tracker for control steps of `step_s` (s).
    pub fn new(model: ArmModel, settings: ImpedanceSettings, step_s: f64) -> Self {
        let n = model.joints();
        Self { model, settings, step_s, reference_q: vec![0.0; n], reference_v: vec![0.0; n], gravity_torque: vec![0.0; n], last: None }
    }

    /// Writes the command that brings the tool to `reference` (base frame), the arm being at `q` (rad).
    pub fn track(&mut self, reference: &Isometry3<f64>, q: &[f64], command: &mut JointCommand) {
        let twist = match &self.last {
            Some(last) => pose_error(reference, last) / self.step_s,
            None => {
                self.reference_q.copy_from_slice(q);
                Vector6::zeros()
            }
        };
        self.model.follow(reference, &twist, self.step_s, &self.reference_q, &mut self.reference_v);
        for (reference, velocity) in self.reference_q.iter_mut().zip(&self.reference_v) {
            *reference += velocity * self.step_s;
        }
        self.last = Some(*reference);
        self.model.gravity_torques(q, &mut self.gravity_torque);
        self.settings.command(&self.gravity_torque, q, &self.reference_q, &self.reference_v, command);
    }
}
