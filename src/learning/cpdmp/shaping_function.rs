//! The forcing term at one parameter value, as a function of the phase; a query allocates nothing.

use nalgebra::DVector;

use crate::learning::Gmr;
use crate::learning::dmp::{Lwr, PhaseInput};
use crate::math::smooth_step;

/// `f(theta_m, s)` for a fixed `theta_m`.
#[derive(Debug, Clone)]
pub struct ShapingFunction {
    alpha: f64,
    kind: Kind,
}

#[derive(Debug, Clone)]
enum Kind {
    Gmr { gmr: Gmr, input: PhaseInput, gate_start: f64, weights: Vec<f64> },
    Lwr(Lwr),
}

impl ShapingFunction {
    /// From a mixture over (phase input, forcing term); the net forcing fades out from `gate_start` (time fraction) to 1.
    #[must_use]
    pub fn from_gmr(gmr: Gmr, input: PhaseInput, alpha: f64, gate_start: f64) -> Self {
        let weights = vec![0.0; gmr.components()];
        Self { alpha, kind: Kind::Gmr { gmr, input, gate_start, weights } }
    }

    /// From the baseline, whose forcing term fades with the phase on its own.
    #[must_use]
    pub fn from_lwr(lwr: Lwr, alpha: f64) -> Self {
        Self { alpha, kind: Kind::Lwr(lwr) }
    }

    /// The mixture and its input, when there is one.
    #[must_use]
    pub fn mixture(&self) -> Option<(&Gmr, PhaseInput)> {
        match &self.kind {
            Kind::Gmr { gmr, input, .. } => Some((gmr, *input)),
            Kind::Lwr(_) => None,
        }
    }

    /// `alpha` (-).
    #[must_use]
    pub fn alpha(&self) -> f64 {
        self.alpha
    }

    /// `f(theta_m, s)` (d; unit of the columns) at time fraction `u`, ungated, and the most responsible state there (0 for the
    /// baseline). A mixture is asked no further than `u = 1`.
    pub fn forcing(&mut self, u: f64, forcing: &mut [f64]) -> usize {
        match &mut self.kind {
            Kind::Gmr { gmr, input, weights, .. } => {
                let x = [input.at(u.clamp(0.0, 1.0), self.alpha)];
                gmr.weights(&x, weights);
                gmr.mean_into(&x, weights, forcing);
                most_responsible(weights)
            }
            Kind::Lwr(lwr) => {
                lwr.forcing((-self.alpha * u).exp(), forcing);
                0
            }
        }
    }

    /// The net forcing `b(u) (f - (g - x0) s)` (d): where the spring is pulled to, seen from the goal. A mixture's `f` does not fade
    /// with the phase, so the gate `b` takes the whole to 0 by a minimum-jerk ramp, and the goal is reached.
    pub fn net_forcing(&mut self, u: f64, start: &DVector<f64>, goal: &DVector<f64>, net: &mut [f64]) {
        self.forcing(u, net);
        let (s, gate) = ((-self.alpha * u).exp(), self.gate(u));
        for (f, (x0, g)) in net.iter_mut().zip(start.iter().zip(goal.iter())) {
            *f = gate * (*f - (g - x0) * s);
        }
    }

    /// The gate `b(u)` (-): 1, then falling to 0 at `u = 1`; always 1 for the baseline.
    #[must_use]
    pub fn gate(&self, u: f64) -> f64 {
        match &self.kind {
            Kind::Gmr { gate_start, .. } => smooth_step(u, 1.0, *gate_start),
            Kind::Lwr(_) => 1.0,
        }
    }

    /// The most responsible state at time fraction `u` (clamped to [0, 1]); 0 for the baseline.
    pub fn active_state(&mut self, u: f64) -> usize {
        let Kind::Gmr { gmr, input, weights, .. } = &mut self.kind else { return 0 };
        gmr.weights(&[input.at(u.clamp(0.0, 1.0), self.alpha)], weights);
        most_responsible(weights)
    }
}

/// The first of the largest weights.
fn most_responsible(weights: &[f64]) -> usize {
    let mut best = 0;
    for (i, h) in weights.iter().enumerate() {
        if *h > weights[best] {
            best = i;
        }
    }
    best
}
