//! What the contacts of a pair of shapes did in the last step, pressing and rubbing, as the engine solved it.

use nalgebra::Vector3;
use rapier3d_f64::prelude::{ContactData, ContactManifold, ContactPair, NEW_CONTACT_BIT, Vector};
use rapier3d_f64::utils::OrthonormalBasis;

use super::convert;

/// The points of a manifold that the engine solved in the last step.
fn solved(manifold: &ContactManifold) -> impl Iterator<Item = &ContactData> {
    let points = manifold.data.solver_contacts.iter().map(|contact| (contact.contact_id[0] & !NEW_CONTACT_BIT) as usize);
    points.filter_map(|point| Some(&manifold.points.get(point)?.data))
}

/// Sum of the normal impulses of the last step (N s).
pub(super) fn normal_impulse(pair: &ContactPair) -> f64 {
    pair.solver_manifolds().iter().flat_map(solved).map(|data| data.impulse).sum()
}

/// What the contacts of a pair did to its second collider in the last step (N s, world).
pub(super) fn impulse_on_second(pair: &ContactPair) -> Vector3<f64> {
    let of_manifold = |manifold: &ContactManifold| {
        let normal = manifold.data.normal;
        solved(manifold).map(|data| convert::vector_back(normal) * data.impulse - friction_on_first(data, normal)).sum::<Vector3<f64>>()
    };
    pair.solver_manifolds().iter().map(of_manifold).sum()
}

/// What friction did to the first collider at a point of contact in the last step (N s, world): along the engine's own two axes of the surface.
fn friction_on_first(data: &ContactData, normal: Vector) -> Vector3<f64> {
    let first = (-normal).orthonormal_vector();
    let second = (-normal).cross(first);
    convert::vector_back(first * data.tangent_impulse.x + second * data.tangent_impulse.y)
}

#[cfg(test)]
mod tests {
    use rapier3d_f64::prelude::{
        ColliderBuilder, GenericJointBuilder, JointAxesMask, MultibodyJointHandle, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle,
    };

    use super::super::physics::{PhysicsSettings, engine};
    use super::*;

    const MASS_KG: f64 = 2.0;
    const G: f64 = 9.81;
    /// Half the sizes of the block (m).
    const HALF_M: [f64; 3] = [0.08, 0.05, 0.05];

    /// A block on a slope, which is a level plane under a tilted gravity; the way down is along `(cos 1, sin 1, 0)`, which is no axis of anything.
    /// The block is a multibody, as every robot is.
    struct Slope {
        world: PhysicsWorld,
        block: RigidBodyHandle,
        joint: MultibodyJointHandle,
    }

    impl Slope {
        /// The block can do what `locked` leaves it.
        fn new(angle_rad: f64, friction: f64, locked: JointAxesMask) -> Self {
            let (along, across) = (G * angle_rad.sin(), G * angle_rad.cos());
            let gravity = [along * 1.0_f64.cos(), along * 1.0_f64.sin(), -across];
            let mut world = engine(&PhysicsSettings { gravity_m_per_s2: gravity, ..PhysicsSettings::default() });
            let plane = world.insert_body(RigidBodyBuilder::fixed());
            let below = Vector::new(0.0, 0.0, -0.1);
            world.insert_collider(ColliderBuilder::cuboid(20.0, 20.0, 0.1).translation(below).friction(friction), Some(plane));
            let start = Vector::new(0.0, 0.0, HALF_M[2]);
            let block = world.insert_body(RigidBodyBuilder::dynamic().translation(start).can_sleep(false));
            let [x, y, z] = HALF_M;
            world.insert_collider(ColliderBuilder::cuboid(x, y, z).mass(MASS_KG).friction(friction), Some(block));
            let PhysicsWorld { bodies, colliders, multibody_joints, .. } = &mut world;
            let joint = GenericJointBuilder::new(locked).local_anchor1(start).build();
            let joint = multibody_joints.insert(plane, block, joint, true).expect("a joint");
            bodies[block].recompute_mass_properties_from_colliders(colliders);
            let (multibody, _) = multibody_joints.get_mut(joint).expect("a multibody");
            multibody.forward_kinematics(bodies, true);
            multibody.update_rigid_bodies(bodies, true);
            Self { world, block, joint }
        }

        /// The first three coordinates of the joint are the block's place, along the world's axes.
        fn velocity(&mut self) -> Vector3<f64> {
            let (multibody, _) = self.world.multibody_joints.get_mut(self.joint).expect("a multibody");
            multibody.generalized_velocity().fixed_rows::<3>(0).into()
        }

        /// Force on the block by all contacts of the last step (N, world).
        fn contacts_n(&self) -> Vector3<f64> {
            let of_pair = |pair: &ContactPair| {
                let second = self.world.colliders.get(pair.collider2).and_then(|collider| collider.parent()) == Some(self.block);
                if second { impulse_on_second(pair) } else { -impulse_on_second(pair) }
            };
            self.world.narrow_phase.contact_pairs().map(of_pair).sum::<Vector3<f64>>() / self.world.integration_parameters.dt
        }
    }

    /// Closed form: a block that rests on a slope is held by `m g cos a` normal to it and by `m g sin a` along it; one that slides is rubbed with
    /// `mu` times the normal force.
    #[test]
    fn a_block_on_a_slope_is_held_by_its_weight_and_rubbed_by_friction() {
        for (angle_rad, friction, rubbed) in [(0.3, 0.6, 0.3_f64.tan()), (0.6, 0.3, 0.3)] {
            let mut slope = Slope::new(angle_rad, friction, JointAxesMask::ANG_AXES);
            (0..1000).for_each(|_| slope.world.step());
            let normal_n = MASS_KG * G * f64::cos(angle_rad);
            let expected = Vector3::new(-rubbed * 1.0_f64.cos(), -rubbed * 1.0_f64.sin(), 1.0) * normal_n;
            let found = slope.contacts_n();
            assert!((found - expected).norm() < 1e-3 * normal_n, "slope {angle_rad}, friction {friction}: {found} N, not {expected} N");
        }
    }

    /// Newton's second law, at every step, while the block is thrown, lands on an edge, tumbles and slides, and points of contact come and go:
    /// momentum changes by what the contacts and the weight do, and by nothing else.
    #[test]
    fn contacts_and_weight_are_all_that_changes_momentum() {
        let mut slope = Slope::new(0.5, 0.3, JointAxesMask::empty());
        let (multibody, _) = slope.world.multibody_joints.get_mut(slope.joint).expect("a multibody");
        multibody.generalized_velocity_mut().copy_from_slice(&[0.3, -0.2, 0.8, 2.0, 1.0, 0.5]);
        let (dt, weight) = (slope.world.integration_parameters.dt, convert::vector_back(slope.world.gravity) * MASS_KG);
        let (mut touched, mut flown) = (0, 0);
        for step in 0..1500 {
            let before = slope.velocity();
            slope.world.step();
            let gained = (slope.velocity() - before) * MASS_KG / dt;
            let contacts = slope.contacts_n();
            assert!(
                (gained - weight - contacts).norm() < 1e-6 * (1.0 + contacts.norm()),
                "step {step}: {gained} N, not {contacts} N and {weight} N"
            );
            touched += usize::from(contacts.norm() > 1.0);
            flown += usize::from(touched > 0 && contacts.norm() == 0.0);
        }
        assert!(touched > 300 && flown > 0, "touches in {touched} steps, flies in {flown} after the first touch");
    }
}
