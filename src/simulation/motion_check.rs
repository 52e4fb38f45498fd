//! Judges a movement by geometry alone: what the arm would touch, how near it comes to what, whether its joints can go that way.

use super::{ArmMotion, Reach, Setup, SimulationError};
use crate::robot::Finding;
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
    /// What is odd about the robot's file.
    pub robot_warnings: Vec<Finding>,
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
}

/// Moves the arm through the scene of an experiment, whose objects stand where they start unless the movement says where they are.
///
/// # Errors
/// When the robot or the scene cannot be built.
pub fn check_motion(setup: &Setup, motion: &ArmMotion) -> Result<MotionOutcome, SimulationError> {
    let mut scene = KinematicScene::new(&setup.world_settings(&setup.experiment.parameters, &motion.arm_rad[0], false))?;
    for (sample, arm_rad) in motion.arm_rad.iter().enumerate() {
        let objects = motion.objects.as_ref().map(|objects| objects[sample].as_slice());
        scene.place(&Placement { time_s: motion.times_s[sample], arm_rad, gripper: motion.gripper[sample], objects });
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
    })
}

fn nearest_limit(setup: &Setup, motion: &ArmMotion) -> JointExtreme {
    let mut worst = JointExtreme { joint: String::new(), value: f64::INFINITY, time_s: motion.times_s[0] };
    for (joint, limits) in setup.arm_joints().iter().enumerate() {
        for (arm_rad, &time_s) in motion.arm_rad.iter().zip(&motion.times_s) {
            let spare = (arm_rad[joint] - limits.lower).min(limits.upper - arm_rad[joint]);
            if spare < worst.value {
                worst = JointExtreme { joint: limits.name.clone(), value: spare, time_s };
            }
        }
    }
    worst
}

fn fastest(setup: &Setup, motion: &ArmMotion) -> JointExtreme {
    let mut worst = JointExtreme { joint: String::new(), value: 0.0, time_s: motion.times_s[0] };
    for (joint, limits) in setup.arm_joints().iter().enumerate() {
        for (angles, times) in motion.arm_rad.windows(2).zip(motion.times_s.windows(2)) {
            let speed = (angles[1][joint] - angles[0][joint]).abs() / (times[1] - times[0]);
            if speed / limits.velocity_limit > worst.value {
                worst = JointExtreme { joint: limits.name.clone(), value: speed / limits.velocity_limit, time_s: times[0] };
            }
        }
    }
    worst
}
