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
//! waits for somebody keeps its path; `e` stays in real time, so the hand remains as soft as it was. By default both are solved exactly
//! over a step, with `x_eq` taken at its middle; see [`Integrator`](crate::learning::dmp::Integrator).
//!
//! A measured state makes `e` whatever puts the robot where it is, so the next output goes on from there, and `e` fades by the same spring.
//! (The bound on `e` is then that of the spring from the measured state, not `Z / K`.)
//!
//! A goal that moves enters (1) as it stands: the acceleration changes at once by `omega^2 (1 - b s)` of the goal's step, and position and
//! velocity are continuous. Nothing is scaled by `g - x0`, so a movement that ends where it starts, in one column or all, is no exception.

use nalgebra::{DVector, UnitQuaternion, Vector3};

use super::coupling::{Coupling, ExpectedWrench, wrench_columns};
use super::movement::{Movement, Tick};
use super::turning::{Clockwork, Turning};
use super::{ExecutionSettings, Measured, PhaseStopping, SkillState, StepInput};
use crate::learning::cpdmp::{ComplianceWindow, segments};
use crate::learning::dmp::{CanonicalSystem, TransformationSystem};
use crate::learning::{GripperProfile, LearningError, Request, Skill};

/// A skill being executed.
#[derive(Debug, Clone)]
pub struct SkillExecution {
    pub(super) canonical: CanonicalSystem,
    stiffness: f64,
    duration_s: f64,
    pub(super) goal: DVector<f64>,
    pub(super) movement: Movement,
    pub(super) turning: Option<Turning>,
    gripper: Option<GripperProfile>,
    force: Option<ExpectedWrench>,
    wrench_columns: Vec<String>,
    coupling: Option<Coupling>,
    phase_stopping: Option<PhaseStopping>,
    /// `zeta / K` (d; unit of the columns).
    pub(super) displacement: Vec<f64>,
    alpha: f64,
    pub(super) state: SkillState,
}

impl SkillExecution {
    /// A skill at its start. The wrench columns are those of the force model; a skill without one expects zero of `fNAME_n` for every motion
    /// column `NAME_m`, in that order (in joint space of fx_n, fy_n, fz_n, tx_nm, ty_nm, tz_nm).
    ///
    /// # Errors
    /// When parameters are missing or unknown, a start, goal or duration is not usable, or the coupling fits no column.
    pub fn new(skill: &Skill, settings: &ExecutionSettings) -> Result<Self, LearningError> {
        let motion = &skill.motion;
        let Request { theta, start, goal } = skill.request(settings)?;
        let duration_s = settings.duration_s.unwrap_or(motion.duration_s);
        let orientations = check(skill, settings, duration_s)?;
        let mut shaping = motion.shaping_at(&theta)?;
        let force = skill.force.as_ref().map(|force| force.columns.as_slice());
        let wrench = wrench_columns(&motion.columns, force, &settings.coupling.space);
        let coupling = match settings.coupling.enabled {
            true => Some(Coupling::new(&settings.coupling, skill, &wrench, &segments(&mut shaping))?),
            false => None,
        };
        let spring = TransformationSystem::new(motion.stiffness, duration_s);
        let (integrator, gate_start) = (settings.integrator, motion.gate_start);
        let clock = Clockwork { spring, integrator, stiffness: motion.stiffness, alpha: motion.alpha, gate_start, duration_s };
        let mut execution = Self {
            canonical: CanonicalSystem::new(motion.alpha, duration_s),
            stiffness: motion.stiffness,
            duration_s,
            movement: Movement::new(shaping, spring, integrator, &start, &goal),
            turning: skill.orientation.as_ref().map(|o| Turning::new(o.at(&motion.parameters.features.at(&theta)), &clock, orientations)),
            gripper: skill.gripper.clone(),
            force: ExpectedWrench::of(skill, settings)?,
            coupling,
            phase_stopping: settings.phase_stopping,
            displacement: vec![0.0; start.len()],
            alpha: motion.alpha,
            state: SkillState::at(start, wrench.len()),
            wrench_columns: wrench,
            goal,
        };
        execution.observe();
        execution.place(1.0);
        Ok(execution)
    }

    /// Goes on by one step. What is not usable in the input does not act, and the state says so; [`Self::check_input`] says why.
    pub fn step(&mut self, input: &StepInput) -> &SkillState {
        let usable = |x: f64| if x.is_finite() { x.max(0.0) } else { 0.0 };
        let (dt, mut rho) = (usable(input.dt_s), usable(input.phase_rate));
        let measured = input.measured.filter(|m| self.fits(m));
        self.state.measured_used = measured.is_some();
        if let Some(measured) = &measured {
            self.movement.measure_position(measured.position);
        }
        if let Some(stopping) = &self.phase_stopping {
            rho *= stopping.share(self.movement.squared_deviation());
        }
        if let Some(measured) = &measured {
            self.movement.measure_velocity(measured.velocity, rho);
            if let (Some(turning), Some(orientation)) = (&mut self.turning, measured.orientation) {
                turning.measure(orientation, rho, self.duration_s);
            }
        }
        self.observe();
        self.feel(input);
        let u = self.canonical.time_fraction();
        self.canonical.advance(dt, rho);
        let tick = Tick { dt, rho, u: [u + 0.5 * rho * dt / self.duration_s, self.canonical.time_fraction()] };
        self.movement.step(&tick, &self.displacement);
        if let Some(turning) = &mut self.turning {
            turning.step(&tick);
        }
        self.state.time_s += dt;
        self.place(rho);
        &self.state
    }

    /// Whether a step can use everything in `input`: for once, before a loop begins.
    ///
    /// # Errors
    /// When a wrench, a measured state or a Jacobian has another shape than the skill needs; names both.
    pub fn check_input(&self, input: &StepInput) -> Result<(), LearningError> {
        let (d, w) = (self.goal.len(), self.state.expected_wrench.len());
        let mut faults = Vec::new();
        if !input.wrench.is_empty() && input.wrench.len() != w {
            faults.push(format!("the wrench has {} values, but the skill takes {w}", input.wrench.len()));
        }
        if let Some(m) = input.measured.filter(|m| (m.position.len(), m.velocity.len()) != (d, d)) {
            let found = format!("{} positions and {} velocities", m.position.len(), m.velocity.len());
            faults.push(format!("the measured state has {found}, but the motion has {d} columns"));
        }
        if let Some((rows, columns)) = self.coupling.as_ref().and_then(|c| c.law().jacobian_shape()) {
            match input.jacobian.map(nalgebra::Matrix6xX::shape) {
                Some(shape) if shape == (rows, columns) => {}
                Some((r, c)) => faults.push(format!("the Jacobian is {r} x {c}, but the coupling takes {rows} x {columns}")),
                None => faults.push(format!("the coupling in joint space takes a Jacobian of {rows} x {columns}, but there is none")),
            }
        }
        if faults.is_empty() { Ok(()) } else { Err(LearningError::Request(faults.join("; "))) }
    }

    /// From now on the movement ends at `goal` (d; unit of the columns), which moves at `velocity` (d; unit / s) until it is set again;
    /// zeros for a goal that stands. A goal that moves is followed without a lag once the phase has faded, and reached when it stops.
    /// Returns whether the goal was taken: what has the wrong length or is not finite changes nothing.
    pub fn set_goal(&mut self, goal: &[f64], velocity: &[f64]) -> bool {
        let d = self.goal.len();
        let usable = goal.len() == d && velocity.len() == d && goal.iter().chain(velocity).all(|x| x.is_finite());
        if usable {
            self.goal.as_mut_slice().copy_from_slice(goal);
            self.movement.set_goal(goal, velocity);
        }
        usable
    }

    /// From now on the movement ends with the orientation `goal`, which turns at `angular_velocity` (rad/s, base axes) until it is set
    /// again. The way to it is the one nearest to the way to the goal before, so a goal that keeps turning is followed past any number of
    /// turns. Returns whether the goal was taken: not when the skill has no orientation or a number is not finite.
    pub fn set_goal_orientation(&mut self, goal: UnitQuaternion<f64>, angular_velocity: Vector3<f64>) -> bool {
        let usable = finite_orientation(&goal) && angular_velocity.iter().all(|x| x.is_finite());
        let Some(turning) = self.turning.as_mut().filter(|_| usable) else { return false };
        turning.set_goal(goal, angular_velocity);
        true
    }

    /// Where the skill is.
    #[must_use]
    pub fn state(&self) -> &SkillState {
        &self.state
    }

    /// The columns of the wrench that a step takes (w), in their order.
    #[must_use]
    pub fn wrench_columns(&self) -> &[String] {
        &self.wrench_columns
    }

    /// Where the movement ends (d), now.
    #[must_use]
    pub fn goal(&self) -> &DVector<f64> {
        &self.goal
    }

    /// The orientation with which it ends, now, when the skill has one.
    #[must_use]
    pub fn goal_orientation(&self) -> Option<UnitQuaternion<f64>> {
        self.turning.as_ref().map(Turning::goal)
    }

    /// `tau` (s).
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.duration_s
    }

    /// `omega = sqrt(K) / tau` (rad/s): how fast a deviation fades.
    #[must_use]
    pub fn omega(&self) -> f64 {
        self.movement.spring.omega()
    }

    /// The windows in which forces act, as time fractions; none when the coupling is off.
    #[must_use]
    pub fn compliance_windows(&self) -> &[ComplianceWindow] {
        self.coupling.as_ref().map_or(&[], Coupling::windows)
    }

    fn fits(&self, m: &Measured) -> bool {
        let d = self.goal.len();
        let numbers = m.position.iter().chain(m.velocity);
        let turned = m.orientation.is_none_or(|(q, omega)| finite_orientation(&q) && omega.iter().all(|x| x.is_finite()));
        m.position.len() == d && m.velocity.len() == d && turned && numbers.into_iter().all(|x| x.is_finite())
    }

    /// The active state, how far it yields, and the wrench expected now.
    fn observe(&mut self) {
        let u = self.canonical.time_fraction();
        self.state.state = self.movement.state();
        (self.state.beta, self.state.activation) = self.coupling.as_ref().map_or((0.0, 0.0), |c| c.strength(u, self.state.state));
        if let Some(force) = &mut self.force {
            force.at(u, self.alpha, self.state.expected_wrench.as_mut_slice());
        }
    }

    /// `zeta` (17) from the measured wrench.
    fn feel(&mut self, input: &StepInput) {
        let expected = self.state.expected_wrench.as_slice();
        let complete = input.wrench.len() == expected.len();
        self.state.wrench_valid = complete && input.wrench.iter().all(|f| f.is_finite());
        self.displacement.fill(0.0);
        if let Some(coupling) = self.coupling.as_ref().filter(|_| complete) {
            let strength = self.state.beta.abs() * self.state.activation;
            coupling.law().displacement(strength, (input.wrench, expected), input.jacobian, &mut self.displacement);
        }
    }

    /// Writes the motion at the present phase into the state.
    fn place(&mut self, rho: f64) {
        let (u, state) = (self.canonical.time_fraction(), &mut self.state);
        (state.u, state.phase) = (u, self.canonical.phase());
        for (j, displacement) in self.displacement.iter().enumerate() {
            let [x, velocity, acceleration, e, net] = self.movement.place(j, rho, *displacement);
            (state.position[j], state.velocity[j], state.acceleration[j]) = (x, velocity, acceleration);
            (state.deviation[j], state.forcing[j], state.zeta[j]) = (e, net, displacement * self.stiffness);
            self.goal[j] = self.movement.goal(j);
        }
        (state.orientation, state.angular_velocity) = self.turning.as_ref().map(|t| t.place(rho, self.duration_s)).unzip();
        state.gripper = self.gripper.as_ref().map(|g| g.opening(u));
    }
}

/// The start and goal orientation asked for, once everything that does not depend on columns is usable.
fn check(skill: &Skill, settings: &ExecutionSettings, duration_s: f64) -> Result<[Option<UnitQuaternion<f64>>; 2], LearningError> {
    if !(duration_s > 0.0 && duration_s.is_finite()) {
        return Err(LearningError::Request(format!("the duration is {duration_s} s, but must be positive")));
    }
    let faults = settings.phase_stopping.iter().flat_map(PhaseStopping::faults).collect::<Vec<_>>();
    if !faults.is_empty() {
        return Err(LearningError::Settings(faults));
    }
    let orientations = [settings.start_orientation, settings.goal_orientation];
    for (what, q) in ["start", "goal"].iter().zip(&orientations).filter_map(|(what, q)| Some((what, (*q)?))) {
        if skill.orientation.is_none() {
            return Err(LearningError::Request(format!("a {what} orientation is given, but the skill has no orientation")));
        }
        if !finite_orientation(&q) {
            let found: [f64; 4] = q.coords.into();
            return Err(LearningError::Request(format!("the {what} orientation is {found:?}, but must be a unit quaternion x, y, z, w")));
        }
    }
    Ok(orientations)
}

fn finite_orientation(q: &UnitQuaternion<f64>) -> bool {
    (q.coords.norm() - 1.0).abs() < 1e-6
}
