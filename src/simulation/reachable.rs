//! Whether the arm can go a way: pose by pose, each posture found from the one before, as the arm will go it.

use super::guide_path::GuidePath;
use super::setup::{Setup, unreachable};
use super::{SimulationError, TeachingPlan};

/// Distance in time of the poses that are solved (s).
const SAMPLE_S: f64 = 0.05;
/// Turn of a joint between two of them from which the arm is said to swing into another posture (rad): four times what the fastest joint of
/// Baxter can do.
const SWING_RAD: f64 = 0.8;

impl Setup {
    /// Solves the way `path`, which is that of `whose` lesson; returns the posture at its start (rad).
    ///
    /// # Errors
    /// At the first pose that the arm cannot reach, or only in another posture.
    pub(super) fn can_go(&self, plan: &TeachingPlan, path: &GuidePath, whose: &str) -> Result<Vec<f64>, SimulationError> {
        let start = self.posture(&path.at(0.0).pose, &place_name(plan, path, 0.0, whose))?;
        let mut arm = self.arm();
        let (mut q, mut before) = (start.clone(), start.clone());
        for k in 1..=(plan.duration_s / SAMPLE_S).ceil() as usize {
            let time_s = (k as f64 * SAMPLE_S).min(plan.duration_s);
            let outcome = arm.reach_on(&path.at(time_s).pose, &mut q);
            if !outcome.converged {
                return Err(unreachable(&arm, &outcome, &q, &place_name(plan, path, time_s, whose)));
            }
            let turns = q.iter().zip(&before).map(|(now, before)| (now - before).abs()).enumerate();
            let (joint, turn) = turns.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0));
            if turn > SWING_RAD {
                let (what, joint) = (place_name(plan, path, time_s, whose), arm.joint_name(joint).to_owned());
                return Err(SimulationError::Swing { what, joint, turn_deg: turn.to_degrees(), within_s: SAMPLE_S });
            }
            before.copy_from_slice(&q);
        }
        Ok(start)
    }
}

/// `way-point 2 (at block_1) of lesson 3`, or what lies between two of them.
fn place_name(plan: &TeachingPlan, path: &GuidePath, time_s: f64, whose: &str) -> String {
    let at = |index: usize| plan.waypoints[index].at.as_deref().unwrap_or("the world");
    let last = plan.waypoints.len() - 1;
    let before = path.times_s().partition_point(|t| *t <= time_s).saturating_sub(1);
    if time_s - path.times_s()[before] < SAMPLE_S || before == last {
        return format!("way-point {} (at {}) of {whose}", before + 1, at(before));
    }
    format!("the way to way-point {} (at {}) of {whose}, at {time_s:.2} s,", before + 2, at(before + 1))
}
