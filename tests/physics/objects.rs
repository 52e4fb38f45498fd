//! The library of objects: what a scenario says of an object is what the engine does with it.

use cpdmp::world::{Object, ObjectKind, Quantity, Solid, World};
use nalgebra::{Vector2, Vector3};

use crate::support::{LEFT_POSTURE, baxter, object, table, world};

const G: f64 = 9.81;

fn solid(mass_kg: f64, fixed: bool) -> Solid {
    Solid { mass_kg: mass_kg.into(), friction: 0.5.into(), fixed }
}

fn raised(object: Object, raised_m: f64) -> Object {
    Object { raised_m: Quantity::Value(raised_m), ..object }
}

/// The world with these objects on a table of height -0.18 m, away from the arms, after `seconds`.
fn after(seconds: f64, mut objects: Vec<Object>) -> World {
    objects.insert(0, table(0.5));
    let mut world = world(&baxter(), &LEFT_POSTURE, &objects, [0.0, 0.0, -G], 0.0);
    for _ in 0..(seconds * 1e3) as usize {
        world.advance().expect("finite");
    }
    world
}

#[test]
fn a_plate_sinks_by_weight_over_stiffness() {
    let (stiffness, mass) = (1000.0, 0.5);
    let plate = ObjectKind::SpringPlate {
        size_m: Vector3::new(0.2, 0.2, 0.02),
        travel_m: 0.03,
        stiffness_n_per_m: stiffness.into(),
        damping_ns_per_m: 20.0,
        mass_kg: 0.2.into(),
        friction: 0.5.into(),
    };
    let weight = ObjectKind::Box { size_m: Vector3::new(0.06, 0.06, 0.06), body: solid(mass, false) };
    let alone = after(1.0, vec![object("plate", [3.0, 0.0], plate.clone())]);
    let rest = alone.object_pose(1).translation.z;
    assert!((rest - (-0.18 + 0.03 + 0.01)).abs() < 1e-5, "its spring carries the plate: {rest} m");
    let loaded = after(2.0, vec![object("plate", [3.0, 0.0], plate), raised(object("weight", [3.0, 0.0], weight), 0.0501)]);
    let sunk = rest - loaded.object_pose(1).translation.z;
    assert!((sunk - mass * G / stiffness).abs() < 2e-5, "sank {sunk} m");
    assert!(loaded.object_speed(2) < 1e-3);
}

#[test]
fn what_is_free_falls_onto_the_table_and_what_is_fixed_stays() {
    let peg = || ObjectKind::Cylinder { radius_m: 0.02, height_m: 0.1, body: solid(0.2, false) };
    let shelf = ObjectKind::Box { size_m: Vector3::new(0.1, 0.1, 0.02), body: solid(1.0, true) };
    let world = after(
        1.0,
        vec![
            raised(object("falls", [3.0, 0.3], peg()), 0.01),
            raised(object("shelf", [3.0, -0.3], shelf), 0.2),
            raised(object("on_shelf", [3.0, -0.3], peg()), 0.2201),
        ],
    );
    let height = |index: usize| world.object_pose(index).translation.z + 0.18;
    assert!((height(1) - 0.05).abs() < 5e-4, "a peg of 10 cm stands with its middle at 5 cm: {} m", height(1));
    assert!((height(2) - 0.21).abs() < 1e-12, "{} m", height(2));
    assert!((height(3) - 0.27).abs() < 5e-4, "{} m", height(3));
    let upright = world.object_pose(3).rotation * Vector3::z();
    assert!(upright.z > 0.9999, "{upright:?}");
}

#[test]
fn what_stands_on_one_of_two_tables_stands_at_its_height() {
    let size = |height: f64| ObjectKind::Table { size_m: Vector2::new(0.4, 0.4), top_height_m: height, friction: 0.5.into() };
    let peg = || ObjectKind::Cylinder { radius_m: 0.02, height_m: 0.1, body: solid(0.2, false) };
    let world = after(
        0.5,
        vec![
            object("high", [4.0, 0.0], size(0.3)),
            object("low", [5.0, 0.0], size(-0.4)),
            object("on_high", [4.1, -0.1], peg()),
            object("on_low", [4.9, 0.1], peg()),
        ],
    );
    for (index, top) in [(3, 0.3), (4, -0.4)] {
        let height = world.object_pose(index).translation.z;
        assert!((height - top - 0.05).abs() < 5e-4, "a peg of 10 cm on a table of {top} m: its middle is at {height} m");
    }
}

#[test]
fn an_object_is_where_its_offsets_and_its_turn_put_it() {
    let block = ObjectKind::Box { size_m: Vector3::new(0.2, 0.1, 0.1), body: solid(1.0, false) };
    let quarter = std::f64::consts::FRAC_PI_2;
    let moved = Object {
        lateral_offset_m: 0.1.into(),
        offset_y_m: (-0.2).into(),
        yaw_rad: quarter.into(),
        ..Object::new("block", Vector2::new(2.9, 0.2), block)
    };
    let pose = after(0.1, vec![moved]).object_pose(1);
    assert!((pose.translation.vector - Vector3::new(3.0, 0.0, -0.13)).norm() < 1e-3, "{pose}");
    assert!((pose.rotation * Vector3::x() - Vector3::y()).norm() < 1e-3, "{pose}");
}
