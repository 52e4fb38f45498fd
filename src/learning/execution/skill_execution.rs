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

use nalgebra::DVector;

use super::coupling::{Coupling, ExpectedWrench, wrench_columns};
use super::{ExecutionSettings, SkillState};
use crate::learning::cpdmp::{ComplianceWindow, ShapingFunction, compliance_windows, segments};
use crate::learning::dmp::{CanonicalSystem, Motion, TransformationSystem};
use crate::learning::{GripperProfile, LearningError, OrientationProfile, Request, Skill};

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

impl SkillExecution {
    /// A skill at its start. The wrench columns are those of the force model; a skill without one takes `fNAME_n` for every motion
    /// column `NAME_m`, in that order, and expects zero.
    ///
    /// # Errors
    /// When parameters are missing or unknown, a start, goal or duration is not usable, or the coupling fits no column.
    pub fn new(skill: &Skill, settings: &ExecutionSettings) -> Result<Self, LearningError> {
        let motion = &skill.motion;
        let Request { theta, start, goal } = skill.request(settings)?;
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
        self.coupling.as_ref().map_or(&[], Coupling::windows)
    }

    /// The active state, how far it yields, and the wrench expected now.
    fn observe(&mut self) {
        let u = self.canonical.time_fraction();
        self.state.state = self.shaping.active_state(u);
        (self.state.beta, self.state.activation) = self.coupling.as_ref().map_or((0.0, 0.0), |c| c.strength(u, self.state.state));
        if let Some(force) = &mut self.force {
            force.at(u, self.shaping.alpha(), self.state.expected_wrench.as_mut_slice());
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
            coupling.law().displacement(strength, wrench, expected, self.state.zeta.as_mut_slice());
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
