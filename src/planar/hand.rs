//! A hand that shows planar movements past an obstacle: smooth, never twice the same, seen by a noisy sensor.

use nalgebra::DMatrix;
use rand_chacha::ChaCha8Rng;

use crate::demonstration::{Demonstration, DemonstrationError, Parameters, Trajectory};
use crate::learning::SettingFault;
use crate::math::{minimum_jerk, standard_normal, stream};

/// Columns of every planar movement.
pub const COLUMNS: [&str; 2] = ["x_m", "y_m"];

/// How a person shows a movement.
#[derive(Debug, Clone, PartialEq)]
pub struct HandSettings {
    /// How often each situation is shown (1 to 50). Default 2.
    pub repetitions: usize,
    /// Mean duration (s, 0.5 to 60). Default 4: an unhurried reach.
    pub duration_s: f64,
    /// Sampling rate (Hz, 10 to 1000). Default 100.
    pub rate_hz: f64,
    /// Standard deviation of the duration, as a fraction of it (-, 0 to 0.3). Default 0.05.
    pub duration_spread: f64,
    /// Standard deviation of when the obstacle is passed, as a fraction of the duration (-, 0 to 0.1). Default 0.02.
    pub timing_spread: f64,
    /// Standard deviation of where it is passed, per axis (m, 0 to 1). Default 0.05: 5 % of the obstacle's half width.
    pub shape_spread_m: f64,
    /// Standard deviation of the position sensor per axis (m, 0 to 0.1). Default 0.002.
    pub noise_m: f64,
}

impl Default for HandSettings {
    fn default() -> Self {
        Self {
            repetitions: 2,
            duration_s: 4.0,
            rate_hz: 100.0,
            duration_spread: 0.05,
            timing_spread: 0.02,
            shape_spread_m: 0.05,
            noise_m: 0.002,
        }
    }
}

impl HandSettings {
    /// Everything that is outside its range.
    #[must_use]
    pub fn faults(&self) -> Vec<SettingFault> {
        let checks = [
            ("hand.repetitions", self.repetitions as f64, 1.0, 50.0, ""),
            ("hand.duration_s", self.duration_s, 0.5, 60.0, "s"),
            ("hand.rate_hz", self.rate_hz, 10.0, 1000.0, "Hz"),
            ("hand.duration_spread", self.duration_spread, 0.0, 0.3, "of the duration"),
            ("hand.timing_spread", self.timing_spread, 0.0, 0.1, "of the duration"),
            ("hand.shape_spread_m", self.shape_spread_m, 0.0, 1.0, "m"),
            ("hand.noise_m", self.noise_m, 0.0, 0.1, "m"),
        ];
        checks.iter().filter_map(|(name, value, from, to, unit)| SettingFault::outside(name, *value, *from, *to, unit)).collect()
    }
}

/// A movement from rest to rest through one point, with the least jerk (T. Flash and N. Hogan, J. Neuroscience 5(7), 1985).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HandPath {
    /// Where it starts (m).
    pub start_m: [f64; 2],
    /// The point it passes (m).
    pub via_m: [f64; 2],
    /// When it passes it, as a fraction of the duration (-, in (0, 1)).
    pub via_fraction: f64,
    /// Where it ends (m).
    pub goal_m: [f64; 2],
}

impl HandPath {
    /// The position (m) at a fraction `u` of the duration.
    ///
    /// `x = x0 + (g - x0) m(u) + [via - x0 - (g - x0) m(u1)] phi(u) / phi(u1)`: the fifth-order spline with one knot at `u1`; `m` is the
    /// minimum-jerk step and `phi` starts and ends at rest in 0.
    #[must_use]
    pub fn at(&self, u: f64) -> [f64; 2] {
        let (u, u1) = (u.clamp(0.0, 1.0), self.via_fraction);
        let (m, m1) = (minimum_jerk(u).position, minimum_jerk(u1).position);
        let share = bump(u, u1) / bump(u1, u1);
        [0, 1].map(|i| {
            let (x0, way) = (self.start_m[i], self.goal_m[i] - self.start_m[i]);
            x0 + way * m + (self.via_m[i] - x0 - way * m1) * share
        })
    }

    /// Equally timed positions (m), `samples` (>= 2) of them.
    #[must_use]
    pub fn sampled(&self, samples: usize) -> Vec<[f64; 2]> {
        (0..samples).map(|t| self.at(t as f64 / (samples - 1) as f64)).collect()
    }

    /// The movement as a person shows it: at another pace, past a point nearby, seen by the sensor. `index` numbers the demonstrations.
    ///
    /// # Errors
    /// When times or values are not those of a trajectory.
    pub fn demonstrated(
        &self,
        hand: &HandSettings,
        theta_m: Parameters,
        seed: u64,
        index: usize,
    ) -> Result<Demonstration, DemonstrationError> {
        let mut person = stream(seed, "planar hand", index as u64);
        let mut sensor = stream(seed, "planar sensor", index as u64);
        // Draws beyond three standard deviations would make a person reverse time or pass on the wrong side.
        let draw = |random: &mut ChaCha8Rng| standard_normal(random).clamp(-3.0, 3.0);
        let duration = hand.duration_s * (1.0 + hand.duration_spread * draw(&mut person));
        let mut shown = *self;
        shown.via_fraction = (self.via_fraction + hand.timing_spread * draw(&mut person)).clamp(0.05, 0.95);
        shown.via_m = self.via_m.map(|x| x + hand.shape_spread_m * draw(&mut person));
        let samples = (duration * hand.rate_hz).round() as usize + 1;
        let mut values = DMatrix::zeros(samples, 2);
        for (t, p) in shown.sampled(samples).into_iter().enumerate() {
            for (i, x) in p.into_iter().enumerate() {
                values[(t, i)] = x + hand.noise_m * standard_normal(&mut sensor);
            }
        }
        let times = (0..samples).map(|t| t as f64 / hand.rate_hz).collect();
        let trajectory = Trajectory::new(times, COLUMNS.map(str::to_owned).to_vec(), values)?;
        Ok(Demonstration { name: format!("demonstration_{index}"), trajectory, theta_m, theta_f: Vec::new() })
    }
}

/// The spline with a knot at `u1` that starts and ends at 0 with no velocity and no acceleration: `(u - u1)_+^5 - a u^3 - b u^4 - c u^5`.
fn bump(u: f64, u1: f64) -> f64 {
    let rest = 1.0 - u1;
    let (value, slope, curvature) = (rest.powi(5), 5.0 * rest.powi(4), 20.0 * rest.powi(3));
    let a = 10.0 * value - 4.0 * slope + 0.5 * curvature;
    let b = -15.0 * value + 7.0 * slope - curvature;
    let c = 6.0 * value - 3.0 * slope + 0.5 * curvature;
    (u - u1).max(0.0).powi(5) - u.powi(3) * (a + u * (b + u * c))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_movement_starts_and_ends_at_rest_and_passes_its_point_smoothly() {
        let path = HandPath { start_m: [0.0, -4.0], via_m: [2.0, 0.3], via_fraction: 0.4, goal_m: [-1.0, 4.0] };
        for (u, p) in [(0.0, path.start_m), (0.4, path.via_m), (1.0, path.goal_m)] {
            assert!((0..2).all(|i| (path.at(u)[i] - p[i]).abs() < 1e-12));
        }
        let h = 1e-3;
        for u in [h, 1.0 - h] {
            let speed = (path.at(u + h)[0] - path.at(u - h)[0]) / (2.0 * h);
            assert!(speed.abs() < 1e-3, "{speed}");
        }
        let third = |u: f64, h: f64| {
            let x = [1.5, 0.5, -0.5, -1.5].map(|k| path.at(u + k * h)[0]);
            (x[0] - 3.0 * x[1] + 3.0 * x[2] - x[3]) / h.powi(3)
        };
        let step = |h: f64| (third(0.4 + 2.0 * h, h) - third(0.4 - 2.0 * h, h)).abs();
        assert!(step(5e-3) < 0.6 * step(1e-2), "the jerk has a step at the point: {} {}", step(5e-3), step(1e-2));
    }
}
