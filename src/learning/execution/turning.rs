//! The orientation of a skill in motion: a primitive on rotation vectors about the profile's reference.
//!
//! ```text
//! q = Q(u) exp(r)        tau^2 r'' = K (c(u) - r) - D tau r'        c = g + b (f(theta, u) - (g - x0) s) + (1 - b s) 2 gdot / omega
//! ```
//!
//! The chart is only entered from outside: start, goal and measured orientation become the rotation vector nearest to the one before, so
//! half and whole turns are no edges. From there on everything is linear, and the goal is reached as that of the position is.

use nalgebra::{UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use super::drive::{Ends, Moment};
use super::movement::Tick;
use crate::learning::OrientationProfile;
use crate::learning::dmp::{Integrator, Motion, TransformationSystem};
use crate::math::{continuous_log, exp_map, right_jacobian, smooth_step};

/// The orientation of a movement. Nothing is allocated after construction.
#[derive(Debug, Clone)]
pub(super) struct Turning {
    profile: OrientationProfile,
    spring: TransformationSystem,
    integrator: Integrator,
    /// `sqrt(K)`, `alpha` and the time fraction from which the net forcing fades out (-).
    root_stiffness: f64,
    alpha: f64,
    gate_start: f64,
    /// The ends that the profile was taught with (rad).
    taught: [Vector3<f64>; 2],
    ends: [Ends; 3],
    /// The goal as an orientation and its angular velocity (rad/s, base axes).
    goal: (UnitQuaternion<f64>, Vector3<f64>),
    motion: [Motion; 3],
    u: f64,
}

/// What of a turning changes from step to step.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct TurningSnapshot {
    ends: [Ends; 3],
    goal: (UnitQuaternion<f64>, Vector3<f64>),
    motion: [Motion; 3],
    u: f64,
}

/// What an orientation needs to know of the movement it belongs to.
pub(super) struct Clockwork {
    pub(super) spring: TransformationSystem,
    pub(super) integrator: Integrator,
    pub(super) stiffness: f64,
    pub(super) alpha: f64,
    pub(super) gate_start: f64,
    pub(super) duration_s: f64,
}

impl Turning {
    /// A profile (at its parameters) at its start, or at the given one.
    pub(super) fn new(profile: OrientationProfile, clock: &Clockwork, ends: [Option<UnitQuaternion<f64>>; 2]) -> Self {
        let ([start, slope, _], [goal, ..]) = (profile.turn(0.0), profile.turn(1.0));
        let frames = [profile.frame(0.0).0, profile.frame(1.0).0];
        let chosen = |i: usize, taught: &Vector3<f64>| ends[i].map_or(*taught, |q| continuous_log(&(frames[i].inverse() * q), taught));
        let (x0, g) = (chosen(0, &start), chosen(1, &goal));
        let end = |j: usize| Ends { start: x0[j], goal: g[j], goal_velocity: 0.0 };
        let motion = |j: usize| Motion { position: x0[j], velocity: slope[j] / clock.duration_s };
        Self {
            spring: clock.spring,
            integrator: clock.integrator,
            root_stiffness: clock.stiffness.sqrt(),
            alpha: clock.alpha,
            gate_start: clock.gate_start,
            taught: [start, goal],
            ends: [end(0), end(1), end(2)],
            goal: (frames[1] * exp_map(&g), Vector3::zeros()),
            motion: [motion(0), motion(1), motion(2)],
            u: 0.0,
            profile,
        }
    }

    /// What there is to go on from.
    pub(super) fn snapshot(&self) -> TurningSnapshot {
        TurningSnapshot { ends: self.ends, goal: self.goal, motion: self.motion, u: self.u }
    }

    /// Goes on from there.
    pub(super) fn restore(&mut self, from: &TurningSnapshot) {
        (self.ends, self.goal, self.motion, self.u) = (from.ends, from.goal, from.motion, from.u);
    }

    /// From now on the goal is `goal` and turns at `angular_velocity` (rad/s, base axes).
    pub(super) fn set_goal(&mut self, goal: UnitQuaternion<f64>, angular_velocity: Vector3<f64>) {
        self.goal = (goal, angular_velocity);
        self.follow_goal();
    }

    /// The goal now.
    pub(super) fn goal(&self) -> UnitQuaternion<f64> {
        self.goal.0
    }

    /// Goes on from a measured orientation and angular velocity (rad/s, base axes), own time passing at the rate `rho`.
    pub(super) fn measure(&mut self, (q, omega): (UnitQuaternion<f64>, Vector3<f64>), rho: f64, duration_s: f64) {
        let (frame, turning) = self.profile.frame(self.u);
        let r = continuous_log(&(frame.inverse() * q), &self.turn());
        let own = q.inverse() * omega - exp_map(&r).inverse() * turning * (rho / duration_s);
        let velocity = right_jacobian(&r).try_inverse().map_or_else(Vector3::zeros, |inverse| inverse * own);
        for (j, motion) in self.motion.iter_mut().enumerate() {
            *motion = Motion { position: r[j], velocity: if rho > 0.0 { velocity[j] / rho } else { 0.0 } };
        }
    }

    /// Goes on by one tick.
    pub(super) fn step(&mut self, tick: &Tick) {
        let Tick { dt, rho, u } = *tick;
        let omega = self.spring.omega();
        let samples = [self.sample(self.u), self.sample(u[0]), self.sample(u[1])];
        let later = [0.0, 0.5 * dt, dt];
        for (j, motion) in self.motion.iter_mut().enumerate() {
            let c = [0, 1, 2].map(|i: usize| {
                let (moment, forcing) = &samples[i];
                moment.pull(forcing[j], &self.ends[j].after(later[i], rho), omega)
            });
            *motion = self.spring.step(self.integrator, *motion, c, rho * dt);
        }
        self.u = u[1];
        if self.goal.1 != Vector3::zeros() {
            self.goal.0 = exp_map(&(self.goal.1 * dt)) * self.goal.0;
            self.follow_goal();
        }
    }

    /// Orientation and angular velocity (rad/s, base axes) now.
    pub(super) fn place(&self, rho: f64, duration_s: f64) -> (UnitQuaternion<f64>, Vector3<f64>) {
        let (frame, turning) = self.profile.frame(self.u);
        let (r, rate) = (self.turn(), Vector3::from_fn(|j, _| self.motion[j].velocity));
        let q = frame * exp_map(&r);
        (q, q * (right_jacobian(&r) * rate * rho) + frame * turning * (rho / duration_s))
    }

    /// Writes the goal and its velocity into the chart.
    fn follow_goal(&mut self) {
        let (q, omega) = self.goal;
        let before = Vector3::from_fn(|j, _| self.ends[j].goal);
        let g = continuous_log(&(self.profile.frame(1.0).0.inverse() * q), &before);
        let rate = right_jacobian(&g).try_inverse().map_or_else(Vector3::zeros, |inverse| inverse * (q.inverse() * omega));
        for (j, ends) in self.ends.iter_mut().enumerate() {
            (ends.goal, ends.goal_velocity) = (g[j], rate[j]);
        }
    }

    fn turn(&self) -> Vector3<f64> {
        Vector3::from_fn(|j, _| self.motion[j].position)
    }

    /// The forcing term (4) at time fraction `u`.
    fn sample(&self, u: f64) -> (Moment, Vector3<f64>) {
        let phase = (-self.alpha * u).exp();
        let [r, slope, bend] = self.profile.turn(u);
        let [x0, g] = self.taught;
        let pulled = r + slope * (2.0 / self.root_stiffness) + bend / (self.root_stiffness * self.root_stiffness);
        (Moment { phase, gate: smooth_step(u, 1.0, self.gate_start) }, pulled - g + (g - x0) * phase)
    }
}
