//! Forces bend the movement (17)-(19), within bounds that hold for every force.
//!
//! ```text
//! zeta = b(s) beta K C (F - F_des(theta_f, s)),    |zeta| <= Z per axis
//! ```
//!
//! `K1 K2 = K C` of (17) is given as a compliance `C` (m/N): the displacement a steady newton causes. `zeta / K` is then a length, and
//! the saturation `Z / K` the largest displacement. In task space `J` is the identity. The signs of (18) and (19) need opposite
//! conventions for `F`, so the convention is named: with `beta = -1` the movement always yields to the hand that pushes it.
//!
//! Because the spring is critically damped its response to a bounded `zeta` never exceeds the bound: the deviation `e` from the
//! undisturbed movement obeys `|e| <= Z / K` for any force signal, delayed, resonant or of the wrong sign.

use crate::learning::{LearningError, SettingFault};

/// Which force the wrench columns hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ForceConvention {
    /// The force the world (a hand, the gripped load) exerts on the robot.
    OnRobot,
    /// The force the robot exerts on the world.
    OnWorld,
}

/// How the coupling goes on and off at the edges of a compliance window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Switching {
    /// At once, as in the paper.
    Hard,
    /// By a minimum-jerk ramp inside the window, this many times `1 / omega` long (-, 0.01 to 100).
    Smooth(f64),
}

/// How forces act on the movement.
#[derive(Debug, Clone, PartialEq)]
pub struct CouplingSettings {
    /// Whether they act at all. Default no.
    pub enabled: bool,
    /// `C` per motion column, or one for all (m/N, 0 to 10). Default 0.01: 6 N move the hand 6 cm.
    pub compliance_m_per_n: Vec<f64>,
    /// `Z / K`, the largest displacement per axis (m, 0 to 10). Default 0.1.
    pub saturation_m: f64,
    /// Default the force on the robot.
    pub convention: ForceConvention,
    /// Default smooth over `1 / omega`.
    pub switching: Switching,
}

impl Default for CouplingSettings {
    fn default() -> Self {
        Self {
            enabled: false,
            compliance_m_per_n: vec![0.01],
            saturation_m: 0.1,
            convention: ForceConvention::OnRobot,
            switching: Switching::Smooth(1.0),
        }
    }
}

impl CouplingSettings {
    /// Everything outside its range.
    #[must_use]
    pub fn faults(&self) -> Vec<SettingFault> {
        let mut faults: Vec<SettingFault> = Vec::new();
        for c in &self.compliance_m_per_n {
            faults.extend(SettingFault::outside("coupling.compliance_m_per_n", *c, 0.0, 10.0, "m/N"));
        }
        faults.extend(SettingFault::outside("coupling.saturation_m", self.saturation_m, 0.0, 10.0, "m"));
        if let Switching::Smooth(ramp) = self.switching {
            faults.extend(SettingFault::outside("coupling.switching (ramp)", ramp, 0.01, 100.0, "times 1/omega"));
        }
        faults
    }
}

/// The coupling for one set of columns.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceCoupling {
    /// Per motion column: the wrench column that acts on it and the signed compliance (m/N).
    axes: Vec<Option<(usize, f64)>>,
    saturation_m: f64,
}

impl ForceCoupling {
    /// Pairs wrench columns with motion columns by name: `fNAME_n` acts on `NAME_m` (`fx_n` on `x_m`); other columns do not act.
    ///
    /// # Errors
    /// When settings are outside their ranges, the number of compliances is neither one nor that of the motion columns, or no wrench
    /// column acts on any motion column.
    pub fn new(settings: &CouplingSettings, motion: &[String], wrench: &[String]) -> Result<Self, LearningError> {
        let faults = settings.faults();
        if !faults.is_empty() {
            return Err(LearningError::Settings(faults));
        }
        let c = &settings.compliance_m_per_n;
        if c.len() != 1 && c.len() != motion.len() {
            let found = format!("{} compliances for the {} motion columns [{}]", c.len(), motion.len(), motion.join(", "));
            return Err(LearningError::Request(format!("{found}: give one per column, or one for all")));
        }
        let sign = match settings.convention {
            ForceConvention::OnRobot => -1.0,
            ForceConvention::OnWorld => 1.0,
        };
        let pair = |(j, column): (usize, &String)| {
            let name = format!("f{}_n", column.strip_suffix("_m")?);
            let force = wrench.iter().position(|w| *w == name)?;
            Some((force, sign * c[if c.len() == 1 { 0 } else { j }]))
        };
        let axes: Vec<Option<(usize, f64)>> = motion.iter().enumerate().map(pair).collect();
        if axes.iter().all(Option::is_none) {
            let shapes = format!("motion [{}], wrench [{}]", motion.join(", "), wrench.join(", "));
            return Err(LearningError::Request(format!("no force acts on any axis of the motion: {shapes}; fx_n would act on x_m")));
        }
        Ok(Self { axes, saturation_m: settings.saturation_m })
    }

    /// `zeta / K` per motion column (m), for `strength = b beta` (-1 yields fully, 0 not at all), measured and expected wrench. A force
    /// that is not finite does not act.
    pub fn displacement(&self, strength: f64, measured: &[f64], expected: &[f64], displacement: &mut [f64]) {
        for (z, axis) in displacement.iter_mut().zip(&self.axes) {
            *z = 0.0;
            if let Some((force, compliance)) = axis
                && strength != 0.0
            {
                let wanted = strength * compliance * (measured[*force] - expected[*force]);
                *z = if wanted.is_finite() { wanted.clamp(-self.saturation_m, self.saturation_m) } else { 0.0 };
            }
        }
    }
}
