//! What several tests need.

pub mod hand_made;

use cpdmp::check::first_difference;
use cpdmp::robot::{self, EffortModel, RobotModel};
use cpdmp::simulation::{Experiment, RunOutcome, Silent, Snapshots, WorldTrace, resume};
use cpdmp::world::{Object, ObjectKind, Parameters, PhysicsSettings, SensorSettings, Solid, World, WorldSettings};
use nalgebra::{Vector2, Vector3};

/// The posture of the left arm in the middle of the pick-and-place scene, tool down (rad).
pub const LEFT_POSTURE: [f64; 7] = [-0.3823, -1.0479, -0.4848, 1.9297, 0.3409, 0.7699, 1.2964];

/// The project's own Baxter with its gripper.
pub fn baxter() -> RobotModel {
    robot::baxter().model
}

/// A world with `robot` in it, both arms where the scenarios have them, gravity and objects as given.
pub fn world(robot: &RobotModel, posture: &[f64], objects: &[Object], gravity: [f64; 3], dry_friction_nm: f64) -> World {
    let physics = PhysicsSettings { gravity_m_per_s2: gravity, ..PhysicsSettings::default() };
    World::new(&WorldSettings {
        physics: &physics,
        robot,
        tool: "left_gripper_tool",
        grasp: "left_hand",
        posture_rad: posture,
        idle_tool: Some("right_hand"),
        idle_posture_rad: &[0.6, -0.6, 0.0, 1.6, 0.0, 0.6, 0.0],
        dry_friction_nm,
        finger_friction: 1.0,
        objects,
        parameters: &Parameters::default(),
        watch: false,
    })
    .expect("the world is built")
}

/// An object at `center` in the plane.
pub fn object(name: &str, center: [f64; 2], kind: ObjectKind) -> Object {
    Object::new(name, Vector2::from(center), kind)
}

/// A table whose top is at -0.18 m, out of reach of the arms, which fall limp when nobody commands them.
pub fn table(friction: f64) -> Object {
    object("table", [3.0, 0.0], ObjectKind::Table { size_m: Vector2::new(0.7, 1.3), top_height_m: -0.18, friction: friction.into() })
}

/// A box of 1 kg and 10 cm on that table.
pub fn cube(friction: f64) -> Object {
    let body = Solid { mass_kg: 1.0.into(), friction: friction.into(), fixed: false };
    object("cube", [3.0, -0.4], ObjectKind::Box { size_m: Vector3::new(0.1, 0.1, 0.1), body })
}

/// Takes the execution up from each snapshot that the run made, and holds every step's state that is kept after it against the run's own.
pub fn goes_on_from_every_snapshot(experiment: &Experiment, outcome: &RunOutcome, least: usize) {
    assert!(outcome.snapshots.all.len() >= least, "{} snapshots", outcome.snapshots.all.len());
    let kept = Snapshots::from_bytes(&outcome.snapshots.to_bytes().expect("bytes")).expect("the same again");
    assert_eq!(kept, outcome.snapshots);
    for snapshot in &kept.all {
        let again = resume(experiment, &outcome.skill, snapshot, &Silent).expect("it goes on");
        let own: Vec<WorldTrace> = outcome.traces.iter().filter_map(|world| world.after(snapshot.step)).collect();
        assert!(own.len() == 1 && !own[0].trace.steps.is_empty(), "nothing to compare after step {}", snapshot.step);
        assert_eq!(first_difference(&own, &again), None, "taken up after step {}", snapshot.step);
    }
}

/// Sensors and joints with which nothing is wrong.
pub fn faultless_sensors() -> SensorSettings {
    SensorSettings {
        effort_noise_nm: 0.0,
        effort_bias_nm: 0.0,
        dry_friction_nm: 0.0,
        model: EffortModel::FullDynamics,
        filter_cutoff_hz: f64::INFINITY,
    }
}
