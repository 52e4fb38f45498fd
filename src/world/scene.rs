//! Builds the objects of a scene in the engine, part by part, each part with a name.

use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};
use rapier3d_f64::prelude::{ColliderBuilder, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle, SharedShape};

use super::door::Door;
use super::parts::{Owner, Part, Parts};
use super::physics::Layer;
use super::{Object, ObjectKind, Parameters, convert, door, support_height_m};

/// A part of an object that is drawn and touched: a shape in the object's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjectPart {
    /// Its name behind the object's (`base`, `near_post`); empty for an object of one part.
    pub name: &'static str,
    /// Pose in the object's frame.
    pub object_from_part: Isometry3<f64>,
    /// Its shape.
    pub shape: PartShape,
}

/// The shapes that objects are made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PartShape {
    /// A box with these half extents (m).
    Box(Vector3<f64>),
    /// A ball of this radius (m).
    Ball(f64),
    /// An upright bar with round ends: a cylinder along z and two half balls.
    Capsule {
        /// Radius (m).
        radius: f64,
        /// Half the length of the cylinder (m).
        half_length: f64,
    },
}

/// The parts of `object` that stand still although the object moves, in the frame in which [`initial_pose`] puts it: a cabinet's walls.
pub fn fixed_parts(object: &Object) -> Vec<ObjectPart> {
    match &object.kind {
        ObjectKind::Cabinet(cabinet) => cabinet.walls(),
        _ => Vec::new(),
    }
}

/// The parts of `object` in its own frame, whose origin is on the surface it stands on (a ball's and a box's: its centre), axes as the world's.
/// Of a cabinet: its door with the handles, in the frame of the hinge.
pub fn object_parts(object: &Object, parameters: &Parameters) -> Vec<ObjectPart> {
    match &object.kind {
        ObjectKind::Table { size_m, .. } => vec![slab("", [0.0, 0.0, -TABLE_THICKNESS_M / 2.0], [size_m.x, size_m.y, TABLE_THICKNESS_M])],
        ObjectKind::UBlock { base_height_m, aperture_m, post_height_m, post_width_m, thickness_m } => {
            let (h, w) = (base_height_m.resolve(parameters), aperture_m + 2.0 * post_width_m);
            let (x, z) = ((aperture_m + post_width_m) / 2.0, h + post_height_m / 2.0);
            let post = [*post_width_m, *thickness_m, *post_height_m];
            vec![
                slab("base", [0.0, 0.0, h / 2.0], [w, *thickness_m, h]),
                slab("near_post", [-x, 0.0, z], post),
                slab("far_post", [x, 0.0, z], post),
            ]
        }
        ObjectKind::Ball { radius_m, .. } => {
            vec![ObjectPart { name: "", object_from_part: Isometry3::identity(), shape: PartShape::Ball(*radius_m) }]
        }
        ObjectKind::Box { size_m, .. } => vec![slab("", [0.0; 3], (*size_m).into())],
        ObjectKind::Basket { inner_size_m, wall_height_m, wall_thickness_m } => {
            let (t, h) = (*wall_thickness_m, *wall_height_m);
            let (ix, iy) = (inner_size_m.x, inner_size_m.y);
            let (x, y) = ((ix + t) / 2.0, (iy + t) / 2.0);
            vec![
                slab("floor", [0.0, 0.0, t / 2.0], [ix + 2.0 * t, iy + 2.0 * t, t]),
                slab("near_wall", [-x, 0.0, t + h / 2.0], [t, iy + 2.0 * t, h]),
                slab("far_wall", [x, 0.0, t + h / 2.0], [t, iy + 2.0 * t, h]),
                slab("right_wall", [0.0, -y, t + h / 2.0], [ix, t, h]),
                slab("left_wall", [0.0, y, t + h / 2.0], [ix, t, h]),
            ]
        }
        ObjectKind::Cabinet(cabinet) => {
            let handles = cabinet.handle_parts(object.center(parameters).y, parameters);
            std::iter::once(cabinet.panel()).chain(handles).collect()
        }
    }
}

const TABLE_THICKNESS_M: f64 = 0.04;

fn slab(name: &'static str, center: [f64; 3], size: [f64; 3]) -> ObjectPart {
    ObjectPart {
        name,
        object_from_part: Isometry3::translation(center[0], center[1], center[2]),
        shape: PartShape::Box(Vector3::from(size) / 2.0),
    }
}

/// The engine's shape of a part.
pub(super) fn engine_shape(shape: &PartShape) -> SharedShape {
    match *shape {
        PartShape::Box(half) => SharedShape::cuboid(half.x, half.y, half.z),
        PartShape::Ball(radius) => SharedShape::ball(radius),
        PartShape::Capsule { radius, half_length } => SharedShape::capsule_z(half_length, radius),
    }
}

/// Where the object's frame starts (`world_from_object`).
pub fn initial_pose(object: &Object, parameters: &Parameters, support_height: f64) -> Isometry3<f64> {
    let center = object.center(parameters);
    let height = match object.kind {
        ObjectKind::Table { top_height_m, .. } => top_height_m,
        ObjectKind::Ball { radius_m, .. } => support_height + radius_m,
        ObjectKind::Box { size_m, .. } => support_height + size_m.z / 2.0,
        ObjectKind::Cabinet(ref cabinet) => cabinet.hinge_height_m(support_height),
        _ => support_height,
    };
    Isometry3::from_parts(Point3::new(center.x, center.y, height).into(), UnitQuaternion::identity())
}

/// Builds all objects; returns the engine's body of each in their order, of a cabinet that of its door, and the doors.
pub(super) fn build(
    engine: &mut PhysicsWorld,
    objects: &[Object],
    parameters: &Parameters,
    parts: &mut Parts,
) -> (Vec<RigidBodyHandle>, Vec<Door>) {
    let support = support_height_m(objects);
    let (mut bodies, mut doors) = (Vec::with_capacity(objects.len()), Vec::new());
    for (index, object) in objects.iter().enumerate() {
        let pose = initial_pose(object, parameters, support);
        if let ObjectKind::Cabinet(cabinet) = &object.kind {
            if let Some(door) = door::build(engine, (index, object), cabinet, &pose, parameters, parts) {
                bodies.push(door.body);
                doors.push(door);
            }
            continue;
        }
        let (builder, layer, friction, mass_kg) = match object.kind {
            ObjectKind::Ball { friction, mass_kg, rolling_damping_per_s, .. } => {
                (RigidBodyBuilder::dynamic().can_sleep(false).angular_damping(rolling_damping_per_s), Layer::Movable, friction, mass_kg)
            }
            ObjectKind::Box { friction, mass_kg, .. } => (RigidBodyBuilder::dynamic().can_sleep(false), Layer::Movable, friction, mass_kg),
            ObjectKind::Table { friction, .. } => (RigidBodyBuilder::fixed(), Layer::Scenery, friction, 0.0),
            _ => (RigidBodyBuilder::fixed(), Layer::Scenery, FIXED_FRICTION, 0.0),
        };
        let body = engine.insert_body(builder.pose(convert::pose(&pose)));
        for part in object_parts(object, parameters) {
            let name = if part.name.is_empty() { object.name.clone() } else { format!("{}.{}", object.name, part.name) };
            let id = parts.add(Part { name, owner: Owner::Object(index), handle: object.is_movable() });
            let collider = ColliderBuilder::new(engine_shape(&part.shape))
                .position(convert::pose(&part.object_from_part))
                .friction(friction)
                .mass(mass_kg)
                .collision_groups(layer.groups())
                .user_data(id as u128);
            engine.insert_collider(collider, Some(body));
        }
        bodies.push(body);
    }
    (bodies, doors)
}

/// Friction of blocks and basket.
const FIXED_FRICTION: f64 = 0.5;
