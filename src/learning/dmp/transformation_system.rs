//! The spring that follows the forcing term (1), (2): one degree of freedom, `xddot = omega^2 (c - x) - 2 omega xdot` for a point `c`
//! that moves with the phase.

/// Position and velocity of one degree of freedom.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize, serde::Deserialize)]
pub struct Motion {
    /// Position (unit of the column, e.g. m).
    pub position: f64,
    /// Velocity (unit / s).
    pub velocity: f64,
}

/// How the springs of a movement are integrated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Integrator {
    /// The exact solution for a forcing that is held over the step, at its value in the middle: second order, stable for every step.
    #[default]
    ExactHold,
    /// The classical Runge-Kutta method: fourth order where the forcing is smooth. A step longer than `2 / omega`, close to its limit of
    /// `2.79 / omega`, is held exactly instead.
    RungeKutta4,
}

/// The critically damped spring `tau vdot = K (c - x) - 2 sqrt(K) v`, `tau xdot = v`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TransformationSystem {
    omega: f64,
}

/// The longest step that is left to Runge-Kutta, in units of `1 / omega` (-).
const LONGEST_STEP: f64 = 2.0;

impl TransformationSystem {
    /// From `stiffness` (`K`, -, > 0) and `duration_s` (`tau`, s, > 0).
    #[must_use]
    pub fn new(stiffness: f64, duration_s: f64) -> Self {
        Self { omega: stiffness.sqrt() / duration_s }
    }

    /// `omega = sqrt(K) / tau` (rad/s).
    #[must_use]
    pub fn omega(&self) -> f64 {
        self.omega
    }

    /// `xddot` (unit / s^2) for the spring pulling to `c`.
    #[must_use]
    pub fn acceleration(&self, motion: Motion, c: f64) -> f64 {
        self.omega * (self.omega * (c - motion.position) - 2.0 * motion.velocity)
    }

    /// The state after `dt_s` (s) with `c` held: the exact solution, stable for every step. With `c` taken at the middle of the step,
    /// a moving `c` is followed to second order.
    ///
    /// `x - c = (e0 + (v0 + omega e0) t) exp(-omega t)`.
    #[must_use]
    pub fn hold(&self, motion: Motion, c: f64, dt_s: f64) -> Motion {
        let e = motion.position - c;
        let b = motion.velocity + self.omega * e;
        let decay = (-self.omega * dt_s).exp();
        Motion { position: c + (e + b * dt_s) * decay, velocity: (motion.velocity - self.omega * b * dt_s) * decay }
    }

    /// The state after `dt_s` (s), with `c` at the step's start, middle and end.
    #[must_use]
    pub fn step(&self, integrator: Integrator, motion: Motion, c: [f64; 3], dt_s: f64) -> Motion {
        match integrator {
            Integrator::RungeKutta4 if self.omega * dt_s <= LONGEST_STEP => self.runge_kutta(motion, c, dt_s),
            _ => self.hold(motion, c[1], dt_s),
        }
    }

    /// One classical Runge-Kutta step of `dt_s` (s), with `c` at the step's start, middle and end: fourth order, stable below
    /// `omega dt = 2.79`.
    #[must_use]
    pub fn runge_kutta(&self, motion: Motion, c: [f64; 3], dt_s: f64) -> Motion {
        let slope = |m: Motion, c: f64| Motion { position: m.velocity, velocity: self.acceleration(m, c) };
        let along = |k: Motion, h: f64| Motion { position: motion.position + h * k.position, velocity: motion.velocity + h * k.velocity };
        let k1 = slope(motion, c[0]);
        let k2 = slope(along(k1, 0.5 * dt_s), c[1]);
        let k3 = slope(along(k2, 0.5 * dt_s), c[1]);
        let k4 = slope(along(k3, dt_s), c[2]);
        let mean = |a: f64, b: f64, c: f64, d: f64| (a + 2.0 * b + 2.0 * c + d) / 6.0;
        let k = Motion {
            position: mean(k1.position, k2.position, k3.position, k4.position),
            velocity: mean(k1.velocity, k2.velocity, k3.velocity, k4.velocity),
        };
        along(k, dt_s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Follows `c(t) = sin 3t` for 1 s; the closed form is a sinusoid plus a decaying part.
    fn error_after(steps: usize, held: bool) -> f64 {
        let system = TransformationSystem::new(100.0, 2.0);
        let dt = 1.0 / steps as f64;
        let mut m = Motion::default();
        for i in 0..steps {
            let c = [0.0, 0.5, 1.0].map(|part| (3.0 * dt * (i as f64 + part)).sin());
            m = if held { system.hold(m, c[1], dt) } else { system.runge_kutta(m, c, dt) };
        }
        (m.position - closed_form(system.omega(), 3.0, 1.0)).abs()
    }

    /// `xddot + 2 w xdot + w^2 x = w^2 sin(p t)` from rest at 0.
    fn closed_form(w: f64, p: f64, t: f64) -> f64 {
        let scale = w * w / (w * w + p * p).powi(2);
        let (a, b) = (scale * (w * w - p * p), -2.0 * scale * w * p);
        a * (p * t).sin() + b * (p * t).cos() + (-b - (a * p + w * b) * t) * (-w * t).exp()
    }

    #[test]
    fn the_held_step_is_of_second_and_runge_kutta_of_fourth_order() {
        for (held, order) in [(true, 2.0), (false, 4.0)] {
            let measured = (error_after(40, held) / error_after(80, held)).log2();
            assert!((measured - order).abs() < 0.15, "order {measured}, expected {order}");
        }
    }

    #[test]
    fn a_held_point_is_followed_exactly_in_one_step_or_many() {
        let system = TransformationSystem::new(5000.0, 28.0);
        let start = Motion { position: 0.3, velocity: -0.2 };
        let once = system.hold(start, 1.0, 2.0);
        let many = (0..1000).fold(start, |m, _| system.hold(m, 1.0, 0.002));
        assert!((once.position - many.position).abs() < 1e-12 && (once.velocity - many.velocity).abs() < 1e-12);
        assert!((system.hold(start, 1.0, 1e4).position - 1.0).abs() < 1e-15);
    }
}
