//! A skill in motion: one step at a time, for a control loop. Nothing is allocated after construction.
//!
//! The movement (16) is linear in what drives it, so it is integrated as the sum of two critically damped springs: the *undisturbed*
//! movement `p`, which follows the forcing term, and the *deviation* `e`, which follows `zeta`:
//!
//! ```text
//! x = p + e        tau^2 p'' = K (x_eq(s) - p) - D tau p'        tau^2 e'' = -K e - D tau e' + zeta
//! ```
//!
//! Where no force acts `e` is exactly zero, bit for bit. The phase rate `rho` scales the time of `s` and `p` together, so a movement that
//! waits for somebody keeps its path; `e` stays in real time, so the hand remains as soft as it was. Both are solved exactly over a
//! step, with `x_eq` taken at its middle.

use nalgebra::{DVector, UnitQuaternion};

use super::cpdmp::{ComplianceWindow, CouplingSettings, ForceCoupling, ShapingFunction, Switching, compliance_windows, segments};
use super::dmp::{CanonicalSystem, Motion, PhaseInput, TransformationSystem};
use super::{ExecutionSettings, Gmr, GripperProfile, LearningError, OrientationProfile, Skill};
use crate::math::smooth_step;

/// Where a skill is. Motion, phase, orientation and gripper at the end of the step; what decided about forces as it was during it.
#[derive(Debug, Clone, PartialEq)]
pub struct SkillState {
    /// Time since the start (s).
    pub time_s: f64,
    /// Phase `s` (-), from 1 towards 0.
    pub phase: f64,
    /// Time fraction `u = -ln(s) / alpha` (-), 1 when the movement should be over.
    pub u: f64,
    /// Position (d; unit of the motion columns).
    pub position: DVector<f64>,
    /// Velocity (d; unit / s).
    pub velocity: DVector<f64>,
    /// Acceleration (d; unit / s^2).
    pub acceleration: DVector<f64>,
    /// How far forces have moved the position from the undisturbed movement (d; unit of the columns).
    pub deviation: DVector<f64>,
    /// Orientation, when the skill has one.
    pub orientation: Option<UnitQuaternion<f64>>,
    /// Opening of the gripper (0 closed, 1 open), when the skill has one.
    pub gripper: Option<f64>,
    /// The most responsible state of the motion model; 0 for the baseline.
    pub state: usize,
    /// `beta` of that state: -1 complies, 0 is stiff.
    pub beta: f64,
    /// `b` (-, 0 to 1): how far the coupling is switched on.
    pub activation: f64,
    /// `zeta` (d; unit of the columns times `K`): `zeta / K` is the displacement that the forces ask for, after saturation.
    pub zeta: DVector<f64>,
    /// `F_des(theta_f, s)` (w; unit of the wrench columns); zero without a force model.
    pub expected_wrench: DVector<f64>,
    /// The net forcing `b (f - (g - x0) s)` (d; unit of the columns): where the spring is pulled to, seen from the goal.
    pub forcing: DVector<f64>,
    /// Whether the last wrench had the right length and was finite. What is not finite does not act.
    pub wrench_valid: bool,
}

/// A skill being executed.
#[derive(Debug, Clone)]
pub struct SkillExecution {
    canonical: CanonicalSystem,
    spring: TransformationSystem,
    stiffness: f64,
    duration_s: f64,
    start: DVector<f64>,
    goal: DVector<f64>,
    shaping: ShapingFunction,
    orientation: Option<OrientationProfile>,
    gripper: Option<GripperProfile>,
    force: Option<ExpectedWrench>,
    coupling: Option<Coupling>,
    undisturbed: Vec<Motion>,
    deviation: Vec<Motion>,
    state: SkillState,
}

#[derive(Debug, Clone)]
struct ExpectedWrench {
    gmr: Gmr,
    input: PhaseInput,
    weights: Vec<f64>,
}

#[derive(Debug, Clone)]
struct Coupling {
    law: ForceCoupling,
    beta: Vec<f64>,
    windows: Vec<ComplianceWindow>,
    /// Length of the ramps at the windows' edges, as a fraction of the duration; 0 for none.
    ramp: f64,
    fade_start: f64,
}

impl SkillExecution {
    /// A skill at its start. The wrench columns are those of the force model; a skill without one takes `fNAME_n` for every motion
    /// column `NAME_m`, in that order, and expects zero.
    ///
    /// # Errors
    /// When parameters are missing or unknown, a start, goal or duration is not usable, or the coupling fits no column.
    pub fn new(skill: &Skill, settings: &ExecutionSettings) -> Result<Self, LearningError> {
        let motion = &skill.motion;
        let theta = motion.parameters.resolve(&settings.theta_m)?;
        let (start, goal) = skill.ends_at(&theta);
        let start = chosen("start", &settings.start, start)?;
        let goal = chosen("goal", &settings.goal, goal)?;
        let duration_s = settings.duration_s.unwrap_or(motion.duration_s);
        if !(duration_s > 0.0 && duration_s.is_finite()) {
            return Err(LearningError::Request(format!("the duration is {duration_s} s, but must be positive")));
        }
        let mut shaping = motion.shaping_at(&theta)?;
        let windows = compliance_windows(&segments(&mut shaping), &skill.compliance.beta);
        let wrench = wrench_columns(skill);
        let force = ExpectedWrench::of(skill, settings)?;
        let coupling = match settings.coupling.enabled {
            true => Some(Coupling::new(&settings.coupling, skill, &wrench, windows)?),
            false => None,
        };
        let at_start = |x: &f64| Motion { position: *x, velocity: 0.0 };
        let (d, w) = (start.len(), wrench.len());
        let mut execution = Self {
            canonical: CanonicalSystem::new(motion.alpha, duration_s),
            spring: TransformationSystem::new(motion.stiffness, duration_s),
            stiffness: motion.stiffness,
            duration_s,
            undisturbed: start.iter().map(at_start).collect(),
            deviation: vec![Motion::default(); d],
            orientation: skill.orientation.as_ref().map(|o| o.at(&theta)),
            gripper: skill.gripper.clone(),
            state: SkillState::at(start.clone(), w),
            start,
            goal,
            shaping,
            force,
            coupling,
        };
        execution.observe();
        execution.place(1.0);
        Ok(execution)
    }

    /// Goes on by `dt_s` (s) with the wrench measured now (w) and the phase rate `rho` (-; 1 as taught, 0 waits). A step or rate that is
    /// negative or not finite counts as 0.
    pub fn step(&mut self, dt_s: f64, wrench: &[f64], phase_rate: f64) -> &SkillState {
        let usable = |x: f64| if x.is_finite() { x.max(0.0) } else { 0.0 };
        let (dt, rho) = (usable(dt_s), usable(phase_rate));
        self.observe();
        self.feel(wrench);
        let u = self.canonical.time_fraction();
        let middle = u + 0.5 * rho * dt / self.duration_s;
        self.shaping.net_forcing(middle, &self.start, &self.goal, self.state.forcing.as_mut_slice());
        for j in 0..self.undisturbed.len() {
            let x_eq = self.goal[j] + self.state.forcing[j];
            self.undisturbed[j] = self.spring.hold(self.undisturbed[j], x_eq, rho * dt);
            self.deviation[j] = self.spring.hold(self.deviation[j], self.state.zeta[j] / self.stiffness, dt);
        }
        self.canonical.advance(dt, rho);
        self.state.time_s += dt;
        self.place(rho);
        &self.state
    }

    /// Where the skill is.
    #[must_use]
    pub fn state(&self) -> &SkillState {
        &self.state
    }

    /// Where the movement ends (d).
    #[must_use]
    pub fn goal(&self) -> &DVector<f64> {
        &self.goal
    }

    /// `tau` (s).
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.duration_s
    }

    /// `omega = sqrt(K) / tau` (rad/s): how fast a deviation fades.
    #[must_use]
    pub fn omega(&self) -> f64 {
        self.spring.omega()
    }

    /// The windows in which forces act, as time fractions; none when the coupling is off.
    #[must_use]
    pub fn compliance_windows(&self) -> &[ComplianceWindow] {
        self.coupling.as_ref().map_or(&[], |c| &c.windows)
    }

    /// The active state, how far it yields, and the wrench expected now.
    fn observe(&mut self) {
        let u = self.canonical.time_fraction();
        self.state.state = self.shaping.active_state(u);
        (self.state.beta, self.state.activation) = self.coupling.as_ref().map_or((0.0, 0.0), |c| c.strength(u, self.state.state));
        if let Some(force) = &mut self.force {
            let x = [force.input.at(u.clamp(0.0, 1.0), self.shaping.alpha())];
            force.gmr.weights(&x, &mut force.weights);
            force.gmr.mean_into(&x, &force.weights, self.state.expected_wrench.as_mut_slice());
        }
    }

    /// `zeta` (17) from the measured wrench.
    fn feel(&mut self, wrench: &[f64]) {
        let expected = self.state.expected_wrench.as_slice();
        let complete = wrench.len() == expected.len();
        self.state.wrench_valid = complete && wrench.iter().all(|f| f.is_finite());
        self.state.zeta.fill(0.0);
        if let Some(coupling) = self.coupling.as_ref().filter(|_| complete) {
            let strength = self.state.beta * self.state.activation;
            coupling.law.displacement(strength, wrench, expected, self.state.zeta.as_mut_slice());
            self.state.zeta *= self.stiffness;
        }
    }

    /// Writes the motion at the present phase into the state.
    fn place(&mut self, rho: f64) {
        let (u, state) = (self.canonical.time_fraction(), &mut self.state);
        (state.u, state.phase) = (u, self.canonical.phase());
        self.shaping.net_forcing(u, &self.start, &self.goal, state.forcing.as_mut_slice());
        for j in 0..self.undisturbed.len() {
            let (p, e) = (self.undisturbed[j], self.deviation[j]);
            let p_acceleration = self.spring.acceleration(p, self.goal[j] + state.forcing[j]);
            let e_acceleration = self.spring.acceleration(e, state.zeta[j] / self.stiffness);
            state.position[j] = p.position + e.position;
            state.velocity[j] = rho * p.velocity + e.velocity;
            state.acceleration[j] = rho * rho * p_acceleration + e_acceleration;
            state.deviation[j] = e.position;
        }
        state.orientation = self.orientation.as_ref().map(|o| o.orientation(u));
        state.gripper = self.gripper.as_ref().map(|g| g.opening(u));
    }
}

impl SkillState {
    fn at(position: DVector<f64>, wrench: usize) -> Self {
        let zero = DVector::zeros(position.len());
        Self {
            time_s: 0.0,
            phase: 1.0,
            u: 0.0,
            position,
            velocity: zero.clone(),
            acceleration: zero.clone(),
            deviation: zero.clone(),
            orientation: None,
            gripper: None,
            state: 0,
            beta: 0.0,
            activation: 0.0,
            zeta: zero.clone(),
            expected_wrench: DVector::zeros(wrench),
            forcing: zero,
            wrench_valid: true,
        }
    }
}

impl ExpectedWrench {
    fn of(skill: &Skill, settings: &ExecutionSettings) -> Result<Option<Self>, LearningError> {
        let Some(model) = &skill.force else {
            return match settings.theta_f.first() {
                Some((name, _)) => Err(LearningError::Request(format!("unknown parameter {name}: the skill has no force model"))),
                None => Ok(None),
            };
        };
        let gmr = model.regression_at(&model.parameters.resolve(&settings.theta_f)?)?;
        let weights = vec![0.0; gmr.components()];
        Ok(Some(Self { gmr, input: model.phase_input, weights }))
    }
}

impl Coupling {
    fn new(settings: &CouplingSettings, skill: &Skill, wrench: &[String], windows: Vec<ComplianceWindow>) -> Result<Self, LearningError> {
        let ramp = match settings.switching {
            Switching::Hard => 0.0,
            // 1 / (omega tau) = 1 / sqrt(K).
            Switching::Smooth(times) => times / skill.motion.stiffness.sqrt(),
        };
        Ok(Self {
            law: ForceCoupling::new(settings, &skill.motion.columns, wrench)?,
            beta: skill.compliance.beta.clone(),
            windows,
            ramp,
            fade_start: skill.motion.gate_start,
        })
    }

    /// `beta` of the active state and the activation `b` at time fraction `u`. `b` ramps inside the window, so that outside it nothing
    /// acts, and fades to 0 towards `u = 1`, so that the goal is reached.
    fn strength(&self, u: f64, state: usize) -> (f64, f64) {
        let beta = self.beta.get(state).copied().unwrap_or(0.0);
        let Some(window) = self.windows.iter().find(|w| (w.start..w.end).contains(&u)) else { return (beta, 0.0) };
        let ramp = self.ramp.min(0.5 * (window.end - window.start));
        let inside = if ramp > 0.0 {
            smooth_step(u, window.start, window.start + ramp) * smooth_step(u, window.end, window.end - ramp)
        } else {
            1.0
        };
        (beta, inside * smooth_step(u, 1.0, self.fade_start))
    }
}

/// The columns of the wrench that a skill takes.
fn wrench_columns(skill: &Skill) -> Vec<String> {
    match &skill.force {
        Some(force) => force.columns.clone(),
        None => skill.motion.columns.iter().map(|c| c.strip_suffix("_m").map_or_else(|| c.clone(), |name| format!("f{name}_n"))).collect(),
    }
}

fn chosen(what: &str, given: &Option<Vec<f64>>, learned: DVector<f64>) -> Result<DVector<f64>, LearningError> {
    match given {
        None => Ok(learned),
        Some(values) if values.len() == learned.len() && values.iter().all(|x| x.is_finite()) => Ok(DVector::from_column_slice(values)),
        Some(values) => {
            let expected = learned.len();
            Err(LearningError::Request(format!("the {what} is {values:?}, but must be {expected} finite numbers, one per motion column")))
        }
    }
}
