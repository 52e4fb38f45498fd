//! Differential inverse kinematics: one damped least-squares step per control tick.

use nalgebra::{Isometry3, Vector6};

use super::chain::{ChainState, SerialChain};
use super::inverse_kinematics::{InverseKinematics, pose_error};

/// How a differential step follows its target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FollowSettings {
    /// Share of the pose error removed per second (1/s). Default 20: 50 ms time constant, slow against 1 kHz, fast against the arm.
    pub error_gain: f64,
    /// Share of the way to the rest posture per second, as far as the tip allows (1/s). Default 1.
    pub rest_gain: f64,
    /// lambda², squared metres and radians mixed. Default 1e-4: 1 % less speed where the smallest singular value is 0.1.
    pub damping: f64,
}

impl Default for FollowSettings {
    fn default() -> Self {
        Self { error_gain: 20.0, rest_gain: 1.0, damping: 1e-4 }
    }
}

impl InverseKinematics {
    /// Joint velocities `v` (rad/s or m/s, n) that make the tip follow `target`, moving with `twist` (m/s, rad/s, base axes, at the tip):
    /// one step, for use at every control tick. Within velocity limits (all joints slowed alike) and out of joint limits within `dt` (s).
    ///
    /// Returns the pose error before the step (m, rad; base axes).
    ///
    /// # Panics
    /// If a slice has not n entries or `state` belongs to a chain of another length.
    #[expect(clippy::too_many_arguments, reason = "a control tick: what to follow, where the arm is, buffers")]
    pub fn follow(
        &mut self,
        chain: &SerialChain,
        target: (&Isometry3<f64>, &Vector6<f64>),
        rest: &[f64],
        settings: &FollowSettings,
        dt: f64,
        q: &[f64],
        state: &mut ChainState,
        v: &mut [f64],
    ) -> Vector6<f64> {
        let n = chain.joint_count();
        assert!([rest.len(), v.len()] == [n; 2], "one entry per joint");
        chain.forward_kinematics(q, state);
        let error = pose_error(target.0, &state.tip_pose());
        let wanted = target.1 + error * settings.error_gain;
        for (pull, (rest, q)) in self.pull.iter_mut().zip(rest.iter().zip(q)) {
            *pull = settings.rest_gain * (rest - q);
        }
        self.step_within_limits(chain, state, &wanted, settings.damping, q);
        let excess = chain.joints().zip(&self.step);
        let excess = excess.fold(1.0, |max: f64, (joint, step)| max.max(step.abs() / joint.velocity_limit));
        for (i, joint) in chain.joints().enumerate() {
            let within = (self.step[i] / excess).min((joint.upper - q[i]) / dt).max((joint.lower - q[i]) / dt);
            v[i] = within.clamp(-joint.velocity_limit, joint.velocity_limit);
        }
        error
    }
}
