//! Where the spring of a movement is pulled to, while start, goal and goal velocity are what the moment says.

use serde::{Deserialize, Serialize};

/// What the phase says at one moment, the same for every degree of freedom.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(super) struct Moment {
    /// `s` (-).
    pub(super) phase: f64,
    /// The gate `b(u)` on the net forcing (-).
    pub(super) gate: f64,
}

/// The ends of one degree of freedom.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Ends {
    /// `x0` (unit).
    pub(super) start: f64,
    /// `g` now (unit).
    pub(super) goal: f64,
    /// `gdot` (unit / s of the primitive's own time).
    pub(super) goal_velocity: f64,
}

impl Moment {
    /// The net forcing `b (f - (g - x0) s)` (unit).
    pub(super) fn net(&self, forcing: f64, ends: &Ends) -> f64 {
        self.gate * (forcing - (ends.goal - ends.start) * self.phase)
    }

    /// The point the spring pulls to, `c = g + b (f - (g - x0) s) + (1 - b s) 2 gdot / omega` (unit).
    ///
    /// The last part is the velocity of what the goal contributes to `c`: a critically damped spring trails behind a point that moves at
    /// `gdot` by `2 gdot / omega`, and with it does not. It vanishes when the goal stops, so the goal is then reached as ever.
    pub(super) fn pull(&self, forcing: f64, ends: &Ends, omega: f64) -> f64 {
        let lead = (1.0 - self.gate * self.phase) * 2.0 * ends.goal_velocity / omega;
        ends.goal + self.net(forcing, ends) + lead
    }
}

impl Ends {
    /// The ends `dt` (s of real time) later, for a primitive whose own time passes at the rate `rho` (-).
    pub(super) fn after(&self, dt: f64, rho: f64) -> Self {
        Self {
            goal: self.goal + self.goal_velocity * dt,
            goal_velocity: if rho > 0.0 { self.goal_velocity / rho } else { 0.0 },
            start: self.start,
        }
    }
}
