//! Forces bend the movement (17)-(19), within bounds that hold for every force.
//!
//! ```text
//! zeta = b(s) beta K C J^T (F - F_des(theta_f, s)),    |zeta| <= Z per axis
//! ```
//!
//! `K1 K2 = K C` of (17) is given as a compliance `C`: the displacement that a steady newton (or newton metre, at a joint) causes.
//! `zeta / K` is then a length or an angle, and the saturation `Z / K` the largest displacement. In task space `J` is the identity; in
//! joint space it is the arm's Jacobian, which the caller gives at every step, at the point and along the axes of the wrench.
//!
//! **Signs.** (18), `beta = +1`, lessens the force error, and (19), `beta = -1`, yields to a hand. As printed they need opposite
//! conventions for `F`: (18) the force the world exerts on the robot, (19) the force the robot exerts on the world. With the convention
//! that makes each do what the paper says of it, both move the hand *along* the error of the force that the world exerts: away from a
//! wall that presses too hard, along with a hand that pushes. So the convention is named, the displacement is
//! `|beta| C (F - F_des)` with `F` turned into the force on the robot, and `beta` says where and why it acts: -1 in the states that
//! leave room, +1 wherever the expected force is the aim.
//!
//! **Stability.** Because the spring is critically damped its response to a bounded `zeta` never exceeds the bound: the deviation `e`
//! from the undisturbed movement obeys `|e| <= Z / K` for any force signal, delayed, resonant or of the wrong sign. Within the bound a
//! wall of stiffness `k` (N/m) is pressed with a steady force error that is smaller by the factor `1 / (1 + C k)`; with a delay of `d`
//! seconds between force and motion the loop rings from about `C k = 1 + 2 / (omega d)` on, and only the saturation holds it.

use nalgebra::{Isometry3, Matrix6xX, Vector6};

use crate::learning::{LearningError, SettingFault};

/// Which force the wrench columns hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ForceConvention {
    /// The force the world (a hand, the gripped load) exerts on the robot.
    OnRobot,
    /// The force the robot exerts on the world.
    OnWorld,
}

/// What the coupling is for.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum CouplingMode {
    /// (19): yields in the states that comply (20), as the skill has learned them.
    #[default]
    Comply,
    /// (18): `beta = +1` in every state, so that the expected force is met all along the movement.
    MinimiseForceError,
    /// `beta` of every state of the motion model: -1, 0 or 1.
    PerState(Vec<f64>),
}

/// In which coordinates the movement runs.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum CouplingSpace {
    /// `J` is the identity: `fx_n` acts on `x_m`, and so on.
    #[default]
    Task,
    /// The motion columns are the arm's joints (`q1_rad`, ...), and forces act through `J^T`.
    Joint {
        /// `C` per joint, or one for all (rad/(N m), 0 to 10).
        compliance_rad_per_nm: Vec<f64>,
        /// `Z / K`, the largest displacement per joint (rad, 0 to 10).
        saturation_rad: f64,
    },
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
    /// Default to comply.
    pub mode: CouplingMode,
    /// Default task space, to which `compliance_m_per_n` and `saturation_m` belong.
    pub space: CouplingSpace,
}

impl Default for CouplingSettings {
    fn default() -> Self {
        Self {
            enabled: false,
            compliance_m_per_n: vec![0.01],
            saturation_m: 0.1,
            convention: ForceConvention::OnRobot,
            switching: Switching::Smooth(1.0),
            mode: CouplingMode::Comply,
            space: CouplingSpace::Task,
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
        if let CouplingSpace::Joint { compliance_rad_per_nm, saturation_rad } = &self.space {
            for c in compliance_rad_per_nm {
                faults.extend(SettingFault::outside("coupling.compliance_rad_per_nm", *c, 0.0, 10.0, "rad/(N m)"));
            }
            faults.extend(SettingFault::outside("coupling.saturation_rad", *saturation_rad, 0.0, 10.0, "rad"));
        }
        if let CouplingMode::PerState(beta) = &self.mode {
            let wrong = beta.iter().filter(|b| ![-1.0, 0.0, 1.0].contains(*b));
            faults.extend(wrong.map(|b| SettingFault { setting: "coupling.beta".into(), value: *b, range: "-1, 0 or 1".into() }));
        }
        faults
    }

    /// `beta` of each state (N) of a model whose states comply as `learned` says.
    ///
    /// # Errors
    /// When another number of values is given than there are states.
    pub fn beta(&self, learned: &[f64]) -> Result<Vec<f64>, LearningError> {
        match &self.mode {
            CouplingMode::Comply => Ok(learned.to_vec()),
            CouplingMode::MinimiseForceError => Ok(vec![1.0; learned.len()]),
            CouplingMode::PerState(beta) if beta.len() == learned.len() => Ok(beta.clone()),
            CouplingMode::PerState(beta) => {
                let (given, states) = (beta.len(), learned.len());
                Err(LearningError::Request(format!("coupling.beta has {given} values for the {states} states of the motion")))
            }
        }
    }
}

/// The coupling for one set of columns.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceCoupling {
    law: Law,
    saturation: f64,
}

#[derive(Debug, Clone, PartialEq)]
enum Law {
    /// Per motion column: the wrench column that acts on it and the compliance, signed for the force on the robot (m/N).
    Task(Vec<Option<(usize, f64)>>),
    /// Per wrench column its row of the Jacobian; per joint the signed compliance (rad/(N m)).
    Joint { rows: Vec<Option<usize>>, compliance: Vec<f64> },
}

/// Rows of a Jacobian, and the wrench columns that act through them.
pub(crate) const JACOBIAN_ROWS: [&str; 6] = ["fx_n", "fy_n", "fz_n", "tx_nm", "ty_nm", "tz_nm"];

impl ForceCoupling {
    /// In task space, pairs wrench columns with motion columns by name: `fNAME_n` acts on `NAME_m` (`fx_n` on `x_m`); other columns do
    /// not act. In joint space every motion column is a joint, and the columns `fx_n fy_n fz_n tx_nm ty_nm tz_nm` act through `J^T`;
    /// one that is not measured counts as expected.
    ///
    /// # Errors
    /// When settings are outside their ranges, the number of compliances is neither one nor that of the motion columns, or no wrench
    /// column acts on any motion column.
    pub fn new(settings: &CouplingSettings, motion: &[String], wrench: &[String]) -> Result<Self, LearningError> {
        let faults = settings.faults();
        if !faults.is_empty() {
            return Err(LearningError::Settings(faults));
        }
        let sign = match settings.convention {
            ForceConvention::OnRobot => 1.0,
            ForceConvention::OnWorld => -1.0,
        };
        let shapes = || format!("motion [{}], wrench [{}]", motion.join(", "), wrench.join(", "));
        if let CouplingSpace::Joint { compliance_rad_per_nm, saturation_rad } = &settings.space {
            let rows: Vec<_> = wrench.iter().map(|w| JACOBIAN_ROWS.iter().position(|row| row == w)).collect();
            if rows.iter().all(Option::is_none) || motion.iter().any(|column| !column.ends_with("_rad")) {
                let wanted = "joint space needs motion columns in rad and wrench columns among fx_n, fy_n, fz_n, tx_nm, ty_nm, tz_nm";
                return Err(LearningError::Request(format!("no force acts on the joints: {}; {wanted}", shapes())));
            }
            let compliance = per_column(compliance_rad_per_nm, motion)?.into_iter().map(|c| sign * c).collect();
            return Ok(Self { law: Law::Joint { rows, compliance }, saturation: *saturation_rad });
        }
        let c = per_column(&settings.compliance_m_per_n, motion)?;
        let pair = |(column, c): (&String, f64)| {
            let name = format!("f{}_n", column.strip_suffix("_m")?);
            Some((wrench.iter().position(|w| *w == name)?, sign * c))
        };
        let axes: Vec<Option<(usize, f64)>> = motion.iter().zip(c).map(pair).collect();
        if axes.iter().all(Option::is_none) {
            return Err(LearningError::Request(format!("no force acts on any axis of the motion: {}; fx_n would act on x_m", shapes())));
        }
        Ok(Self { law: Law::Task(axes), saturation: settings.saturation_m })
    }

    /// The shape (rows, columns) of the Jacobian that a step needs; `None` in task space.
    #[must_use]
    pub fn jacobian_shape(&self) -> Option<(usize, usize)> {
        match &self.law {
            Law::Task(_) => None,
            Law::Joint { compliance, .. } => Some((JACOBIAN_ROWS.len(), compliance.len())),
        }
    }

    /// `zeta / K` per motion column (m; rad in joint space), for `strength = b |beta|` (1 acts fully, 0 not at all), measured and expected
    /// wrench. A force that is not finite does not act, and in joint space nothing does without a Jacobian of the right shape.
    pub fn displacement(
        &self,
        strength: f64,
        (measured, expected): (&[f64], &[f64]),
        jacobian: Option<&Matrix6xX<f64>>,
        displacement: &mut [f64],
    ) {
        displacement.fill(0.0);
        if strength == 0.0 {
            return;
        }
        let bounded = |wanted: f64| if wanted.is_finite() { wanted.clamp(-self.saturation, self.saturation) } else { 0.0 };
        match &self.law {
            Law::Task(axes) => {
                for (z, axis) in displacement.iter_mut().zip(axes) {
                    if let Some((force, compliance)) = axis {
                        *z = bounded(strength * compliance * (measured[*force] - expected[*force]));
                    }
                }
            }
            Law::Joint { rows, compliance } => {
                let Some(jacobian) = jacobian.filter(|j| j.ncols() == compliance.len()) else { return };
                for ((z, c), column) in displacement.iter_mut().zip(compliance).zip(jacobian.column_iter()) {
                    let acting = rows.iter().zip(measured.iter().zip(expected));
                    let torque: f64 = acting.filter_map(|(row, (f, f_des))| Some(column[(*row)?] * (f - f_des))).sum();
                    *z = bounded(strength * c * torque);
                }
            }
        }
    }
}

/// One compliance per motion column.
fn per_column(compliance: &[f64], motion: &[String]) -> Result<Vec<f64>, LearningError> {
    match compliance {
        [c] => Ok(vec![*c; motion.len()]),
        list if list.len() == motion.len() => Ok(list.to_vec()),
        list => {
            let found = format!("{} compliances for the {} motion columns [{}]", list.len(), motion.len(), motion.join(", "));
            Err(LearningError::Request(format!("{found}: give one per column, or one for all")))
        }
    }
}

/// A wrench (force, then torque) measured at the point and along the axes of a sensor, as it is at the tool point along the tool's axes:
/// `F = R f`, `T = R t + p x (R f)` for `tool_from_sensor = (R, p)`. With base axes at the sensor's point, `R` is the identity and `p` the
/// way from the tool point to the sensor (m, base axes).
#[must_use]
pub fn wrench_at_tool(tool_from_sensor: &Isometry3<f64>, wrench: &Vector6<f64>) -> Vector6<f64> {
    let force = tool_from_sensor.rotation * wrench.fixed_rows::<3>(0);
    let torque = tool_from_sensor.rotation * wrench.fixed_rows::<3>(3) + tool_from_sensor.translation.vector.cross(&force);
    Vector6::new(force.x, force.y, force.z, torque.x, torque.y, torque.z)
}
