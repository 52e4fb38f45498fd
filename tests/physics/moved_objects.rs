//! What an object touches that moves and is held by nobody, against closed forms: other objects, a door, either arm.

use cpdmp::robot::{LoadOptions, RobotModel, parse};
use cpdmp::world::{
    Cabinet, ContactEpisode, Grip, KinematicScene, Object, ObjectKind, Parameters, Permission, PhysicsSettings, Placement, Quantity,
    RESOLUTION_M, Solid, WorldSettings, door_turn,
};
use nalgebra::{Isometry3, Vector2, Vector3};

use super::collisions::{LANCE, wall};
use crate::support::{LEFT_POSTURE, baxter, object, world};

const IDLE_POSTURE: [f64; 7] = [0.6, -0.6, 0.0, 1.6, 0.0, 0.6, 0.0];

/// A scene in which the working arm stands still and objects are put where `moments` say (s, `world_from_object` of each).
fn carried(
    robot: &RobotModel,
    (tool, grasp, idle_tool): (&str, &str, Option<&str>),
    arm_rad: &[f64],
    objects: &[Object],
    moments: &[(f64, Vec<Isometry3<f64>>)],
) -> KinematicScene {
    let mut scene = KinematicScene::new(&WorldSettings {
        physics: &PhysicsSettings::default(),
        robot,
        tool,
        grasp,
        posture_rad: arm_rad,
        idle_tool,
        idle_posture_rad: if idle_tool.is_some() { &IDLE_POSTURE } else { &[] },
        dry_friction_nm: 0.0,
        finger_friction: 1.0,
        objects,
        parameters: &Parameters::default(),
        watch: false,
    })
    .expect("the scene is built");
    for (time_s, objects) in moments {
        scene.place(&Placement { time_s: *time_s, arm_rad, gripper: 1.0, objects: Some(objects) });
    }
    scene
}

fn lance() -> RobotModel {
    parse(LANCE, "lance.urdf", &LoadOptions::default()).expect("a valid robot").model
}

fn parcel() -> Object {
    let body = Solid { mass_kg: 1.0.into(), friction: 0.5.into(), fixed: false };
    object("parcel", [3.0, 3.0], ObjectKind::Box { size_m: Vector3::new(0.02, 0.02, 0.02), body })
}

fn at(x: f64, y: f64, z: f64) -> Isometry3<f64> {
    Isometry3::translation(x, y, z)
}

fn found<'a>(contacts: &'a [ContactEpisode], a: &str, b: &str) -> &'a ContactEpisode {
    contacts.iter().find(|contact| contact.a == a && contact.b == b).unwrap_or_else(|| panic!("no {a} - {b} in {contacts:#?}"))
}

/// Contract: a box of 2 cm that nobody holds and that goes at 2 m/s through a sheet of 0.5 mm between two moments is found, at the times and with
/// the depth of the closed form. Objects may touch each other; their distance is not the robot's.
#[test]
fn an_object_that_nobody_holds_is_found_where_it_passes_through_another() {
    let half_m = 0.01 + 0.25e-3;
    let objects = [wall("sheet", [0.5, 0.5], 0.2, 0.5e-3), parcel()];
    let sheet = at(0.5, 0.5, 0.0);
    let moments = [(0.0, vec![sheet, at(0.5, 0.3, 0.1)]), (0.2, vec![sheet, at(0.5, 0.7, 0.1)])];
    let scene = carried(&lance(), ("tip", "lance", None), &[1.5], &objects, &moments);
    let [contact] = scene.contacts() else { panic!("one contact: {:#?}", scene.contacts()) };
    assert_eq!((contact.a.as_str(), contact.b.as_str(), &contact.permission), ("parcel", "sheet.base", &Some(Permission::Objects)));
    assert!((contact.first_time_s - (0.2 - half_m) / 2.0).abs() < 1e-7, "{contact:?}");
    assert!((contact.last_time_s - (0.2 + half_m) / 2.0).abs() < 1e-7, "{contact:?}");
    assert!((contact.max_depth_m - half_m).abs() <= RESOLUTION_M && contact.max_force_n.is_nan(), "{contact:?}");
    let told = scene.clearances().iter().filter(|clearance| clearance.min_distance_m.is_finite());
    assert!(told.clone().count() > 0 && told.clone().all(|clearance| clearance.a == "lance"), "{:#?}", told.collect::<Vec<_>>());
}

/// Contract: an object that lies where it is, on something, is a contact that is allowed, from first to last.
#[test]
fn what_rests_is_one_allowed_contact() {
    let objects = [wall("stand", [0.5, 0.5], 0.2, 0.1), parcel()];
    let moments: Vec<_> = (0..50).map(|k| (0.02 * f64::from(k), vec![at(0.5, 0.5, 0.0), at(0.5, 0.5, 0.21)])).collect();
    let scene = carried(&lance(), ("tip", "lance", None), &[1.5], &objects, &moments);
    let [contact] = scene.contacts() else { panic!("one contact: {:#?}", scene.contacts()) };
    assert!(contact.allowed && contact.first_time_s == 0.0 && contact.last_time_s == 0.98, "{contact:?}");
}

/// Contract: a door that opens against an arm that stands still is found when its face has turned to the arm.
#[test]
fn a_door_that_opens_against_the_arm_is_found() {
    let cabinet = Cabinet {
        door_size_m: Vector2::new(0.4, 0.4),
        bottom_height_m: -0.1,
        depth_m: 0.3,
        mass_kg: 3.0.into(),
        friction_nm: 0.3.into(),
        damping_nms_per_rad: 0.5,
        seal_nm_per_rad: 20.0,
        seal_travel_rad: 0.05,
        opening_max_rad: 1.2,
        handles: 1,
        first_handle_m: 0.05,
        handle_spacing_m: 0.05,
        handle_lateral_m: Quantity::Value(0.15),
        handle_length_m: 0.1,
        handle_radius_m: 0.006,
        handle_standoff_m: 0.04,
        grip: Grip::Contact,
    };
    let objects = [object("cabinet", [1.1, 0.2], ObjectKind::Cabinet(cabinet))];
    // The lance's ball of 1 mm is at [1, 0, 0.1]: 0.1 m before the closed door, 0.2 m beside its hinge.
    let hinge = objects[0].pose(&Parameters::default(), 0.0).translation;
    let moments: Vec<_> =
        (0..=90).map(|k| 0.01 * f64::from(k)).map(|opening| (opening, vec![Isometry3::from_parts(hinge, door_turn(opening))])).collect();
    let scene = carried(&lance(), ("tip", "lance", None), &[0.0], &objects, &moments);
    let contact = found(scene.contacts(), "lance", "cabinet.door");
    let touched = (0.1_f64 / 0.2).atan() - (1e-3 / 0.1_f64.hypot(0.2)).asin();
    assert!(!contact.allowed && (contact.first_time_s - touched).abs() < 1e-4, "{touched} {contact:?}");
}

/// Contract: an object that meets the arm that does not work is found, and refused like one that meets the other arm.
#[test]
fn an_object_that_meets_the_idle_arm_is_found() {
    let robot = baxter();
    let mut poses = Vec::new();
    world(&robot, &LEFT_POSTURE, &[], [0.0; 3], 0.0).robot_poses(&mut poses);
    let hand = robot.frame("right_hand").expect("a hand");
    let place = (poses[hand.body] * hand.body_from_frame).translation.vector;
    let links = ("left_gripper_tool", "left_hand", Some("right_hand"));
    for (aside_m, meets) in [(0.0, true), (0.5, false)] {
        let from_to = [-0.6, 0.6].map(|z| at(place.x + aside_m, place.y, place.z + z));
        let moments = [(0.0, vec![from_to[0]]), (0.4, vec![from_to[1]])];
        let scene = carried(&robot, links, &LEFT_POSTURE, &[parcel()], &moments);
        let right: Vec<_> = scene.contacts().iter().filter(|contact| contact.a.starts_with("right_")).collect();
        assert_eq!(!right.is_empty(), meets, "{right:#?}");
        assert!(right.iter().all(|contact| !contact.allowed && contact.b == "parcel"), "{right:#?}");
    }
}
