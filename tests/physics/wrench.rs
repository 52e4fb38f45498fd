//! The wrench estimate against pushes and weights that are known.

use cpdmp::control::{ArmModel, ImpedanceSettings, Observation, PoseTracker, WrenchObserver};
use cpdmp::robot::baxter::BAXTER_URDF;
use cpdmp::robot::{Attachment, JointCommand, LoadOptions, RobotModel, electric_gripper, parse};
use cpdmp::world::{EffortSensors, HandWrench, SensorSettings, World};
use nalgebra::{Isometry3, Translation3, Vector3, Vector6};

use crate::support::{LEFT_POSTURE, baxter, faultless_sensors, world};

const G: [f64; 3] = [0.0, 0.0, -9.81];
const STEP_S: f64 = 1e-3;

/// An arm that moves its tool on a circle of `radius_m` at 0.1 m/s while a hand pushes it; yields the estimates of the pushed stretch.
struct Rig {
    world: World,
    tracker: PoseTracker,
    observer: WrenchObserver,
    sensors: EffortSensors,
    center: Isometry3<f64>,
    radius_m: f64,
}

impl Rig {
    fn new(robot: &RobotModel, sensor: &SensorSettings, radius_m: f64) -> Self {
        let world = world(robot, &LEFT_POSTURE, &[], G, sensor.dry_friction_nm);
        let arm = ArmModel::new(robot, "left_gripper_tool", &LEFT_POSTURE, G).expect("an arm");
        let impedance = ImpedanceSettings {
            stiffness_nm_per_rad: vec![1500.0, 1500.0, 800.0, 800.0, 250.0, 250.0, 120.0],
            damping_nms_per_rad: vec![60.0, 60.0, 30.0, 30.0, 8.0, 8.0, 4.0],
        };
        Self {
            center: world.tool_pose(),
            tracker: PoseTracker::new(arm.clone(), impedance, STEP_S),
            observer: WrenchObserver::new(arm, sensor.model, sensor.filter_cutoff_hz, STEP_S),
            sensors: EffortSensors::new(sensor, 7, 3, 0),
            world,
            radius_m,
        }
    }

    /// Pushes with `force` at the tool point from 1 s to 3 s; the estimates from `settle_s` after the push began.
    fn estimates(&mut self, force: Vector3<f64>, settle_s: f64) -> Vec<Vector6<f64>> {
        let (mut seen, mut now, mut command) = (Vec::new(), Observation::zero(7), JointCommand::zero(7));
        while self.world.time_s() < 3.0 {
            let t = self.world.time_s();
            now.time_s = t;
            self.world.read_arm(&mut now.position, &mut now.velocity);
            self.world.read_efforts(&mut now.effort);
            self.sensors.measure(&mut now.effort);
            let wrench = self.observer.observe(&now);
            let pushing = t > 1.0;
            if t > 1.0 + settle_s {
                seen.push(wrench);
            }
            let angle = if self.radius_m > 0.0 { 0.1 * t / self.radius_m } else { 0.0 };
            let circle = Vector3::new(angle.cos() - 1.0, angle.sin(), 0.0) * self.radius_m;
            let reference = Translation3::from(circle) * self.center;
            self.tracker.track(&reference, &now.position, &mut command);
            self.world.command_arm(&command);
            let point = self.world.tool_pose().translation.vector.into();
            self.world.push(if pushing { HandWrench { point, force, moment: Vector3::zeros() } } else { HandWrench::default() });
            self.world.advance().expect("finite");
        }
        seen
    }
}

#[test]
fn with_perfect_sensors_a_push_of_10_n_is_estimated_within_0_05_n_at_rest_and_moving() {
    let push = Vector3::new(6.0, 0.0, -8.0);
    for radius_m in [0.0, 0.1] {
        let seen = Rig::new(&baxter(), &faultless_sensors(), radius_m).estimates(push, 0.01);
        let worst = seen.iter().map(|w| (w.fixed_rows::<3>(0) - push).norm()).fold(0.0, f64::max);
        println!("radius {radius_m} m: largest error {worst:.5} N over {} estimates", seen.len());
        assert!(worst < 0.05, "radius {radius_m} m: {worst} N");
    }
}

#[test]
fn with_baxter_s_errors_the_estimate_is_noisy_but_bounded() {
    let push = Vector3::new(6.0, 0.0, -8.0);
    let seen = Rig::new(&baxter(), &SensorSettings::default(), 0.1).estimates(push, 0.5);
    let forces: Vec<Vector3<f64>> = seen.iter().map(|w| w.fixed_rows::<3>(0).into()).collect();
    let mean = forces.iter().sum::<Vector3<f64>>() / forces.len() as f64;
    let spread = (forces.iter().map(|f| (f - mean).norm_squared()).sum::<f64>() / forces.len() as f64).sqrt();
    println!("mean error {:.3} N, standard deviation {spread:.3} N", (mean - push).norm());
    // Measured 1.9 N and 1.1 N: mostly bias, which the skill's force model learns with the skill.
    assert!((mean - push).norm() < 2.5 && spread < 1.5);
    assert!(spread > 1e-3, "the errors are switched on");
}

/// A kilogram that hangs on the hand and that the controller's model does not know of.
const WEIGHT: &str = r#"<robot name="weight"><link name="weight"><inertial><mass value="1"/>
  <inertia ixx="1e-3" ixy="0" ixz="0" iyy="1e-3" iyz="0" izz="1e-3"/></inertial></link></robot>"#;

#[test]
fn a_mass_hung_on_the_wrist_weighs_m_g() {
    let weight = Attachment {
        text: WEIGHT.into(),
        origin: "weight.urdf".into(),
        parent_link: "left_hand".into(),
        parent_from_child: Isometry3::identity(),
    };
    let options = LoadOptions { attachments: vec![electric_gripper(), weight], ..LoadOptions::default() };
    let heavy = parse(BAXTER_URDF, "baxter.urdf", &options).expect("a valid robot").model;
    let mut rig = Rig::new(&baxter(), &faultless_sensors(), 0.0);
    rig.world = world(&heavy, &LEFT_POSTURE, &[], G, 0.0);
    let seen = rig.estimates(Vector3::zeros(), 1.5);
    let last = seen.last().expect("estimates");
    assert!((last[2] + 9.81).abs() < 0.01 && last[0].abs() < 0.01 && last[1].abs() < 0.01, "{last}");
}
