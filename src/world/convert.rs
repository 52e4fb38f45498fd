//! The one place where the engine's number types meet the project's.

use nalgebra::{Isometry3, Matrix3, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};
use rapier3d_f64::prelude::{Matrix, Pose, Rotation, Vector};

pub(super) fn vector(v: &Vector3<f64>) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

pub(super) fn vector_back(v: Vector) -> Vector3<f64> {
    Vector3::new(v.x, v.y, v.z)
}

pub(super) fn point_back(v: Vector) -> Point3<f64> {
    Point3::new(v.x, v.y, v.z)
}

pub(super) fn pose(t: &Isometry3<f64>) -> Pose {
    let q = t.rotation.coords;
    Pose::from_parts(vector(&t.translation.vector), Rotation::from_xyzw(q.x, q.y, q.z, q.w))
}

pub(super) fn pose_back(t: &Pose) -> Isometry3<f64> {
    let (p, q) = (t.translation, t.rotation);
    Isometry3::from_parts(Translation3::new(p.x, p.y, p.z), UnitQuaternion::new_normalize(Quaternion::new(q.w, q.x, q.y, q.z)))
}

pub(super) fn matrix(m: &Matrix3<f64>) -> Matrix {
    Matrix::from_cols(vector(&m.column(0).into()), vector(&m.column(1).into()), vector(&m.column(2).into()))
}
