//! Orientations as unit quaternions: logarithm and exponential, interpolation, mean.
//!
//! `q` and `-q` are the same orientation. The functions here never choose between them on their own: [`same_hemisphere`] does, once,
//! and everything after it is continuous.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Matrix4, Quaternion, SymmetricEigen, Unit, UnitQuaternion, Vector3, Vector4};

/// `q` or `-q`, whichever is nearer to `reference`.
#[must_use]
pub fn same_hemisphere(q: &UnitQuaternion<f64>, reference: &UnitQuaternion<f64>) -> UnitQuaternion<f64> {
    if q.coords.dot(&reference.coords) < 0.0 { UnitQuaternion::new_unchecked(-q.into_inner()) } else { *q }
}

/// The rotation vector (rad) of `q`, whose angle lies in [0, 2 pi]: above pi when the scalar part is negative.
///
/// Taking the sign of `q` as it comes keeps the vector continuous along a sign-continuous path, also past half a turn.
#[must_use]
pub fn log_map(q: &UnitQuaternion<f64>) -> Vector3<f64> {
    let (v, w) = (q.imag(), q.scalar());
    let sine = v.norm();
    if sine < 1e-12 {
        // The series of 2 atan2(sine, w) / sine about sine = 0; at w = -1 the axis is undefined and the turn is whole.
        return v * (2.0 * w.signum());
    }
    v * (2.0 * sine.atan2(w) / sine)
}

/// The unit quaternion of a rotation vector (rad); inverse of [`log_map`].
#[must_use]
pub fn exp_map(rotation_vector: &Vector3<f64>) -> UnitQuaternion<f64> {
    let half = 0.5 * rotation_vector.norm();
    let ratio = if half < 1e-8 { 0.5 - half * half / 12.0 } else { 0.5 * half.sin() / half };
    let v = rotation_vector * ratio;
    UnitQuaternion::new_normalize(Quaternion::new(half.cos(), v.x, v.y, v.z))
}

/// The rotation vector (rad) of `q` that lies nearest to `previous`, of any number of turns: continuous along a path that is followed in
/// small steps, past half and whole turns. Blind to the sign of `q`.
#[must_use]
pub fn continuous_log(q: &UnitQuaternion<f64>, previous: &Vector3<f64>) -> Vector3<f64> {
    let short = log_map(&same_hemisphere(q, &UnitQuaternion::identity()));
    let angle = short.norm();
    // Where the axis is undefined, that of the previous vector is as good as any.
    let axis = if angle > 1e-9 { short / angle } else { previous.try_normalize(1e-9).unwrap_or_else(Vector3::zeros) };
    short + axis * (((axis.dot(previous) - angle) / TAU).round() * TAU)
}

/// `J` of a rotation vector `r` (rad): `exp(r)` turns with the angular velocity `J rdot` along its own axes.
///
/// `J = I - (1 - cos a) / a^2 [r]x + (a - sin a) / a^3 [r]x^2` with `a = |r|`.
#[must_use]
pub fn right_jacobian(r: &Vector3<f64>) -> Matrix3<f64> {
    let a = r.norm();
    let (first, second) =
        if a < 1e-3 { (0.5 - a * a / 24.0, 1.0 / 6.0 - a * a / 120.0) } else { ((1.0 - a.cos()) / (a * a), (a - a.sin()) / (a * a * a)) };
    let cross = r.cross_matrix();
    Matrix3::identity() - cross * first + cross * cross * second
}

/// The orientation a fraction of the way from `a` to `b` along the shorter arc.
#[must_use]
pub fn slerp(a: &UnitQuaternion<f64>, b: &UnitQuaternion<f64>, fraction: f64) -> UnitQuaternion<f64> {
    let b = same_hemisphere(b, a);
    let turn = log_map(&(a.inverse() * b));
    a * exp_map(&(turn * fraction))
}

/// The mean orientation: the unit quaternion with the largest `sum_t (q . q_t)^2` (blind to signs); identity for none.
#[must_use]
pub fn mean_quaternion<'a>(orientations: impl IntoIterator<Item = &'a UnitQuaternion<f64>>) -> UnitQuaternion<f64> {
    let mut scatter = Matrix4::zeros();
    for q in orientations {
        scatter += q.coords * q.coords.transpose();
    }
    if scatter == Matrix4::zeros() {
        return UnitQuaternion::identity();
    }
    let eigen = SymmetricEigen::new(scatter);
    let axis: Vector4<f64> = eigen.eigenvectors.column(eigen.eigenvalues.imax()).into_owned();
    let axis = if axis.w < 0.0 { -axis } else { axis };
    Unit::new_normalize(Quaternion::from_vector(axis))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithm_and_exponential_are_inverse_up_to_a_whole_turn() {
        for angle in [0.0, 1e-9, 0.3, 3.1, 3.2, 6.0] {
            let r = Vector3::new(2.0, -1.0, 2.0) / 3.0 * angle;
            assert!((log_map(&exp_map(&r)) - r).norm() < 1e-9, "angle {angle}");
        }
    }

    #[test]
    fn the_continuous_logarithm_follows_several_turns_and_ignores_signs() {
        let axis = Vector3::new(1.0, 2.0, -2.0) / 3.0;
        let mut previous = Vector3::zeros();
        for i in 0..=200 {
            let r = axis * (0.1 * f64::from(i));
            let q = exp_map(&r);
            let q = if i % 3 == 0 { UnitQuaternion::new_unchecked(-q.into_inner()) } else { q };
            previous = continuous_log(&q, &previous);
            assert!((previous - r).norm() < 1e-6, "{previous} at {r}");
        }
    }

    #[test]
    fn the_jacobian_is_the_derivative_of_the_exponential() {
        for r in [Vector3::zeros(), Vector3::new(1e-4, 0.0, 2e-4), Vector3::new(0.7, -1.1, 2.0), Vector3::new(3.0, 2.0, 4.0)] {
            for j in 0..3 {
                let h = 1e-6 * Vector3::ith(j, 1.0);
                let turned = log_map(&(exp_map(&(r - h)).inverse() * exp_map(&(r + h)))) / 2e-6;
                assert!((turned - right_jacobian(&r).column(j)).norm() < 1e-7, "at {r}");
            }
        }
    }

    #[test]
    fn the_mean_ignores_signs_and_slerp_takes_the_short_way() {
        let (a, b) = (exp_map(&Vector3::new(0.2, 0.0, 0.0)), exp_map(&Vector3::new(0.4, 0.0, 0.0)));
        let flipped = UnitQuaternion::new_unchecked(-b.into_inner());
        let middle = exp_map(&Vector3::new(0.3, 0.0, 0.0));
        assert!(mean_quaternion([&a, &flipped]).angle_to(&middle) < 1e-7);
        assert!(slerp(&a, &flipped, 0.5).angle_to(&middle) < 1e-7);
    }
}
