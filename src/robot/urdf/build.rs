//! From links and joints, already checked, to bodies: links on fixed joints are lumped into the body that carries them.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Isometry3, Matrix3, Unit, UnitQuaternion, Vector3};
use urdf_rs::{JointType, Robot};

use super::super::lump::Inertia;
use super::super::model::{Body, Frame, Joint, JointKind, Mimic, RobotModel};
use super::finding::Findings;
use super::outline::{LinkEntry, Outline};
use super::shapes::Shapes;

/// The model, parents before children and children in file order. Nothing if the content is not what the outline says.
pub(super) fn build(
    robot: &Robot,
    outline: &Outline,
    package_directories: &[std::path::PathBuf],
    findings: &mut Findings,
) -> Option<RobotModel> {
    let tree = Tree::new(robot, outline);
    let mut shapes = Shapes::new(package_directories, findings);
    let mut model = RobotModel { name: robot.name.clone(), bodies: Vec::new(), joints: Vec::new(), frames: Vec::new() };
    let mut inertias: Vec<Inertia> = Vec::new();
    let mut open = vec![Pending { link: tree.root?, carrier: Carrier::Root, body_from_link: Isometry3::identity() }];
    while let Some(Pending { link: name, carrier, body_from_link }) = open.pop() {
        let (link, entry) = (tree.links.get(name)?, tree.entries.get(name)?);
        let body = match carrier {
            Carrier::Fixed(body) => body,
            Carrier::Root | Carrier::Moving(_) => {
                model.bodies.push(massless_body(name));
                inertias.push(Inertia::ZERO);
                model.bodies.len() - 1
            }
        };
        if let Carrier::Moving(joint) = carrier {
            model.joints.push(Joint { child_body: body, ..*joint });
        }
        inertias[body] = inertias[body].plus(&inertia_of(&link.inertial).transformed(&body_from_link));
        shapes.add(link, entry, &body_from_link, &mut model.bodies[body]);
        model.frames.push(Frame { name: name.to_owned(), body, body_from_frame: body_from_link });
        let hanging = tree.children.get(name).into_iter().flatten().rev();
        open.extend(hanging.map(|joint| Pending::behind(joint, body, &body_from_link)));
    }
    for (body, inertia) in model.bodies.iter_mut().zip(&inertias) {
        (body.mass_kg, body.center_of_mass, body.inertia) = (inertia.mass, inertia.center, inertia.about_center);
    }
    resolve_mimics(robot, &mut model)?;
    require_masses(&model, &tree.entries, findings);
    warn_of_ghosts(&model, &tree.entries, findings);
    Some(model)
}

/// Links and joints by name.
struct Tree<'a> {
    root: Option<&'a str>,
    links: BTreeMap<&'a str, &'a urdf_rs::Link>,
    entries: BTreeMap<&'a str, &'a LinkEntry>,
    children: BTreeMap<&'a str, Vec<&'a urdf_rs::Joint>>,
}

impl<'a> Tree<'a> {
    fn new(robot: &'a Robot, outline: &'a Outline) -> Self {
        let carried: BTreeSet<&str> = robot.joints.iter().map(|joint| joint.child.link.as_str()).collect();
        let mut children: BTreeMap<&str, Vec<&urdf_rs::Joint>> = BTreeMap::new();
        for joint in &robot.joints {
            children.entry(&joint.parent.link).or_default().push(joint);
        }
        let mut names = robot.links.iter().map(|link| link.name.as_str());
        Self {
            root: names.find(|name| !carried.contains(name)),
            links: robot.links.iter().map(|link| (link.name.as_str(), link)).collect(),
            entries: outline.links.iter().map(|entry| (entry.name.as_str(), entry)).collect(),
            children,
        }
    }
}

/// A link still to be placed.
struct Pending<'a> {
    link: &'a str,
    carrier: Carrier,
    body_from_link: Isometry3<f64>,
}

/// What carries a link.
enum Carrier {
    Root,
    Fixed(usize),
    Moving(Box<Joint>),
}

impl<'a> Pending<'a> {
    /// The link behind `joint`, which hangs on a link of body `parent_body`.
    fn behind(joint: &'a urdf_rs::Joint, parent_body: usize, body_from_parent: &Isometry3<f64>) -> Self {
        let parent_from_joint = body_from_parent * pose(&joint.origin);
        let kind = match joint.joint_type {
            JointType::Revolute => Some(JointKind::Revolute),
            JointType::Continuous => Some(JointKind::Continuous),
            JointType::Prismatic => Some(JointKind::Prismatic),
            _ => None,
        };
        let (carrier, body_from_link) = match kind {
            Some(kind) => {
                let moving = moving_joint(joint, kind, parent_body, parent_from_joint);
                (Carrier::Moving(Box::new(moving)), Isometry3::identity())
            }
            None => (Carrier::Fixed(parent_body), parent_from_joint),
        };
        Self { link: &joint.child.link, carrier, body_from_link }
    }
}

fn moving_joint(joint: &urdf_rs::Joint, kind: JointKind, parent_body: usize, parent_from_joint: Isometry3<f64>) -> Joint {
    let limit = &joint.limit;
    let endless = kind == JointKind::Continuous;
    // A continuous joint may leave its limits out; urdf-rs reads that as zeros.
    let unless_absent = |value: f64| if endless && *limit == Default::default() { f64::INFINITY } else { value };
    let dynamics = joint.dynamics.as_ref();
    Joint {
        name: joint.name.clone(),
        kind,
        parent_body,
        child_body: 0,
        parent_from_joint,
        axis: Unit::new_normalize(Vector3::from(joint.axis.xyz.0)),
        lower: if endless { f64::NEG_INFINITY } else { limit.lower },
        upper: if endless { f64::INFINITY } else { limit.upper },
        velocity_limit: unless_absent(limit.velocity),
        effort_limit: unless_absent(limit.effort),
        damping: dynamics.map_or(0.0, |dynamics| dynamics.damping),
        friction: dynamics.map_or(0.0, |dynamics| dynamics.friction),
        mimic: None,
    }
}

fn massless_body(name: &str) -> Body {
    Body {
        name: name.to_owned(),
        mass_kg: 0.0,
        center_of_mass: Vector3::zeros(),
        inertia: Matrix3::zeros(),
        collisions: Vec::new(),
        visuals: Vec::new(),
    }
}

fn inertia_of(inertial: &urdf_rs::Inertial) -> Inertia {
    let urdf_rs::Inertia { ixx, ixy, ixz, iyy, iyz, izz } = inertial.inertia;
    let about_center = Matrix3::new(ixx, ixy, ixz, ixy, iyy, iyz, ixz, iyz, izz);
    let part = Inertia { mass: inertial.mass.value, center: Vector3::zeros(), about_center };
    part.transformed(&pose(&inertial.origin))
}

/// URDF: fixed-axis roll, pitch, yaw, that is Rz(yaw) Ry(pitch) Rx(roll).
pub(super) fn pose(origin: &urdf_rs::Pose) -> Isometry3<f64> {
    let [roll, pitch, yaw] = origin.rpy.0;
    let rotation = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
    Isometry3::from_parts(Vector3::from(origin.xyz.0).into(), rotation)
}

fn resolve_mimics(robot: &Robot, model: &mut RobotModel) -> Option<()> {
    for joint in &robot.joints {
        if let (Some(mimic), Some(follower)) = (&joint.mimic, model.joint_index(&joint.name)) {
            model.joints[follower].mimic = Some(Mimic {
                joint: model.joint_index(&mimic.joint)?,
                multiplier: mimic.multiplier.unwrap_or(1.0),
                offset: mimic.offset.unwrap_or(0.0),
            });
        }
    }
    Some(())
}

/// What can be seen but not touched passes through everything.
fn warn_of_ghosts(model: &RobotModel, entries: &BTreeMap<&str, &LinkEntry>, findings: &mut Findings) {
    let file_of = |link: &str| entries.get(link).map(|entry| &entry.place.file);
    if let Some(root) = entries.get(model.bodies[0].name.as_str()) {
        // A tool that is mounted on it is a file of its own.
        let mut touched = model.bodies.iter().flat_map(|body| &body.collisions);
        if !touched.any(|shape| file_of(&shape.link) == Some(&root.place.file)) {
            findings.warning(&root.place, "robot", "no link of it can touch anything", "give its links a <collision>");
        }
    }
    for joint in &model.joints {
        let body = &model.bodies[joint.child_body];
        if let Some(entry) = entries.get(body.name.as_str())
            && body.collisions.is_empty()
            && !body.visuals.is_empty()
        {
            let message = format!("moves on joint `{}`, but neither it nor what is fixed to it can touch anything", joint.name);
            findings.warning(&entry.place, format!("link `{}`", body.name), message, "give it a <collision>");
        }
    }
}

fn require_masses(model: &RobotModel, entries: &BTreeMap<&str, &LinkEntry>, findings: &mut Findings) {
    for joint in &model.joints {
        let body = &model.bodies[joint.child_body];
        if let Some(entry) = entries.get(body.name.as_str())
            && body.mass_kg <= 0.0
        {
            let message = format!("moves on joint `{}`, but neither it nor what is fixed to it has mass", joint.name);
            findings.error(&entry.place, format!("link `{}`", body.name), message, "give it an <inertial>");
        }
    }
}
