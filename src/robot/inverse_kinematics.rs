//! Inverse kinematics: damped least squares with joint limits and a pull towards a rest posture in the null space.
//!
//! One step solves, for the tip error or twist e and the pull g towards the rest posture,
//!
//! ```text
//! dq = g + Jᵀ (J Jᵀ + lambda² I)⁻¹ (e - J g)
//! ```
//!
//! (Wampler 1986; Nakamura and Hanafusa 1986): the least-squares step for e plus that part of g that does not move the tip. A joint that
//! would leave its range is held where it is, its column of J set to zero, and the step is solved again.
//! The damping lambda² = floor + |e|²/2 fades with the error (Sugihara 2011), so far targets are safe and near ones converge fast.

use nalgebra::{Cholesky, Isometry3, Matrix6, Vector3, Vector6};

use super::chain::{ChainState, SerialChain};

/// How [`InverseKinematics::solve`] iterates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IkSettings {
    /// Largest accepted distance to the target (m). Default 1e-6, far below what a controller can hold.
    pub position_tolerance: f64,
    /// Largest accepted angle to the target (rad). Default 1e-6.
    pub orientation_tolerance: f64,
    /// Most iterations. Default 100; reachable targets take about 5 from a near seed and 10 to 40 from a far one.
    pub max_iterations: usize,
    /// Largest motion of one joint in one iteration (rad or m). Default 0.3, within which the Jacobian is a fair map.
    pub max_step: f64,
    /// Smallest lambda² (squared metres and radians mixed). Default 1e-9: no visible bias, yet solvable when singular.
    pub damping: f64,
    /// Share of the way to the rest posture taken per iteration, as far as the tip allows (0 to 1). Default 0.1.
    pub rest_gain: f64,
}

impl Default for IkSettings {
    fn default() -> Self {
        Self { position_tolerance: 1e-6, orientation_tolerance: 1e-6, max_iterations: 100, max_step: 0.3, damping: 1e-9, rest_gain: 0.1 }
    }
}

/// How a solve ended: a status, never a failure in itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IkOutcome {
    /// Distance of the tip from the target (m).
    pub position_error_m: f64,
    /// Angle of the tip from the target (rad).
    pub orientation_error_rad: f64,
    /// Steps taken.
    pub iterations: usize,
    /// Whether both errors are within tolerance.
    pub converged: bool,
    /// When not converged: the joint held at a limit that wanted to move furthest beyond it, if any (index in the chain).
    pub limiting_joint: Option<usize>,
}

/// A solver with its buffers, for one chain. Solving does not allocate.
#[derive(Debug, Clone)]
pub struct InverseKinematics {
    /// How to iterate.
    pub settings: IkSettings,
    pub(super) step: Vec<f64>,
    pub(super) pull: Vec<f64>,
    held: Vec<bool>,
    best: Vec<f64>,
}

impl InverseKinematics {
    /// A solver for `chain`.
    pub fn new(chain: &SerialChain, settings: IkSettings) -> Self {
        let n = chain.joint_count();
        Self { settings, step: vec![0.0; n], pull: vec![0.0; n], held: vec![false; n], best: vec![0.0; n] }
    }

    /// Brings the tip to `target` (in the base frame), starting from the seed in `q` (rad or m, n) and leaving the result there, within
    /// joint limits, drawn towards the posture `rest` (n). When the target cannot be reached, `q` is the best posture met.
    ///
    /// # Panics
    /// If a slice has not n entries or `state` belongs to a chain of another length.
    pub fn solve(
        &mut self,
        chain: &SerialChain,
        target: &Isometry3<f64>,
        rest: &[f64],
        q: &mut [f64],
        state: &mut ChainState,
    ) -> IkOutcome {
        assert_eq!(rest.len(), chain.joint_count(), "one rest position per joint");
        clamp_to_limits(chain, q);
        let mut error = tip_error(chain, target, q, state);
        let mut best = (error, self.best_of(&error, 0, q));
        let mut limiting_joint = None;
        for iterations in 1..=self.settings.max_iterations {
            if best.1.converged {
                return best.1;
            }
            limiting_joint = self.advance(chain, &error, rest, q, state);
            error = tip_error(chain, target, q, state);
            if error.norm_squared() < best.0.norm_squared() {
                best = (error, self.best_of(&error, iterations, q));
            }
        }
        if best.1.converged {
            return best.1;
        }
        q.copy_from_slice(&self.best);
        chain.forward_kinematics(q, state);
        IkOutcome { iterations: self.settings.max_iterations, limiting_joint, ..best.1 }
    }

    /// Keeps `q` as the best posture so far and says how good it is.
    fn best_of(&mut self, error: &Vector6<f64>, iterations: usize, q: &[f64]) -> IkOutcome {
        self.best.copy_from_slice(q);
        let position_error_m = error.fixed_rows::<3>(0).norm();
        let orientation_error_rad = error.fixed_rows::<3>(3).norm();
        IkOutcome {
            position_error_m,
            orientation_error_rad,
            iterations,
            converged: position_error_m <= self.settings.position_tolerance && orientation_error_rad <= self.settings.orientation_tolerance,
            limiting_joint: None,
        }
    }

    /// One iteration of [`InverseKinematics::solve`] on `q`. Returns the joint that wanted furthest beyond its limit.
    fn advance(&mut self, chain: &SerialChain, error: &Vector6<f64>, rest: &[f64], q: &mut [f64], state: &ChainState) -> Option<usize> {
        for (pull, (rest, q)) in self.pull.iter_mut().zip(rest.iter().zip(q.iter())) {
            *pull = self.settings.rest_gain * (rest - q);
        }
        let damping = self.settings.damping + 0.5 * error.norm_squared();
        let limiting_joint = self.step_within_limits(chain, state, error, damping, q);
        let largest = self.step.iter().fold(0.0, |max: f64, step| max.max(step.abs()));
        let scale = (self.settings.max_step / largest).min(1.0);
        q.iter_mut().zip(&self.step).for_each(|(q, step)| *q += scale * step);
        clamp_to_limits(chain, q);
        limiting_joint
    }

    /// Fills `step`; joints at a limit that would step beyond it are held. Returns the one that wanted furthest beyond.
    pub(super) fn step_within_limits(
        &mut self,
        chain: &SerialChain,
        state: &ChainState,
        wanted: &Vector6<f64>,
        damping: f64,
        q: &[f64],
    ) -> Option<usize> {
        self.held.fill(false);
        let mut limiting: Option<(usize, f64)> = None;
        loop {
            self.damped_step(state, wanted, damping);
            let mut any = false;
            for (i, joint) in chain.joints().enumerate() {
                let step = self.step[i];
                let beyond = (step > 0.0 && q[i] >= joint.upper) || (step < 0.0 && q[i] <= joint.lower);
                if beyond && !self.held[i] {
                    self.held[i] = true;
                    any = true;
                    if limiting.is_none_or(|(_, furthest)| step.abs() > furthest) {
                        limiting = Some((i, step.abs()));
                    }
                }
            }
            if !any {
                return limiting.map(|(joint, _)| joint);
            }
        }
    }

    /// dq = g + Jᵀ (J Jᵀ + damping I)⁻¹ (wanted - J g), held joints at zero.
    fn damped_step(&mut self, state: &ChainState, wanted: &Vector6<f64>, damping: f64) {
        let mut gram = Matrix6::from_diagonal_element(damping);
        let mut rest = *wanted;
        for (i, column) in state.jacobian.column_iter().enumerate() {
            if !self.held[i] {
                gram += column * column.transpose();
                rest -= column * self.pull[i];
            }
        }
        let solved = Cholesky::new(gram).map_or_else(Vector6::zeros, |factor| factor.solve(&rest));
        for (i, column) in state.jacobian.column_iter().enumerate() {
            self.step[i] = if self.held[i] { 0.0 } else { self.pull[i] + column.dot(&solved) };
        }
    }
}

fn tip_error(chain: &SerialChain, target: &Isometry3<f64>, q: &[f64], state: &mut ChainState) -> Vector6<f64> {
    chain.forward_kinematics(q, state);
    pose_error(target, &state.tip_pose())
}

/// What is missing from `current` to `target`: translation (m) above rotation vector (rad), base axes.
pub fn pose_error(target: &Isometry3<f64>, current: &Isometry3<f64>) -> Vector6<f64> {
    let linear = target.translation.vector - current.translation.vector;
    let angular: Vector3<f64> = (target.rotation * current.rotation.inverse()).scaled_axis();
    Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
}

fn clamp_to_limits(chain: &SerialChain, q: &mut [f64]) {
    assert_eq!(q.len(), chain.joint_count(), "one position per joint");
    for (q, joint) in q.iter_mut().zip(chain.joints()) {
        *q = q.clamp(joint.lower, joint.upper);
    }
}
