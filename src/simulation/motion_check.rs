//! Judges a movement by geometry alone: what the arm would touch, how near it comes to what, whether its joints can go that way.

use super::{ArmMotion, Progress, Reach, Setup, SimulationError};
use crate::robot::{Finding, Joint};
use crate::world::{Clearance, ContactEpisode, KinematicScene, Placement};

/// What became of a movement.
#[derive(Clone, Debug)]
pub struct MotionOutcome {
    /// Number of samples.
    pub samples: usize,
    /// From the first to the last sample (s).
    pub duration_s: f64,
    /// Contacts; without forces.
    pub collisions: Vec<ContactEpisode>,
    /// Smallest distances.
    pub clearances: Vec<Clearance>,
    /// The joint that comes nearest to its limit, or goes furthest beyond it.
    pub limit: JointExtreme,
    /// The joint that is fastest, as a fraction of its largest speed.
    pub speed: JointExtreme,
    /// Of tool poses: how well they are reached.
    pub reach: Option<Reach>,
    /// Where the arm is first so far beyond a limit (angle, rad) that what it would touch is not looked at from there on.
    pub far: Option<JointExtreme>,
    /// What is odd about the robot's file.
    pub robot_warnings: Vec<Finding>,
    /// What is odd about the samples, one sentence each.
    pub warnings: Vec<String>,
}

/// The joint that is worst in some respect.
#[derive(Clone, Debug, PartialEq)]
pub struct JointExtreme {
    /// Its name.
    pub joint: String,
    /// How it is: rad to spare before the limit, or a fraction of the largest speed.
    pub value: f64,
    /// When (s).
    pub time_s: f64,
    /// When any joint first is beyond what it may, if one is (s).
    pub first_failed_s: Option<f64>,
}

/// Furthest beyond a joint's limit at which it is asked what the arm touches (rad): a slip of the pen is nearer, angles in degrees are not.
const FAR_RAD: f64 = std::f64::consts::PI;

/// Moves the arm through the scene of an experiment, whose objects stand where they start unless the movement says where they are.
///
/// # Errors
/// When the robot or the scene cannot be built, or `progress` does not let it go on.
pub fn check_motion(setup: &Setup, motion: &ArmMotion, progress: &dyn Progress) -> Result<MotionOutcome, SimulationError> {
    let mut scene = KinematicScene::new(&setup.world_settings(&setup.experiment.parameters, &motion.arm_rad[0], false))?;
    let far = first_far(setup, motion);
    let looked_at = far.as_ref().map_or(motion.arm_rad.len(), |(sample, _)| *sample);
    for (sample, arm_rad) in motion.arm_rad[..looked_at].iter().enumerate() {
        let objects = motion.objects.as_ref().map(|objects| objects[sample].as_slice());
        let time_s = motion.times_s[sample];
        scene.place_while(&Placement { time_s, arm_rad, gripper: motion.gripper[sample], objects }, &|| progress.may_go_on());
        if !progress.may_go_on() {
            return Err(SimulationError::StoppedBefore { next: format!("the movement was looked at up to its sample at {time_s:.3} s") });
        }
    }
    Ok(MotionOutcome {
        samples: motion.times_s.len(),
        duration_s: motion.times_s[motion.times_s.len() - 1] - motion.times_s[0],
        collisions: scene.contacts().to_vec(),
        clearances: scene.clearances().to_vec(),
        limit: nearest_limit(setup, motion),
        speed: fastest(setup, motion),
        reach: motion.reach,
        robot_warnings: setup.warnings.clone(),
        warnings: far.iter().map(|(_, (joint, extreme))| told(joint, extreme)).collect(),
        far: far.map(|(_, (_, extreme))| extreme),
    })
}

/// The first sample that is far beyond a limit, and the joint that is.
fn first_far(setup: &Setup, motion: &ArmMotion) -> Option<(usize, (Joint, JointExtreme))> {
    let joints = setup.arm_joints();
    motion.arm_rad.iter().zip(&motion.times_s).enumerate().find_map(|(sample, (arm_rad, &time_s))| {
        let (joint, &value) = joints.iter().zip(arm_rad).find(|(joint, angle)| spare(joint, **angle) < -FAR_RAD)?;
        let extreme = JointExtreme { joint: joint.name.clone(), value, time_s, first_failed_s: Some(time_s) };
        Some((sample, (joint.clone(), extreme)))
    })
}

fn told(joint: &Joint, far: &JointExtreme) -> String {
    let JointExtreme { joint: name, value, time_s, .. } = far;
    let degrees = if spare(joint, value.to_radians()) >= 0.0 { "; are the angles degrees? They are read as rad" } else { "" };
    format!(
        "joint `{name}` is at {value:.3} rad at {time_s:.3} s, far beyond its limits: what the arm touches is not looked at from there on{degrees}"
    )
}

/// How far an angle is from the nearer limit; negative beyond it (rad).
fn spare(joint: &Joint, angle_rad: f64) -> f64 {
    (angle_rad - joint.lower).min(joint.upper - angle_rad)
}

fn earlier(known: Option<f64>, time_s: f64) -> Option<f64> {
    Some(known.map_or(time_s, |known| known.min(time_s)))
}

fn nearest_limit(setup: &Setup, motion: &ArmMotion) -> JointExtreme {
    let mut worst = JointExtreme { joint: String::new(), value: f64::INFINITY, time_s: motion.times_s[0], first_failed_s: None };
    for (joint, limits) in setup.arm_joints().iter().enumerate() {
        for (arm_rad, &time_s) in motion.arm_rad.iter().zip(&motion.times_s) {
            let spare = spare(limits, arm_rad[joint]);
            if spare < 0.0 {
                worst.first_failed_s = earlier(worst.first_failed_s, time_s);
            }
            if spare < worst.value {
                worst = JointExtreme { joint: limits.name.clone(), value: spare, time_s, ..worst };
            }
        }
    }
    worst
}

fn fastest(setup: &Setup, motion: &ArmMotion) -> JointExtreme {
    let mut worst = JointExtreme { joint: String::new(), value: 0.0, time_s: motion.times_s[0], first_failed_s: None };
    for (joint, limits) in setup.arm_joints().iter().enumerate() {
        for (angles, times) in motion.arm_rad.windows(2).zip(motion.times_s.windows(2)) {
            let speed = (angles[1][joint] - angles[0][joint]).abs() / (times[1] - times[0]) / limits.velocity_limit;
            if speed > 1.0 {
                worst.first_failed_s = earlier(worst.first_failed_s, times[0]);
            }
            if speed > worst.value {
                worst = JointExtreme { joint: limits.name.clone(), value: speed, time_s: times[0], ..worst };
            }
        }
    }
    worst
}
