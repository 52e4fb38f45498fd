//! What touches what, when and how deep: movements judged by geometry and runs of the engine, against closed forms and brute force.

use cpdmp::robot::{LoadOptions, RobotModel, Shape, parse};
use cpdmp::world::{
    Clearance, ContactEpisode, KinematicScene, NEAR_M, Object, ObjectKind, Parameters, PartShape, PhysicsSettings, Placement, Quantity,
    RESOLUTION_M, WorldSettings, object_parts,
};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use parry3d_f64::math::{Pose, Rotation, Vector};
use parry3d_f64::query;
use parry3d_f64::shape::{Ball, Capsule, Cuboid, Cylinder, Shape as ParryShape};

use crate::support::{LEFT_POSTURE, baxter, object};

/// A ball of 1 mm on an arm of 1 m that turns about the vertical, 0.1 m above the floor.
pub const LANCE: &str = r#"<robot name="lance">
  <link name="base"/>
  <link name="lance"><inertial><mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
    <collision><origin xyz="1 0 0"/><geometry><sphere radius="0.001"/></geometry></collision></link>
  <link name="tip"/>
  <joint name="turn" type="continuous"><parent link="base"/><child link="lance"/><origin xyz="0 0 0.1"/><axis xyz="0 0 1"/>
    <limit effort="100" velocity="100"/></joint>
  <joint name="end" type="fixed"><parent link="lance"/><child link="tip"/><origin xyz="1 0 0"/></joint>
</robot>"#;

pub fn wall(name: &str, center: [f64; 2], height_m: f64, thickness_m: f64) -> Object {
    let kind = ObjectKind::UBlock {
        base_height_m: Quantity::Value(height_m),
        aperture_m: 0.1,
        post_height_m: 0.05,
        post_width_m: 0.03,
        thickness_m,
        friction: Quantity::Value(0.5),
    };
    object(name, center, kind)
}

/// Moves a robot through a scene: contacts and clearances.
fn moved(
    robot: &RobotModel,
    (tool, grasp): (&str, &str),
    objects: &[Object],
    way: &[(f64, Vec<f64>)],
) -> (Vec<ContactEpisode>, Vec<Clearance>) {
    let mut scene = KinematicScene::new(&WorldSettings {
        physics: &PhysicsSettings::default(),
        robot,
        tool,
        grasp,
        posture_rad: &way[0].1,
        idle_tool: None,
        idle_posture_rad: &[],
        dry_friction_nm: 0.0,
        finger_friction: 1.0,
        objects,
        parameters: &Parameters::default(),
        watch: false,
    })
    .expect("the scene is built");
    for (time_s, arm_rad) in way {
        scene.place(&Placement { time_s: *time_s, arm_rad, gripper: 1.0, objects: None });
    }
    (scene.contacts().to_vec(), scene.clearances().to_vec())
}

/// Contract: a sheet of 0.5 mm that is crossed at 2 m/s between two samples that are both 10 cm and more away from it is found, at the times and
/// with the depth of the closed form.
#[test]
fn a_thin_sheet_is_found_between_two_samples() {
    let robot = parse(LANCE, "lance.urdf", &LoadOptions::default()).expect("a valid robot").model;
    let (speed, sheet_y, half) = (2.0, 0.1_f64, 0.25e-3);
    let way = [(0.0, vec![-0.05]), (0.15, vec![0.25])];
    let (contacts, clearances) = moved(&robot, ("tip", "lance"), &[wall("sheet", [1.0, sheet_y], 0.2, 2.0 * half)], &way);
    let [contact] = &contacts[..] else { panic!("one contact: {contacts:?}") };
    assert_eq!((contact.a.as_str(), contact.b.as_str(), contact.allowed), ("lance", "sheet.base", false));
    let time = |y: f64| (y.asin() + 0.05) / speed;
    let (first, last) = (time(sheet_y - half - 1e-3), time(sheet_y + half + 1e-3));
    assert!((contact.first_time_s - first).abs() < 1e-7, "{} instead of {first}", contact.first_time_s);
    assert!((contact.last_time_s - last).abs() < 1e-7, "{} instead of {last}", contact.last_time_s);
    assert!((contact.max_depth_m - (half + 1e-3)).abs() <= RESOLUTION_M, "{}", contact.max_depth_m);
    assert!((contact.deepest_point.y - sheet_y).abs() < 1e-3 && (contact.deepest_point.z - 0.1).abs() < 1e-9);
    assert_eq!(clearances[0].min_distance_m, 0.0);
}

/// Contract: what only comes near is told with its distance, time and points, though no sample is nearer than 10 cm.
#[test]
fn the_smallest_distance_is_found_between_two_samples() {
    let robot = parse(LANCE, "lance.urdf", &LoadOptions::default()).expect("a valid robot").model;
    // The ball passes over the base at 0.08 m, between the posts.
    let way = [(0.0, vec![-0.15]), (1.0, vec![0.15])];
    let (contacts, clearances) = moved(&robot, ("tip", "lance"), &[wall("gate", [1.0, 0.0], 0.08, 0.01)], &way);
    assert!(contacts.is_empty(), "{contacts:?}");
    let nearest = &clearances[0];
    assert!((nearest.min_distance_m - 0.019).abs() <= RESOLUTION_M, "{nearest:?}");
    assert!((nearest.time_s - 0.5).abs() < 0.02, "over the base's 10 mm: {nearest:?}");
    assert!((nearest.point_a.z - 0.099).abs() < 1e-4 && (nearest.point_b.z - 0.08).abs() < 1e-9);
}

/// By how much a distance may differ from the truth (m): 0.1 mm when it is near, 2 % beyond.
pub fn allowed_m(truth_m: f64) -> f64 {
    if truth_m < NEAR_M { 1e-4 } else { 0.021 * truth_m }
}

/// A shape of the scene with its name and place.
pub struct Piece {
    name: String,
    shape: Box<dyn ParryShape>,
    world_from_piece: Pose,
}

fn pose(t: &Isometry3<f64>) -> Pose {
    let (p, q) = (t.translation.vector, t.rotation.coords);
    Pose::from_parts(Vector::new(p.x, p.y, p.z), Rotation::from_xyzw(q.x, q.y, q.z, q.w))
}

/// Everything that can be hit, from the description of the objects.
pub fn pieces(objects: &[Object], parameters: &Parameters, support_height_m: f64) -> Vec<Piece> {
    let of_object = |object: &Object| {
        let world_from_object = object.pose(parameters, support_height_m);
        let piece = |part: cpdmp::world::ObjectPart| {
            let shape: Box<dyn ParryShape> = match part.shape {
                PartShape::Box(half) => Box::new(Cuboid::new(Vector::new(half.x, half.y, half.z))),
                PartShape::Ball(radius) => Box::new(Ball::new(radius)),
                PartShape::Capsule(radius, height) => Box::new(Capsule::new_z(height / 2.0, radius)),
                PartShape::Cylinder(..) => panic!("the scenes of these tests have none"),
            };
            let name = if part.name.is_empty() { object.name.clone() } else { format!("{}.{}", object.name, part.name) };
            Piece { name, shape, world_from_piece: pose(&(world_from_object * part.object_from_part)) }
        };
        object_parts(object, parameters).into_iter().map(piece).collect::<Vec<_>>()
    };
    objects.iter().flat_map(of_object).collect()
}

/// A shape of a link on the body that carries it.
struct Link {
    name: String,
    body: usize,
    shape: Box<dyn ParryShape>,
    body_from_shape: Isometry3<f64>,
}

/// The shapes of the robot's links on bodies that move.
fn links(robot: &RobotModel, moves: impl Fn(usize) -> bool) -> Vec<Link> {
    let mut links = Vec::new();
    for (index, body) in robot.bodies.iter().enumerate().filter(|(index, _)| moves(*index)) {
        for geometry in &body.collisions {
            let about_x = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::FRAC_PI_2);
            let (shape, turn): (Box<dyn ParryShape>, _) = match &geometry.shape {
                Shape::Box { half_extents: h } => (Box::new(Cuboid::new(Vector::new(h.x, h.y, h.z))), UnitQuaternion::identity()),
                Shape::Sphere { radius } => (Box::new(Ball::new(*radius)), UnitQuaternion::identity()),
                Shape::Cylinder { radius, half_length } => (Box::new(Cylinder::new(*half_length, *radius)), about_x),
                Shape::Mesh { .. } => panic!("the built-in robot has no meshes"),
            };
            let turn = Isometry3::from_parts(Translation3::identity(), turn);
            let (name, body_from_shape) = (geometry.link.clone(), geometry.body_from_geometry * turn);
            links.push(Link { name, body: index, shape, body_from_shape });
        }
    }
    links
}

/// What brute force knows about a pair of a link and a part.
#[derive(Debug)]
pub struct Brute {
    pub link: String,
    pub part: String,
    pub least_m: f64,
    pub time_s: f64,
    pub point: Point3<f64>,
    pub touch_s: Option<(f64, f64)>,
}

/// Distances of all pairs at all moments, by the geometry library alone; what is nearer than `touch_m` (m) touches.
pub fn brute_force(
    robot: &RobotModel,
    moves: impl Fn(usize) -> bool,
    pieces: &[Piece],
    moments: &[(f64, Vec<Isometry3<f64>>)],
    touch_m: f64,
) -> Vec<Brute> {
    let mut all: Vec<Brute> = Vec::new();
    for Link { name: link, body, shape, body_from_shape } in links(robot, moves) {
        for piece in pieces {
            let place = all.iter().position(|one| one.link == link && one.part == piece.name).unwrap_or_else(|| {
                let (link, part) = (link.clone(), piece.name.clone());
                all.push(Brute { link, part, least_m: f64::INFINITY, time_s: 0.0, point: Point3::origin(), touch_s: None });
                all.len() - 1
            });
            let known = &mut all[place];
            for (time_s, bodies) in moments {
                let at = pose(&(bodies[body] * body_from_shape));
                let contact = query::contact(&at, &*shape, &piece.world_from_piece, &*piece.shape, 1.0).expect("known shapes");
                let Some(contact) = contact else { continue };
                if contact.dist < known.least_m {
                    let middle = (contact.point1 + contact.point2) * 0.5;
                    (known.least_m, known.time_s, known.point) = (contact.dist, *time_s, Point3::new(middle.x, middle.y, middle.z));
                }
                if contact.dist <= touch_m {
                    let (first, last) = known.touch_s.unwrap_or((*time_s, *time_s));
                    known.touch_s = Some((first.min(*time_s), last.max(*time_s)));
                }
            }
        }
    }
    all
}

/// `world_from_body` of every body of the robot with the left arm at `q` and open fingers, joint by joint.
fn postures(robot: &RobotModel, arm: &[usize], q: &[f64]) -> Vec<Isometry3<f64>> {
    let mut positions: Vec<f64> = robot.joints.iter().map(|joint| if joint.upper.is_finite() { joint.upper } else { 0.0 }).collect();
    arm.iter().zip(q).for_each(|(&joint, &angle)| positions[joint] = angle);
    let mut poses = vec![Isometry3::identity(); robot.bodies.len()];
    for (index, joint) in robot.joints.iter().enumerate() {
        poses[joint.child_body] = poses[joint.parent_body] * joint.parent_from_child(robot.position_of(index, &positions));
    }
    poses
}

/// Contract: a swing of the whole arm between two samples gives for every pair of a link and a part what 20 000 samples in between give:
/// times to a sample, depths and distances to 0.1 mm.
#[test]
fn a_swing_of_the_arm_agrees_with_brute_force() {
    let robot = baxter();
    let arm: Vec<usize> = ["s0", "s1", "e0", "e1", "w0", "w1", "w2"]
        .iter()
        .map(|name| robot.joint_index(&format!("left_{name}")).expect("a joint of the left arm"))
        .collect();
    let (from, to): (Vec<f64>, Vec<f64>) = LEFT_POSTURE.iter().map(|q| (q - 0.35, q + 0.25)).unzip();
    let lerp = |f: f64| from.iter().zip(&to).map(|(a, b)| a + f * (b - a)).collect::<Vec<f64>>();
    let objects = [wall("near", [0.65, 0.13], 0.3, 0.5e-3), wall("far", [0.45, 0.6], 0.3, 0.05)];
    let (contacts, clearances) = moved(&robot, ("left_gripper_tool", "left_hand"), &objects, &[(0.0, from.clone()), (1.0, to.clone())]);

    let samples = 20_000;
    let moments: Vec<(f64, Vec<Isometry3<f64>>)> =
        (0..=samples).map(|i| f64::from(i) / f64::from(samples)).map(|f| (f, postures(&robot, &arm, &lerp(f)))).collect();
    let left = |body: usize| body > 0 && robot.joints.iter().any(|j| j.child_body == body && j.name.starts_with("left"));
    let brute = brute_force(&robot, left, &pieces(&objects, &Parameters::default(), 0.0), &moments, 0.0);

    let touching: Vec<&Brute> = brute.iter().filter(|one| one.touch_s.is_some()).collect();
    println!("{} pairs touch of {}", touching.len(), brute.len());
    assert!(touching.len() >= 2, "the swing is meant to hit something");
    assert_eq!(contacts.len(), touching.len(), "{contacts:#?}\n{touching:#?}");
    for one in touching {
        let found = contacts.iter().find(|c| c.a == one.link && c.b == one.part).unwrap_or_else(|| panic!("{one:?} is missing"));
        let (first, last) = one.touch_s.expect("it touches");
        let sample = 1.5 / f64::from(samples);
        assert!((found.first_time_s - first).abs() < sample && (found.last_time_s - last).abs() < sample, "{found:?} {one:?}");
        assert!((found.max_depth_m + one.least_m).abs() < 1e-4, "{found:?} {one:?}");
    }
    for clearance in clearances.iter().filter(|c| c.min_distance_m > 0.0 && objects.iter().any(|object| object.name == c.b)) {
        let of_pair = brute.iter().filter(|one| one.link == clearance.a && one.part.starts_with(&clearance.b));
        let truth = of_pair.map(|one| one.least_m).fold(f64::INFINITY, f64::min);
        assert!((clearance.min_distance_m - truth).abs() < allowed_m(truth), "{clearance:?} {truth}");
    }
}
