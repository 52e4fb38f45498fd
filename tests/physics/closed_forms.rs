//! Free fall, a pendulum and a sliding block, each against its closed form.

use cpdmp::robot::{JointCommand, LoadOptions, parse};
use cpdmp::world::{ObjectKind, Parameters, PhysicsSettings, World, WorldSettings};

use crate::support::{LEFT_POSTURE, baxter, cube, object, table, world};

const G: f64 = 9.81;
const STEP_S: f64 = 1e-3;

#[test]
fn a_ball_falls_by_g_t_squared_over_two() {
    let ball = object(
        "ball",
        [2.0, 2.0],
        ObjectKind::Ball { radius_m: 0.03, mass_kg: 0.05.into(), friction: 0.8.into(), rolling_damping_per_s: 0.0 },
    );
    let mut world = world(&baxter(), &LEFT_POSTURE, &[ball], [0.0, 0.0, -G], 0.0);
    let start = world.object_pose(0).translation.z;
    for _ in 0..500 {
        world.advance().expect("finite");
    }
    let (t, fallen) = (world.time_s(), start - world.object_pose(0).translation.z);
    // The engine integrates semi-implicitly: each step uses the velocity at its end, which adds g t dt / 2 exactly.
    assert!((fallen - 0.5 * G * t * (t + STEP_S)).abs() < 1e-9, "fell {fallen} m");
    assert!((world.object_speed(0) - G * t).abs() < 1e-9);
}

/// A physical pendulum: a 2 kg rod of 0.5 m about one end, with a tool at the other.
const PENDULUM: &str = r#"<robot name="pendulum">
  <link name="base"/>
  <link name="rod"><inertial><origin xyz="0 0 -0.25"/><mass value="2"/>
    <inertia ixx="0.041666666666666664" ixy="0" ixz="0" iyy="0.041666666666666664" iyz="0" izz="1e-4"/></inertial></link>
  <link name="bob"/>
  <joint name="swing" type="continuous"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/>
    <limit effort="100" velocity="100"/></joint>
  <joint name="end" type="fixed"><parent link="rod"/><child link="bob"/><origin xyz="0 0 -0.5"/></joint>
</robot>"#;

#[test]
fn a_pendulum_swings_with_the_period_of_its_inertia() {
    let robot = parse(PENDULUM, "pendulum.urdf", &LoadOptions::default()).expect("a valid robot").model;
    let (physics, amplitude) = (PhysicsSettings::default(), 0.1);
    let mut world = World::new(&WorldSettings {
        physics: &physics,
        robot: &robot,
        tool: "bob",
        grasp: "rod",
        posture_rad: &[amplitude],
        idle_tool: None,
        idle_posture_rad: &[],
        dry_friction_nm: 0.0,
        finger_friction: 1.0,
        objects: &[],
        parameters: &Parameters::default(),
        watch: false,
    })
    .expect("the world is built");
    let mut crossings = Vec::new();
    let (mut q, mut v) = ([0.0], [0.0]);
    let mut last = amplitude;
    for _ in 0..6000 {
        world.command_arm(&JointCommand::zero(1));
        world.advance().expect("finite");
        world.read_arm(&mut q, &mut v);
        if last > 0.0 && q[0] <= 0.0 {
            crossings.push(world.time_s() - STEP_S * q[0] / (q[0] - last));
        }
        last = q[0];
    }
    let measured = (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f64;
    // T = 2 pi sqrt(I / (m g l)) (1 + A²/16 + …), I = m L²/3 about the pivot.
    let inertia: f64 = 2.0 * 0.25 / 3.0;
    let exact = std::f64::consts::TAU * (inertia / (2.0 * G * 0.25)).sqrt() * (1.0 + amplitude * amplitude / 16.0);
    assert!((measured / exact - 1.0).abs() < 1e-3, "period {measured} s, exact {exact} s");
}

#[test]
fn a_block_on_a_tilted_world_slides_at_g_sine_minus_mu_g_cosine() {
    for (mu, tilt) in [(0.3, 0.5_f64), (0.6, 0.7), (0.2, 0.25)] {
        let gravity = [0.0, G * tilt.sin(), -G * tilt.cos()];
        let mut world = world(&baxter(), &LEFT_POSTURE, &[table(mu), cube(mu)], gravity, 0.0);
        for _ in 0..200 {
            world.advance().expect("finite");
        }
        let before = world.object_speed(1);
        for _ in 0..300 {
            world.advance().expect("finite");
        }
        let acceleration = (world.object_speed(1) - before) / 0.3;
        let exact = G * (tilt.sin() - mu * tilt.cos());
        assert!((acceleration - exact).abs() < 1e-3 * exact, "mu {mu}: {acceleration} m/s², exact {exact} m/s²");
    }
}

#[test]
fn a_block_on_a_slope_below_the_friction_angle_stays() {
    let (mu, tilt) = (0.6_f64, 0.9 * 0.6_f64.atan());
    let mut world = world(&baxter(), &LEFT_POSTURE, &[table(mu), cube(mu)], [0.0, G * tilt.sin(), -G * tilt.cos()], 0.0);
    for _ in 0..500 {
        world.advance().expect("finite");
    }
    let start = world.object_pose(1);
    for _ in 0..1000 {
        world.advance().expect("finite");
    }
    let moved = (world.object_pose(1).translation.vector - start.translation.vector).norm();
    assert!(moved < 2e-3, "crept {moved} m in a second");
}
