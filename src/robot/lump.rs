//! Adding up the inertias of rigidly joined parts.

use nalgebra::{Isometry3, Matrix3, Vector3};

use super::model::RobotModel;

/// Mass, centre of mass and inertia about it, in one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Inertia {
    /// Mass (kg).
    pub mass: f64,
    /// Centre of mass (m).
    pub center: Vector3<f64>,
    /// Inertia about the centre of mass (kg m²).
    pub about_center: Matrix3<f64>,
}

impl Inertia {
    pub(super) const ZERO: Self =
        Self { mass: 0.0, center: Vector3::new(0.0, 0.0, 0.0), about_center: Matrix3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0) };

    /// The same part seen from another frame.
    pub(super) fn transformed(&self, new_from_old: &Isometry3<f64>) -> Self {
        let rotation = new_from_old.rotation.to_rotation_matrix();
        Self {
            mass: self.mass,
            center: new_from_old * nalgebra::Point3::from(self.center) - nalgebra::Point3::origin(),
            about_center: rotation * self.about_center * rotation.transpose(),
        }
    }

    /// Both parts as one rigid body (parallel axis theorem about the common centre of mass).
    pub(super) fn plus(&self, other: &Self) -> Self {
        let mass = self.mass + other.mass;
        if mass == 0.0 {
            return Self { about_center: self.about_center + other.about_center, ..Self::ZERO };
        }
        let center = (self.center * self.mass + other.center * other.mass) / mass;
        Self { mass, center, about_center: self.about(&center) + other.about(&center) }
    }

    /// Inertia about `point`: I + m (|d|² 1 - d dᵀ), d from the centre of mass to the point.
    fn about(&self, point: &Vector3<f64>) -> Matrix3<f64> {
        let d = point - self.center;
        self.about_center + (Matrix3::identity() * d.norm_squared() - d * d.transpose()) * self.mass
    }
}

/// Inertia of each body of the chain with all that hangs on it, in the chain body's frame. `q`: positions of all joints of the robot.
pub(super) fn lumped_inertias(model: &RobotModel, path: &[usize], q: &[f64]) -> Vec<Inertia> {
    let inertia_of = |body: usize| Inertia {
        mass: model.bodies[body].mass_kg,
        center: model.bodies[body].center_of_mass,
        about_center: model.bodies[body].inertia,
    };
    let mut total: Vec<Inertia> = (0..model.bodies.len()).map(inertia_of).collect();
    for (index, joint) in model.joints.iter().enumerate().rev() {
        if !path.contains(&index) {
            let parent_from_child = joint.parent_from_child(model.position_of(index, q));
            let child = total[joint.child_body].transformed(&parent_from_child);
            total[joint.parent_body] = total[joint.parent_body].plus(&child);
        }
    }
    path.iter().map(|&joint| total[model.joints[joint].child_body]).collect()
}
