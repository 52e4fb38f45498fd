//! The robot in the engine: a working arm with its gripper, another arm that holds still, and everything that does not move.

use nalgebra::{DMatrix, Isometry3, Translation3, UnitQuaternion, Vector3};
use rapier3d_f64::prelude::{ColliderBuilder, MassProperties, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle, SharedShape, Vector};

use super::articulation::Articulation;
use super::parts::{Limb, Owner, Part, Parts};
use super::physics::Layer;
use super::{WorldError, convert};
use crate::robot::{JointKind, RobotModel, Shape};

/// Coefficient of friction of the links that are no fingers.
const LINK_FRICTION: f64 = 0.5;

/// Number of an arm's first links that overlap the torso by construction.
const PROXIMAL_LINKS: usize = 2;

/// Which joints of a model form which arm.
#[derive(Clone, Debug)]
pub(super) struct Limbs {
    /// Joints of the working arm's tree, parents first.
    pub working: Vec<usize>,
    /// Places in `working` of the joints between base and tool.
    pub arm: Vec<usize>,
    /// Places in `working` of the gripper's joints.
    pub fingers: Vec<usize>,
    /// Joints of the other arm's tree, and the places in it of the joints between base and its tool.
    pub idle: Vec<usize>,
    pub idle_arm: Vec<usize>,
    /// Link that is the tool; its shapes, if it has any, hold things as fingers do.
    pub tool_link: String,
    /// Index of the body that carries the tool, and the tool in it.
    pub tool_body: usize,
    pub body_from_tool: Isometry3<f64>,
    /// The place where a person takes hold, on a body of the arm.
    pub grasp_body: usize,
    pub body_from_grasp: Isometry3<f64>,
}

impl Limbs {
    /// Finds the arm that carries `tool` (a person takes hold of its link `grasp`) and the one that carries `idle_tool`, if there is one; the
    /// rest of the robot does not move.
    pub(super) fn find(model: &RobotModel, tool: &str, grasp: &str, idle_tool: Option<&str>) -> Result<Self, WorldError> {
        let refuse = |what: String, help: &str| WorldError::Robot { robot: model.name.clone(), what, help: help.into() };
        let frame = |name: &str| model.frame(name).ok_or_else(|| refuse(format!("link `{name}`"), "name an existing link of the URDF"));
        let (tool, grasp) = (frame(tool)?, frame(grasp)?);
        let (working, chain) = tree_of(model, tool.body)
            .ok_or_else(|| refuse(format!("moving joint between its base and `{}`", tool.name), "name the tool frame of an arm"))?;
        let on_arm = |body: usize| working.iter().any(|&joint| model.joints[joint].child_body == body);
        if !on_arm(grasp.body) {
            return Err(refuse(format!("link `{}` on the arm that works", grasp.name), "let the person take hold of a link of that arm"));
        }
        let (idle, idle_chain) = match idle_tool {
            None => (Vec::new(), Vec::new()),
            Some(name) => tree_of(model, frame(name)?.body)
                .filter(|(tree, _)| tree[0] != working[0])
                .ok_or_else(|| refuse(format!("other arm that carries `{name}`"), "name the tool frame of the arm that does not work"))?,
        };
        let (arm, fingers): (Vec<usize>, Vec<usize>) = (0..working.len()).partition(|&i| chain.contains(&working[i]));
        let idle_arm = (0..idle.len()).filter(|&i| idle_chain.contains(&idle[i])).collect();
        let slides = |joint: &usize| model.joints[*joint].kind == JointKind::Prismatic;
        if chain.iter().chain(&idle_chain).any(slides) {
            return Err(refuse("arm of turning joints only".into(), "arms with sliding joints cannot be driven yet"));
        }
        if !fingers.iter().all(|&i| slides(&working[i])) {
            return Err(refuse("gripper of sliding fingers".into(), "grippers with turning fingers cannot be driven yet"));
        }
        Ok(Self {
            working,
            arm,
            fingers,
            idle,
            idle_arm,
            tool_link: tool.name.clone(),
            tool_body: tool.body,
            body_from_tool: tool.body_from_frame,
            grasp_body: grasp.body,
            body_from_grasp: grasp.body_from_frame,
        })
    }
}

/// The joints of the tree that carries `body` (parents first), and those of them between base and `body`; nothing for the base itself.
fn tree_of(model: &RobotModel, body: usize) -> Option<(Vec<usize>, Vec<usize>)> {
    let chain = chain_to(model, body);
    Some((subtree(model, *chain.first()?), chain))
}

/// Joints from the base to `body`.
fn chain_to(model: &RobotModel, mut body: usize) -> Vec<usize> {
    let mut chain = Vec::new();
    while let Some(joint) = model.joints.iter().position(|joint| joint.child_body == body) {
        chain.insert(0, joint);
        body = model.joints[joint].parent_body;
    }
    chain
}

/// `root` and all joints behind it, parents first.
fn subtree(model: &RobotModel, root: usize) -> Vec<usize> {
    let mut tree = vec![root];
    let mut next = 0;
    while next < tree.len() {
        let body = model.joints[tree[next]].child_body;
        tree.extend((0..model.joints.len()).filter(|&i| model.joints[i].parent_body == body));
        next += 1;
    }
    tree
}

/// The robot's bodies in the engine.
pub(super) struct RobotBody {
    pub working: Articulation,
    pub idle: Option<Articulation>,
    /// The engine's body of each model body.
    pub bodies: Vec<RigidBodyHandle>,
}

impl RobotBody {
    /// Builds `model` with the working tree at `working_q` and the idle one at `idle_q`; its base frame is the world's frame, and
    /// `finger_friction` the coefficient of friction of its fingers.
    pub(super) fn new(
        engine: &mut PhysicsWorld,
        model: &RobotModel,
        limbs: &Limbs,
        (working_q, idle_q): (&[f64], &[f64]),
        finger_friction: f64,
        parts: &mut Parts,
    ) -> Result<Self, WorldError> {
        let base = Isometry3::identity();
        let missing = || WorldError::Robot { robot: model.name.clone(), what: "arm".into(), help: "check the joints of the URDF".into() };
        let working = Articulation::new(engine, model, &limbs.working, working_q, &base).ok_or_else(missing)?;
        let idle = Articulation::new(engine, model, &limbs.idle, idle_q, &base);
        let mut bodies = vec![None; model.bodies.len()];
        for drive in working.drives.iter().chain(idle.iter().flat_map(|arm| &arm.drives)) {
            bodies[model.joints[drive.joint].child_body] = Some(drive.link);
        }
        let poses = home_poses(model);
        let bodies: Vec<_> = (0..model.bodies.len())
            .map(|i| bodies[i].unwrap_or_else(|| engine.insert_body(RigidBodyBuilder::fixed().pose(convert::pose(&poses[i])))))
            .collect();
        let robot = Self { working, idle, bodies };
        robot.insert_colliders(engine, model, limbs, finger_friction, parts)?;
        Ok(robot)
    }

    fn insert_colliders(
        &self,
        engine: &mut PhysicsWorld,
        model: &RobotModel,
        limbs: &Limbs,
        finger_friction: f64,
        parts: &mut Parts,
    ) -> Result<(), WorldError> {
        for (index, body) in model.bodies.iter().enumerate() {
            let depth_in = |tree: &[usize]| tree.iter().position(|&joint| model.joints[joint].child_body == index);
            let (working, idle) = (depth_in(&limbs.working), depth_in(&limbs.idle));
            let finger = working.is_some_and(|place| limbs.fingers.contains(&place));
            let layer = match working.or(idle) {
                None => Layer::RobotFixed,
                Some(depth) if depth < PROXIMAL_LINKS => Layer::ArmProximal,
                Some(_) => Layer::ArmDistal,
            };
            let limb = match (working, idle) {
                (Some(_), _) => Limb::Working,
                (None, Some(_)) => Limb::Idle,
                (None, None) => Limb::Fixed,
            };
            for geometry in &body.collisions {
                let owner = Owner::Robot { body: index, finger: finger || geometry.link == limbs.tool_link, limb };
                let id = parts.add(Part { name: geometry.link.clone(), owner, handle: false });
                let (shape, turn) = engine_shape(&geometry.shape, &geometry.link, limb)?;
                let collider = ColliderBuilder::new(shape)
                    .position(convert::pose(&(geometry.body_from_geometry * turn)))
                    .mass_properties(MassProperties::new(Vector::ZERO, 0.0, Vector::ZERO))
                    .friction(if finger { finger_friction } else { LINK_FRICTION })
                    .collision_groups(layer.groups())
                    .user_data(id as u128);
                engine.insert_collider(collider, Some(self.bodies[index]));
            }
        }
        Ok(())
    }

    /// `world_from_body` of every model body.
    pub(super) fn poses(&self, engine: &PhysicsWorld, poses: &mut Vec<Isometry3<f64>>) {
        poses.clear();
        poses.extend(
            self.bodies
                .iter()
                .map(|&handle| engine.bodies.get(handle).map_or_else(Isometry3::identity, |b| convert::pose_back(b.position()))),
        );
    }

    /// The engine's own mass matrix of the working tree.
    pub(super) fn mass_matrix(&self, engine: &PhysicsWorld) -> Option<DMatrix<f64>> {
        self.working.mass_matrix(engine)
    }
}

/// Poses of all bodies with every joint at zero, or at its nearest limit.
fn home_poses(model: &RobotModel) -> Vec<Isometry3<f64>> {
    let mut poses = vec![Isometry3::identity(); model.bodies.len()];
    for joint in &model.joints {
        let q = 0.0_f64.max(joint.lower).min(joint.upper);
        let motion = match joint.kind {
            JointKind::Prismatic => Isometry3::from_parts(Translation3::from(joint.axis.into_inner() * q), UnitQuaternion::identity()),
            _ => Isometry3::from_parts(Translation3::identity(), UnitQuaternion::from_axis_angle(&joint.axis, q)),
        };
        poses[joint.child_body] = poses[joint.parent_body] * joint.parent_from_joint * motion;
    }
    poses
}

/// The engine's shape, and how it lies in the URDF's frame (the engine's cylinders stand along y). A mesh that does not move keeps its
/// hollows; one that moves is its convex hull, which has an inside.
fn engine_shape(shape: &Shape, link: &str, limb: Limb) -> Result<(SharedShape, Isometry3<f64>), WorldError> {
    let upright = Isometry3::identity();
    Ok(match shape {
        Shape::Box { half_extents } => (SharedShape::cuboid(half_extents.x, half_extents.y, half_extents.z), upright),
        Shape::Sphere { radius } => (SharedShape::ball(*radius), upright),
        Shape::Cylinder { radius, half_length } => {
            let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::FRAC_PI_2);
            (SharedShape::cylinder(*half_length, *radius), Isometry3::from_parts(Translation3::identity(), turn))
        }
        Shape::Mesh { vertices, triangles } => {
            let points: Vec<Vector> = vertices.iter().map(|v| Vector::new(v[0], v[1], v[2])).collect();
            let shape = match limb {
                Limb::Fixed => SharedShape::trimesh(points, triangles.clone()).ok(),
                Limb::Working | Limb::Idle => SharedShape::convex_hull(&points),
            };
            let shape = shape.ok_or_else(|| WorldError::Geometry { part: link.into(), reason: "its mesh has no volume".into() })?;
            (shape, upright)
        }
    })
}
