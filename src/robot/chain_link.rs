//! One joint of a chain with the body it moves, laid out for speed.

use nalgebra::{Isometry3, IsometryMatrix3, Matrix3, Unit, Vector3};

use super::lump::Inertia;
use super::model::{Joint, JointKind};

/// One joint with the body it moves.
#[derive(Debug, Clone)]
pub(super) struct ChainLink {
    pub joint: Joint,
    /// Origin of the joint frame in the frame before (m), at q = 0.
    pub offset: Vector3<f64>,
    /// Rotation by q is `fixed + sin(q) * sine + (1 - cos(q)) * versine` (Rodrigues, multiplied out).
    pub fixed: Matrix3<f64>,
    pub sine: Matrix3<f64>,
    pub versine: Matrix3<f64>,
    pub inertia: Inertia,
}

impl ChainLink {
    pub(super) fn new(joint: &Joint, inertia: Inertia) -> Self {
        let mut link = Self {
            joint: joint.clone(),
            offset: Vector3::zeros(),
            fixed: Matrix3::identity(),
            sine: Matrix3::zeros(),
            versine: Matrix3::zeros(),
            inertia,
        };
        link.place_in(&Isometry3::identity());
        link
    }

    /// Measures the joint in a frame before its parent body.
    pub(super) fn place_in(&mut self, before_from_parent: &Isometry3<f64>) {
        let before_from_joint = to_matrix(&(before_from_parent * self.joint.parent_from_joint));
        let rotation = before_from_joint.rotation.into_inner();
        let cross = self.joint.axis.cross_matrix();
        self.offset = before_from_joint.translation.vector;
        self.fixed = rotation;
        self.sine = rotation * cross;
        self.versine = self.sine * cross;
    }

    pub(super) fn axis(&self) -> &Unit<Vector3<f64>> {
        &self.joint.axis
    }

    pub(super) fn is_prismatic(&self) -> bool {
        self.joint.kind == JointKind::Prismatic
    }

    /// Rotation and origin of the joint frame, moved by `q`, in the frame before.
    pub(super) fn local_pose(&self, q: f64) -> (Matrix3<f64>, Vector3<f64>) {
        if self.is_prismatic() {
            let origin = self.offset + self.fixed * (self.axis().into_inner() * q);
            return (self.fixed, origin);
        }
        let (sin, cos) = q.sin_cos();
        let rotation = self.fixed + self.sine * sin + self.versine * (1.0 - cos);
        (rotation, self.offset)
    }
}

pub(super) fn to_matrix(pose: &Isometry3<f64>) -> IsometryMatrix3<f64> {
    IsometryMatrix3::from_parts(pose.translation, pose.rotation.to_rotation_matrix())
}
