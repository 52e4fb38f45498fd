//! The phase (3): a clock that every other part of the movement reads instead of time.

/// Default decay of the phase: `ln 100`, so that `s` falls from 1 to 0.01 over the movement.
pub const DEFAULT_ALPHA: f64 = 4.605_170_185_988_092;

/// What the forcing and force models see of the phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PhaseInput {
    /// `u = -ln(s) / alpha = t / tau`: even over the movement.
    TimeFraction,
    /// `s` itself, as in the paper: most of its range passes at the beginning.
    Phase,
}

impl PhaseInput {
    /// The input at time fraction `u` (-), for the decay `alpha` (-).
    #[must_use]
    pub fn at(self, u: f64, alpha: f64) -> f64 {
        match self {
            Self::TimeFraction => u,
            Self::Phase => (-alpha * u).exp(),
        }
    }

    /// The time fraction at which the input has this value; inverse of [`Self::at`], 1 for a phase that is not positive.
    #[must_use]
    pub fn time_fraction(self, input: f64, alpha: f64) -> f64 {
        match self {
            Self::TimeFraction => input,
            Self::Phase if input > 0.0 => -input.ln() / alpha,
            Self::Phase => 1.0,
        }
    }

    /// `|d input / d u|` (-) at time fraction `u`, for the decay `alpha` (-).
    #[must_use]
    pub fn rate(self, u: f64, alpha: f64) -> f64 {
        match self {
            Self::TimeFraction => 1.0,
            Self::Phase => alpha * (-alpha * u).exp(),
        }
    }
}

/// `tau sdot = -alpha rho s` with `s(0) = 1`, kept as the time fraction `u = -ln(s) / alpha`, whose solution is exact:
/// `u` grows by `rho dt / tau`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CanonicalSystem {
    alpha: f64,
    duration_s: f64,
    u: f64,
}

impl CanonicalSystem {
    /// A clock at its start; `alpha` (-, > 0) and `duration_s` (`tau`, s, > 0).
    #[must_use]
    pub fn new(alpha: f64, duration_s: f64) -> Self {
        Self { alpha, duration_s, u: 0.0 }
    }

    /// The time fraction `u` (-): 0 at the start, 1 when the movement should be over, then on.
    #[must_use]
    pub fn time_fraction(&self) -> f64 {
        self.u
    }

    /// The phase `s = exp(-alpha u)` (-): 1 at the start, falling to 0.
    #[must_use]
    pub fn phase(&self) -> f64 {
        (-self.alpha * self.u).exp()
    }

    /// Goes on from time fraction `u` (-).
    pub fn set_time_fraction(&mut self, u: f64) {
        self.u = u;
    }

    /// Goes on by `dt_s` (s) at the rate `rho` (-): 1 as taught, less to wait for somebody.
    pub fn advance(&mut self, dt_s: f64, rho: f64) {
        self.u += rho * dt_s / self.duration_s;
    }
}
