//! Builds the objects of a scene in the engine, part by part, each part with a name.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use rapier3d_f64::prelude::{
    ColliderBuilder, MotorModel, PhysicsWorld, PrismaticJointBuilder, RigidBodyBuilder, RigidBodyHandle, SharedShape, Vector,
};

use super::door::Door;
use super::parts::{Owner, Part, Parts};
use super::physics::Layer;
use super::{Object, ObjectKind, Parameters, Quantity, convert, door, support_height_m};

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
    /// A cylinder around z of this radius and height (m).
    Cylinder(f64, f64),
    /// A bar around z with round ends: a cylinder of this radius and height, and two half balls (m).
    Capsule(f64, f64),
}

/// The parts of `object` that stand still although the object moves, in the frame in which [`Object::pose`] puts it: a cabinet's walls.
pub fn fixed_parts(object: &Object) -> Vec<ObjectPart> {
    match &object.kind {
        ObjectKind::Cabinet(cabinet) => cabinet.walls(),
        _ => Vec::new(),
    }
}

/// The parts of `object` in its own frame, see [`Object::pose`]; of a cabinet, its door with the handles.
pub fn object_parts(object: &Object, parameters: &Parameters) -> Vec<ObjectPart> {
    match &object.kind {
        ObjectKind::Table { size_m, .. } => vec![slab("", [0.0, 0.0, -TABLE_THICKNESS_M / 2.0], [size_m.x, size_m.y, TABLE_THICKNESS_M])],
        ObjectKind::UBlock { base_height_m, aperture_m, post_height_m, post_width_m, thickness_m, .. } => {
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
        ObjectKind::Cylinder { radius_m, height_m, .. } => {
            vec![ObjectPart { name: "", object_from_part: Isometry3::identity(), shape: PartShape::Cylinder(*radius_m, *height_m) }]
        }
        ObjectKind::Box { size_m, .. } | ObjectKind::SpringPlate { size_m, .. } => vec![slab("", [0.0; 3], (*size_m).into())],
        ObjectKind::Basket { inner_size_m, wall_height_m, wall_thickness_m, .. } => {
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

/// Builds all objects; returns the engine's body of each in their order, of a cabinet that of its door, and the doors.
pub(super) fn build(
    engine: &mut PhysicsWorld,
    objects: &[Object],
    parameters: &Parameters,
    parts: &mut Parts,
) -> (Vec<RigidBodyHandle>, Vec<Door>) {
    let (mut bodies, mut doors) = (Vec::with_capacity(objects.len()), Vec::new());
    for (index, object) in objects.iter().enumerate() {
        let pose = object.pose(parameters, support_height_m(objects, object, parameters));
        if let ObjectKind::Cabinet(cabinet) = &object.kind {
            if let Some(door) = door::build(engine, (index, object), cabinet, &pose, parameters, parts) {
                bodies.push(door.body);
                doors.push(door);
            }
            continue;
        }
        let matter = Matter::of(object, parameters);
        let builder = if object.is_movable() {
            RigidBodyBuilder::dynamic().can_sleep(false).angular_damping(matter.angular_damping_per_s)
        } else {
            RigidBodyBuilder::fixed()
        };
        let layer = if object.is_movable() { Layer::Movable } else { Layer::Scenery };
        let body = engine.insert_body(builder.pose(convert::pose(&pose)));
        for part in object_parts(object, parameters) {
            let name = if part.name.is_empty() { object.name.clone() } else { format!("{}.{}", object.name, part.name) };
            let id = parts.add(Part { name, owner: Owner::Object(index), handle: object.is_movable() });
            let collider =
                collider(&part).friction(matter.friction).mass(matter.mass_kg).collision_groups(layer.groups()).user_data(id as u128);
            engine.insert_collider(collider, Some(body));
        }
        if let ObjectKind::SpringPlate { travel_m, stiffness_n_per_m, damping_ns_per_m, .. } = &object.kind {
            let spring = Spring { stiffness: stiffness_n_per_m.resolve(parameters), damping: *damping_ns_per_m, travel: *travel_m };
            mount(engine, body, &pose, matter.mass_kg, &spring);
        }
        bodies.push(body);
    }
    (bodies, doors)
}

/// The engine's collider of a part.
pub(super) fn collider(part: &ObjectPart) -> ColliderBuilder {
    let (shape, mut part_from_shape) = match part.shape {
        PartShape::Box(half) => (SharedShape::cuboid(half.x, half.y, half.z), UnitQuaternion::identity()),
        PartShape::Ball(radius) => (SharedShape::ball(radius), UnitQuaternion::identity()),
        // The engine's cylinders stand along y.
        PartShape::Cylinder(radius, height) => {
            (SharedShape::cylinder(height / 2.0, radius), UnitQuaternion::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2))
        }
        PartShape::Capsule(radius, height) => (SharedShape::capsule_z(height / 2.0, radius), UnitQuaternion::identity()),
    };
    part_from_shape = part.object_from_part.rotation * part_from_shape;
    ColliderBuilder::new(shape).position(convert::pose(&Isometry3::from_parts(part.object_from_part.translation, part_from_shape)))
}

/// What the parts of an object are made of.
struct Matter {
    mass_kg: f64,
    friction: f64,
    angular_damping_per_s: f64,
}

impl Matter {
    fn of(object: &Object, parameters: &Parameters) -> Self {
        let weightless = Quantity::Value(0.0);
        let (mass, friction, angular_damping_per_s) = match &object.kind {
            ObjectKind::Ball { friction, mass_kg, rolling_damping_per_s, .. } => (mass_kg, friction, *rolling_damping_per_s),
            ObjectKind::Box { body, .. } | ObjectKind::Cylinder { body, .. } => (&body.mass_kg, &body.friction, 0.0),
            ObjectKind::SpringPlate { mass_kg, friction, .. } => (mass_kg, friction, 0.0),
            ObjectKind::Table { friction, .. } | ObjectKind::UBlock { friction, .. } | ObjectKind::Basket { friction, .. } => {
                (&weightless, friction, 0.0)
            }
            // Built in its own way.
            ObjectKind::Cabinet(_) => (&weightless, &weightless, 0.0),
        };
        Self { mass_kg: mass.resolve(parameters), friction: friction.resolve(parameters), angular_damping_per_s }
    }
}

/// The spring of a plate: stiffness (N/m), damping (N s/m), travel (m).
struct Spring {
    stiffness: f64,
    damping: f64,
    travel: f64,
}

/// Lets the plate `body` of mass `mass_kg` slide down from `world_from_plate` against a spring, which carries its weight at that place.
fn mount(engine: &mut PhysicsWorld, body: RigidBodyHandle, world_from_plate: &Isometry3<f64>, mass_kg: f64, spring: &Spring) {
    let frame = engine.insert_body(RigidBodyBuilder::fixed().pose(convert::pose(world_from_plate)));
    let weight = -mass_kg * engine.gravity.z;
    let joint = PrismaticJointBuilder::new(Vector::Z).limits([-spring.travel, 0.0]).motor_model(MotorModel::ForceBased).motor_position(
        weight / spring.stiffness,
        spring.stiffness,
        spring.damping,
    );
    engine.insert_impulse_joint(frame, body, joint);
}
