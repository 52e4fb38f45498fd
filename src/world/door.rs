//! A cabinet in the engine: walls that stand still, and a door on a hinge with dry friction, damping, a seal and limits.
//!
//! The hinge is a reduced-coordinate joint, so the door has no other way to go and its friction and damping are implicit. The door is closed at
//! an opening of 0, where it touches the seal: a spring and a damper that yield a little before the door stands still.

use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use rapier3d_f64::prelude::{
    GenericJointBuilder, JointAxesMask, JointAxis, MotorModel, MultibodyJointHandle, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle,
};

use super::cabinet::Cabinet;
use super::parts::{Owner, Part, Parts};
use super::physics::Layer;
use super::scene::{ObjectPart, collider};
use super::{Object, Parameters, convert};

/// Friction of walls, door and handles.
const SURFACE_FRICTION: f64 = 0.4;

/// Which object of the scene a part belongs to.
struct Owned<'a> {
    index: usize,
    object: &'a Object,
    layer: Layer,
    body: RigidBodyHandle,
}

/// Damping of a seal: the time constant with which it comes back (s).
const SEAL_TIME_S: f64 = 0.05;

/// A door that moves.
pub(super) struct Door {
    pub body: RigidBodyHandle,
    joint: MultibodyJointHandle,
    seal_nm_per_rad: f64,
}

impl Door {
    /// The seal pushes while the door presses it, before a step.
    pub(super) fn act(&self, engine: &mut PhysicsWorld) {
        let Some(id) = engine.multibody_joints.rigid_body_link(self.body).map(|link| link.id) else { return };
        let Some((multibody, _)) = engine.multibody_joints.get_mut(self.joint) else { return };
        let Some(link) = multibody.link_mut(id) else { return };
        let pressed = link.joint().coords()[ANGLE] < 0.0 && self.seal_nm_per_rad > 0.0;
        let hinge = &mut link.joint.data;
        if pressed {
            hinge.set_motor_position(JointAxis::AngX, 0.0, self.seal_nm_per_rad, self.seal_nm_per_rad * SEAL_TIME_S);
        } else {
            // To the engine a spring without stiffness is a rigid one.
            hinge.motor_axes.remove(JointAxesMask::ANG_X);
        }
    }
}

/// Place of the hinge's angle among a joint's coordinates.
const ANGLE: usize = 3;

/// Builds the cabinet `object`, number `index` of the scene, with its hinge at `world_from_hinge`. Returns its door.
pub(super) fn build(
    engine: &mut PhysicsWorld,
    (index, object): (usize, &Object),
    cabinet: &Cabinet,
    world_from_hinge: &Isometry3<f64>,
    parameters: &Parameters,
    parts: &mut Parts,
) -> Option<Door> {
    let pose = convert::pose(world_from_hinge);
    let walls = engine.insert_body(RigidBodyBuilder::fixed().pose(pose));
    let door = engine.insert_body(RigidBodyBuilder::dynamic().pose(pose).can_sleep(false));
    let fixed = Owned { index, object, layer: Layer::Scenery, body: walls };
    for part in cabinet.walls() {
        insert(engine, &fixed, &part, 0.0, false, parts);
    }
    let moving = Owned { layer: Layer::Movable, body: door, ..fixed };
    insert(engine, &moving, &cabinet.panel(), cabinet.mass_kg.resolve(parameters), false, parts);
    for part in cabinet.handle_parts(world_from_hinge.translation.y, parameters) {
        insert(engine, &moving, &part, 0.0, true, parts);
    }
    hang(engine, cabinet, parameters, (walls, door))
}

/// Puts the door on its hinge. The joint's own axis is its frames' x, which points down: the door opens with a positive angle.
fn hang(
    engine: &mut PhysicsWorld,
    cabinet: &Cabinet,
    parameters: &Parameters,
    (walls, door): (RigidBodyHandle, RigidBodyHandle),
) -> Option<Door> {
    let down =
        Isometry3::from_parts(Vector3::zeros().into(), UnitQuaternion::from_axis_angle(&Vector3::y_axis(), std::f64::consts::FRAC_PI_2));
    let hinge = GenericJointBuilder::new(JointAxesMask::LOCKED_REVOLUTE_AXES)
        .local_frame1(convert::pose(&down))
        .local_frame2(convert::pose(&down))
        .contacts_enabled(false)
        .limits(JointAxis::AngX, [-cabinet.seal_travel_rad, cabinet.opening_max_rad])
        .motor_model(JointAxis::AngX, MotorModel::ForceBased)
        .build();
    let PhysicsWorld { bodies, colliders, multibody_joints, .. } = engine;
    let joint = multibody_joints.insert(walls, door, hinge, true)?;
    if let Some(body) = bodies.get_mut(door) {
        body.recompute_mass_properties_from_colliders(colliders);
    }
    let (multibody, _) = multibody_joints.get_mut(joint)?;
    multibody.set_self_contacts_enabled(false);
    multibody.forward_kinematics(bodies, true);
    multibody.update_rigid_bodies(bodies, true);
    // Only now is the hinge the first degree of freedom: until its root is known to be fixed, that has six of its own.
    multibody.damping_mut()[0] = cabinet.damping_nms_per_rad;
    multibody.frictions_mut()[0] = cabinet.friction_nm.resolve(parameters);
    Some(Door { body: door, joint, seal_nm_per_rad: cabinet.seal_nm_per_rad })
}

fn insert(engine: &mut PhysicsWorld, owned: &Owned, part: &ObjectPart, mass_kg: f64, handle: bool, parts: &mut Parts) {
    let name = format!("{}.{}", owned.object.name, part.name);
    let id = parts.add(Part { name, owner: Owner::Object(owned.index), handle });
    let built = collider(part).friction(SURFACE_FRICTION).mass(mass_kg).collision_groups(owned.layer.groups()).user_data(id as u128);
    engine.insert_collider(built, Some(owned.body));
}
