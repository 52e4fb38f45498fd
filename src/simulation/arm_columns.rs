//! Columns that describe the arm: its joints by name, its joints by number, or the pose of its tool.

use super::Setup;
use super::arm_motion::poses;
use crate::demonstration::Trajectory;

/// The columns of a pose.
pub(super) const POSE: [&str; 7] = ["x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"];

/// How far the tool may be from where its joints have it, for both to be of one movement (m): what angles lose that are written with three decimals.
const AGREE_M: f64 = 5e-3;
/// How far it may be turned away from there (rad).
const AGREE_RAD: f64 = 1e-2;

/// The names that columns must have to describe the arm.
pub(super) struct ArmColumns {
    /// `NAME_rad` of every joint, from the shoulder.
    named: Vec<String>,
    /// `q1_rad`, `q2_rad` …
    counted: Vec<String>,
    pose: Vec<String>,
}

impl ArmColumns {
    /// For an arm with these joints.
    pub fn of(joints: &[String]) -> Self {
        Self {
            named: joints.iter().map(|name| format!("{name}_rad")).collect(),
            counted: (1..=joints.len()).map(|number| format!("q{number}_rad")).collect(),
            pose: POSE.map(str::to_owned).to_vec(),
        }
    }

    /// Why the columns of `trajectory` cannot be taken for one movement of the arm, if they cannot. Joints and a pose that agree can, as in a taught
    /// demonstration.
    pub fn contradiction(&self, setup: &Setup, trajectory: &Trajectory) -> Option<String> {
        let there = |names: &[String]| names.iter().filter(|name| trajectory.column_index(name).is_some()).cloned().collect::<Vec<_>>();
        let ways: Vec<Vec<String>> = [&self.named, &self.counted, &self.pose].map(|names| there(names)).to_vec();
        let ways: Vec<Vec<String>> = ways.into_iter().filter(|names| !names.is_empty()).collect();
        if ways.len() < 2 {
            return None;
        }
        let why = match self.parting(setup, trajectory) {
            Some((off_m, off_rad, time_s)) if ways.len() == 2 => {
                if off_m <= AGREE_M && off_rad <= AGREE_RAD {
                    return None;
                }
                let (off_mm, off_deg) = (off_m * 1e3, off_rad.to_degrees());
                let (most_mm, most_deg) = (AGREE_M * 1e3, AGREE_RAD.to_degrees());
                let apart = format!("which are up to {off_mm:.1} mm and {off_deg:.1} deg apart (at {time_s:.3} s)");
                format!("{apart}, more than {most_mm:.0} mm or {most_deg:.1} deg")
            }
            _ => "which may contradict each other".to_owned(),
        };
        let ways = ways.iter().map(|names| format!("[{}]", names.join(", "))).collect::<Vec<_>>().join(" and by ");
        Some(format!("it describes the arm by {ways}, {why}: keep one of them"))
    }

    /// How far the tool is from where its joints have it at worst (m, rad), and when the distance is largest (s); nothing when either is not all there.
    fn parting(&self, setup: &Setup, trajectory: &Trajectory) -> Option<(f64, f64, f64)> {
        let angles = [&self.named, &self.counted].into_iter().find_map(|names| trajectory.select(names).ok())?;
        let mut arm = setup.arm();
        let (mut worst_m, mut worst_rad, mut when_s) = (0.0_f64, 0.0_f64, trajectory.times_s()[0]);
        for ((q, pose), &time_s) in angles.row_iter().zip(poses(trajectory, "")?).zip(trajectory.times_s()) {
            let q: Vec<f64> = q.iter().copied().collect();
            let tool = arm.tool_pose(&q);
            let off_m = (tool.translation.vector - pose.translation.vector).norm();
            if off_m > worst_m {
                (worst_m, when_s) = (off_m, time_s);
            }
            worst_rad = worst_rad.max(tool.rotation.angle_to(&pose.rotation));
        }
        Some((worst_m, worst_rad, when_s))
    }

    /// All of them.
    pub fn all(self) -> Vec<String> {
        [self.named, self.counted, self.pose].concat()
    }
}
