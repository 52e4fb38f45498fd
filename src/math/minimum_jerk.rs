//! The minimum-jerk profile: how a person moves a hand from one point to another.

/// Position, velocity and acceleration of the profile at one moment, for a movement from 0 to 1 in unit time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MinimumJerk {
    /// Position (-), 0 at the start and 1 at the end.
    pub position: f64,
    /// Velocity (1 / unit time); divide by the duration for 1/s.
    pub velocity: f64,
    /// Acceleration (1 / unit time^2); divide by the squared duration for 1/s^2.
    pub acceleration: f64,
}

/// `10 r^3 - 15 r^4 + 6 r^5` with its derivatives, `r` clamped to [0, 1]; at rest outside.
#[must_use]
pub fn minimum_jerk(fraction: f64) -> MinimumJerk {
    let r = fraction.clamp(0.0, 1.0);
    let (r2, r3) = (r * r, r * r * r);
    MinimumJerk {
        position: r3 * (10.0 - 15.0 * r + 6.0 * r2),
        velocity: 30.0 * r2 * (1.0 - r) * (1.0 - r),
        acceleration: 60.0 * r * (1.0 - r) * (1.0 - 2.0 * r),
    }
}

/// The minimum-jerk ramp from 0 at `from` to 1 at `to` (`from != to`; falling when `to < from`).
#[must_use]
pub fn smooth_step(x: f64, from: f64, to: f64) -> f64 {
    minimum_jerk((x - from) / (to - from)).position
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_those_of_the_position() {
        let h = 1e-5;
        for i in 1..20 {
            let r = f64::from(i) / 20.0;
            let (a, b, c) = (minimum_jerk(r - h), minimum_jerk(r), minimum_jerk(r + h));
            assert!(((c.position - a.position) / (2.0 * h) - b.velocity).abs() < 1e-8);
            assert!(((c.velocity - a.velocity) / (2.0 * h) - b.acceleration).abs() < 1e-7);
        }
        assert_eq!((minimum_jerk(-1.0).position, minimum_jerk(2.0).position), (0.0, 1.0));
        assert_eq!((smooth_step(0.94, 1.0, 0.94), smooth_step(1.0, 1.0, 0.94)), (1.0, 0.0));
    }
}
