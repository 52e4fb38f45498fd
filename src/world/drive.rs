//! The drive of one joint, with the limits of a real one.

use rapier3d_f64::prelude::{RigidBodyHandle, Vector};

use super::convert;
use crate::robot::{Joint, JointKind};

/// One moving joint in the engine.
pub(super) struct Drive {
    /// Its index in the robot model.
    pub(super) joint: usize,
    pub(super) parent: RigidBodyHandle,
    pub(super) link: RigidBodyHandle,
    pub(super) axis: Vector,
    pub(super) effort_limit: f64,
    pub(super) velocity_limit: f64,
    /// Inertia that the drive moves when the other joints are free, in the first posture (kg m² or kg).
    pub(super) inertia: f64,
    pub(super) passive_damping: f64,
    /// The drive's effort in the last step (N m or N).
    pub(super) effort: f64,
    /// By how much that was over the limit; taken back in the next step (N m or N).
    pub(super) excess: f64,
    pub(super) command: (f64, f64),
}

impl Drive {
    pub(super) fn new(index: usize, joint: &Joint, parent: RigidBodyHandle, link: RigidBodyHandle) -> Self {
        Self {
            joint: index,
            parent,
            link,
            axis: if joint.kind == JointKind::Prismatic { Vector::ZERO } else { convert::vector(&joint.axis) },
            effort_limit: joint.effort_limit,
            velocity_limit: joint.velocity_limit,
            inertia: f64::INFINITY,
            passive_damping: joint.damping,
            effort: 0.0,
            excess: 0.0,
            command: (0.0, 0.0),
        }
    }

    /// `torque` within the effort limit, and no more than takes the joint to its velocity limit within the step; beyond that limit it brakes.
    pub(super) fn limited(&self, torque: f64, velocity: f64, step_s: f64) -> f64 {
        let push = |limit: f64| (limit - velocity) * self.inertia / step_s;
        let within = torque.min(push(self.velocity_limit)).max(push(-self.velocity_limit));
        within.clamp(-self.effort_limit, self.effort_limit)
    }
}
