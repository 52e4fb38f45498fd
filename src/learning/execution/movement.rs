//! The position of a skill in motion: the undisturbed movement and the deviation from it.

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::drive::{Ends, Moment};
use crate::learning::cpdmp::ShapingFunction;
use crate::learning::dmp::{Integrator, Motion, TransformationSystem};

/// All degrees of freedom of a movement. Nothing is allocated after construction.
#[derive(Debug, Clone)]
pub(super) struct Movement {
    pub(super) spring: TransformationSystem,
    integrator: Integrator,
    shaping: ShapingFunction,
    ends: Vec<Ends>,
    undisturbed: Vec<Motion>,
    deviation: Vec<Motion>,
    /// The forcing term now, at the middle of a step, and at its end.
    now: Sample,
    middle: Sample,
    next: Sample,
}

/// The forcing term at one moment.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Sample {
    moment: Moment,
    forcing: Vec<f64>,
    state: usize,
}

/// What of a movement changes from step to step.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct MovementSnapshot {
    ends: Vec<Ends>,
    undisturbed: Vec<Motion>,
    deviation: Vec<Motion>,
    now: Sample,
}

/// One step of the clock.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tick {
    /// Real time (s) that passes.
    pub(super) dt: f64,
    /// Rate of the primitive's own time (-).
    pub(super) rho: f64,
    /// Time fractions at the step's middle and end (-).
    pub(super) u: [f64; 2],
}

impl Movement {
    /// A movement at rest at `start`.
    pub(super) fn new(
        shaping: ShapingFunction,
        spring: TransformationSystem,
        integrator: Integrator,
        start: &DVector<f64>,
        goal: &DVector<f64>,
    ) -> Self {
        let d = start.len();
        let sample = Sample { moment: Moment::default(), forcing: vec![0.0; d], state: 0 };
        let mut movement = Self {
            spring,
            integrator,
            shaping,
            ends: start.iter().zip(goal.iter()).map(|(x0, g)| Ends { start: *x0, goal: *g, goal_velocity: 0.0 }).collect(),
            undisturbed: start.iter().map(|x| Motion { position: *x, velocity: 0.0 }).collect(),
            deviation: vec![Motion::default(); d],
            now: sample.clone(),
            middle: sample.clone(),
            next: sample,
        };
        movement.now.take(&mut movement.shaping, 0.0);
        movement
    }

    /// What there is to go on from.
    pub(super) fn snapshot(&self) -> MovementSnapshot {
        let Self { ends, undisturbed, deviation, now, .. } = self.clone();
        MovementSnapshot { ends, undisturbed, deviation, now }
    }

    /// Goes on from there; `false` when that is of a movement with other columns.
    pub(super) fn restore(&mut self, from: MovementSnapshot) -> bool {
        let d = self.ends.len();
        let fits = [from.ends.len(), from.undisturbed.len(), from.deviation.len(), from.now.forcing.len()] == [d; 4];
        if fits {
            (self.ends, self.undisturbed, self.deviation, self.now) = (from.ends, from.undisturbed, from.deviation, from.now);
        }
        fits
    }

    /// The most responsible state now.
    pub(super) fn state(&self) -> usize {
        self.now.state
    }

    /// `|e|^2` (unit^2).
    pub(super) fn squared_deviation(&self) -> f64 {
        self.deviation.iter().map(|e| e.position * e.position).sum()
    }

    /// From now on the goal is `goal` and moves at `velocity` (unit / s).
    pub(super) fn set_goal(&mut self, goal: &[f64], velocity: &[f64]) {
        for (ends, (g, gdot)) in self.ends.iter_mut().zip(goal.iter().zip(velocity)) {
            (ends.goal, ends.goal_velocity) = (*g, *gdot);
        }
    }

    /// The goal now.
    pub(super) fn goal(&self, j: usize) -> f64 {
        self.ends[j].goal
    }

    /// The deviation is what puts the robot where it was measured.
    pub(super) fn measure_position(&mut self, position: &[f64]) {
        for (e, (x, p)) in self.deviation.iter_mut().zip(position.iter().zip(&self.undisturbed)) {
            e.position = x - p.position;
        }
    }

    /// The same for velocities, while the primitive's own time passes at the rate `rho`.
    pub(super) fn measure_velocity(&mut self, velocity: &[f64], rho: f64) {
        for (e, (v, p)) in self.deviation.iter_mut().zip(velocity.iter().zip(&self.undisturbed)) {
            e.velocity = v - rho * p.velocity;
        }
    }

    /// Goes on by one tick under displacements `zeta / K` (unit).
    pub(super) fn step(&mut self, tick: &Tick, displacement: &[f64]) {
        let Tick { dt, rho, u } = *tick;
        self.middle.take(&mut self.shaping, u[0]);
        self.next.take(&mut self.shaping, u[1]);
        let omega = self.spring.omega();
        for (j, ends) in self.ends.iter_mut().enumerate() {
            let pull = |sample: &Sample, later: f64| sample.moment.pull(sample.forcing[j], &ends.after(later, rho), omega);
            let c = [pull(&self.now, 0.0), pull(&self.middle, 0.5 * dt), pull(&self.next, dt)];
            self.undisturbed[j] = self.spring.step(self.integrator, self.undisturbed[j], c, rho * dt);
            self.deviation[j] = self.spring.step(self.integrator, self.deviation[j], [displacement[j]; 3], dt);
            ends.goal += ends.goal_velocity * dt;
        }
        std::mem::swap(&mut self.now, &mut self.next);
    }

    /// `[x, xdot, xddot, e, net forcing]` of degree of freedom `j`, under a displacement `zeta / K` (unit).
    pub(super) fn place(&self, j: usize, rho: f64, displacement: f64) -> [f64; 5] {
        let (p, e, forcing) = (self.undisturbed[j], self.deviation[j], self.now.forcing[j]);
        let c = self.now.moment.pull(forcing, &self.ends[j].after(0.0, rho), self.spring.omega());
        let acceleration = rho * rho * self.spring.acceleration(p, c) + self.spring.acceleration(e, displacement);
        let net = self.now.moment.net(forcing, &self.ends[j]);
        [p.position + e.position, rho * p.velocity + e.velocity, acceleration, e.position, net]
    }
}

impl Sample {
    fn take(&mut self, shaping: &mut ShapingFunction, u: f64) {
        self.state = shaping.forcing(u, &mut self.forcing);
        self.moment = Moment { phase: (-shaping.alpha() * u).exp(), gate: shaping.gate(u) };
    }
}
