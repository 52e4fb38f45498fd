//! From this project's numbers to rerun's: f64 to f32 for what is drawn in space. Scalars of plots stay f64.

use nalgebra::{Isometry3, UnitQuaternion, Vector3};

/// A vector or point.
pub(super) fn vector(v: &Vector3<f64>) -> [f32; 3] {
    [v.x as f32, v.y as f32, v.z as f32]
}

/// An orientation.
pub(super) fn quaternion(q: &UnitQuaternion<f64>) -> rerun::Quaternion {
    let [x, y, z, w] = [q.coords.x, q.coords.y, q.coords.z, q.coords.w];
    rerun::Quaternion::from_xyzw([x as f32, y as f32, z as f32, w as f32])
}

/// One pose.
pub(super) fn transform(pose: &Isometry3<f64>) -> rerun::Transform3D {
    rerun::Transform3D::update_fields().with_translation(vector(&pose.translation.vector)).with_quaternion(quaternion(&pose.rotation))
}

/// A colour given from 0 to 1 per channel.
pub(super) fn color(rgba: [f32; 4]) -> rerun::Color {
    let [r, g, b, a] = rgba.map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8);
    rerun::Color::from_unmultiplied_rgba(r, g, b, a)
}
