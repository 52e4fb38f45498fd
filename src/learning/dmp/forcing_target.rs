//! What the forcing term must have been for a demonstration to come out of the primitive (4).

/// `f_target = -(g - x) + (g - x0) s + (tau vdot + D v) / K` of one sample of one degree of freedom, with `v = tau xdot`,
/// `vdot = tau xddot` and `D = 2 sqrt(K)`: hence `(tau^2 xddot + 2 sqrt(K) tau xdot) / K = xddot / omega^2 + 2 xdot / omega`.
///
/// `motion` is `[x, xdot, xddot]` (unit, unit/s, unit/s^2); `start` is `x0`, `goal` is `g`; `phase` is `s`; `omega` is
/// `sqrt(K) / tau` (rad/s) with the duration of **this** demonstration. The result has the unit of `x`.
#[must_use]
pub fn forcing_target(motion: [f64; 3], start: f64, goal: f64, phase: f64, omega: f64) -> f64 {
    let [x, velocity, acceleration] = motion;
    -(goal - x) + (goal - start) * phase + acceleration / (omega * omega) + 2.0 * velocity / omega
}
