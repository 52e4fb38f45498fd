//! Whether the arm can go a way: pose by pose, each posture found from the one before, as the arm will go it.

use nalgebra::{Isometry3, Translation3};

use super::guide_path::GuidePath;
use super::setup::{PoseName, Setup, unreachable};
use super::space::PLACE_COLUMNS;
use super::{MotionSpace, Progress, SimulationError, TeachingPlan};
use crate::demonstration::Trajectory;
use crate::world::pointing_down;

/// Distance in time of the poses that are solved (s).
const SAMPLE_S: f64 = 0.05;
/// Turn of a joint between two of them from which the arm is said to swing into another posture (rad): four times what the fastest joint of
/// Baxter can do.
const SWING_RAD: f64 = 0.8;

/// How far beyond a joint's limit a plan may lead it (rad): a lesson that leaned against the stop is still learned from.
const STOP_RAD: f64 = 1e-3;

/// What helps when a pose of a lesson cannot be reached.
pub(super) const MOVE: &str = "move the object or the way-point";
/// What helps when a pose of a skill cannot be reached.
pub(super) const ASK_NEARER: &str = "ask for a setting nearer to those that were demonstrated, or give another \
     `robot.rest_posture_rad`: the arm keeps near it on the whole way";

impl Setup {
    /// Solves the way `path`, which is that of `whose` lesson; returns the posture at its start (rad).
    ///
    /// # Errors
    /// At the first pose that the arm cannot reach, or only in another posture.
    pub(super) fn can_go(
        &self,
        plan: &TeachingPlan,
        path: &GuidePath,
        whose: &str,
        progress: &dyn Progress,
    ) -> Result<Vec<f64>, SimulationError> {
        let start = self.posture(&path.at(0.0).pose, place_name(plan, path, 0.0, whose), MOVE)?;
        let times_s = (1..=(plan.duration_s / SAMPLE_S).ceil() as usize).map(|k| (k as f64 * SAMPLE_S).min(plan.duration_s));
        let poses = times_s.map(|time_s| (time_s, path.at(time_s).pose));
        self.follow(&start, poses, (&|time_s| place_name(plan, path, time_s, whose), MOVE), progress)?;
        Ok(start)
    }

    /// Every way-point that the arm cannot reach, each asked for on its own.
    pub(super) fn out_of_reach(&self, plan: &TeachingPlan, path: &GuidePath, whose: &str, progress: &dyn Progress) -> Vec<SimulationError> {
        let asked = path.times_s().iter().take_while(|_| progress.may_go_on());
        asked.filter_map(|&time_s| self.posture(&path.at(time_s).pose, place_name(plan, path, time_s, whose), MOVE).err()).collect()
    }

    /// Solves the movement `plan` of a skill: the tool's place and orientation in task space, the joints in joint space.
    ///
    /// # Errors
    /// At the first pose that the arm cannot reach, or only in another posture; of a plan in joint space at the first joint beyond a limit.
    pub fn can_follow(&self, plan: &Trajectory, progress: &dyn Progress) -> Result<(), SimulationError> {
        let last = plan.samples() - 1;
        let every = (SAMPLE_S / plan.duration_s() * last as f64).round().max(1.0) as usize;
        let rows = (0..last).step_by(every).chain([last]);
        let name = |time_s: f64| PoseName::from(format!("the skill's plan at {time_s:.2} s").as_str());
        if self.experiment.space == MotionSpace::Joint {
            let joints = plan.select(&self.taught_motion())?;
            let angles = |row: usize| joints.row(row).iter().copied().collect::<Vec<f64>>();
            let beyond = |row: usize| self.beyond_limits(&name(plan.times_s()[row]).what, &angles(row), STOP_RAD);
            return rows.map(beyond).find(|faults| !faults.is_empty()).map_or(Ok(()), |faults| Err(SimulationError::JointLimits(faults)));
        }
        let (places, turns) = (plan.select(&PLACE_COLUMNS)?, plan.orientations());
        let pose = |row: usize| {
            let turn = turns.as_ref().map_or_else(|| pointing_down(0.0), |turns| turns[row]);
            let place = Translation3::new(places[(row, 0)], places[(row, 1)], places[(row, 2)]);
            (plan.times_s()[row], Isometry3::from_parts(place, turn))
        };
        let start = self.posture(&pose(0).1, "the skill's start", ASK_NEARER)?;
        self.follow(&start, rows.map(pose), (&name, ASK_NEARER), progress)
    }

    /// Solves timed poses one after the other from the posture `start` (rad); `name` says what a pose is called in an error, and
    /// `help` what to do. Whether it may go on is asked before each.
    fn follow(
        &self,
        start: &[f64],
        poses: impl Iterator<Item = (f64, Isometry3<f64>)>,
        (name, help): (&dyn Fn(f64) -> PoseName, &'static str),
        progress: &dyn Progress,
    ) -> Result<(), SimulationError> {
        let mut arm = self.arm();
        let (mut q, mut before) = (start.to_vec(), start.to_vec());
        for (time_s, pose) in poses {
            if !progress.may_go_on() {
                return Err(SimulationError::StoppedBefore { next: format!("{} was looked at", name(time_s).what) });
            }
            let outcome = arm.reach_on(&pose, &mut q);
            if !outcome.converged {
                return Err(unreachable(&arm, &outcome, &q, name(time_s), help));
            }
            let turns = q.iter().zip(&before).map(|(now, before)| (now - before).abs()).enumerate();
            let (joint, turn) = turns.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0));
            if turn > SWING_RAD {
                let joint = arm.joint_name(joint).to_owned();
                let name = name(time_s);
                let (what, turn_deg) = (name.what.clone(), turn.to_degrees());
                return Err(name.told(SimulationError::Swing { what, joint, turn_deg, within_s: SAMPLE_S, help }));
            }
            before.copy_from_slice(&q);
        }
        Ok(())
    }
}

/// `way-point 2 (at block_1) of lesson 3`, or what lies between two of them.
fn place_name(plan: &TeachingPlan, path: &GuidePath, time_s: f64, whose: &str) -> PoseName {
    let at = |index: usize| plan.waypoints[index].at.as_deref().unwrap_or("the world");
    let last = plan.waypoints.len() - 1;
    let before = path.times_s().partition_point(|t| *t <= time_s).saturating_sub(1);
    let (index, what) = if time_s - path.times_s()[before] < SAMPLE_S || before == last {
        (before, format!("way-point {} (at {}) of {whose}", before + 1, at(before)))
    } else {
        (before + 1, format!("the way to way-point {} (at {}) of {whose}, at {time_s:.2} s,", before + 2, at(before + 1)))
    };
    PoseName { what, key: Some(format!("teaching.waypoint.{index}")) }
}
