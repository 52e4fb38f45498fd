//! In which coordinates the skill moves: what its columns are, and where the tool is then.

use nalgebra::{DMatrix, Isometry3, Translation3, UnitQuaternion};

use super::reachable::ASK_NEARER;
use super::setup::Setup;
use super::{MotionSpace, SimulationError};
use crate::control::Follower;
use crate::demonstration::{Dataset, Trajectory};
use crate::learning::SkillExecution;
use crate::world::pointing_down;

/// Columns that a motion of the tool must begin with.
pub(super) const PLACE_COLUMNS: [&str; 3] = ["x_m", "y_m", "z_m"];

/// The columns of an arm's joints, from the shoulder.
pub(super) fn joint_columns(joints: usize) -> impl Iterator<Item = String> {
    (1..=joints).map(|joint| format!("q{joint}_rad"))
}

impl Setup {
    /// The motion columns that taught demonstrations are learned by.
    pub(super) fn taught_motion(&self) -> Vec<String> {
        match self.experiment.space {
            MotionSpace::Task => PLACE_COLUMNS.map(String::from).to_vec(),
            MotionSpace::Joint => joint_columns(self.joints()).collect(),
        }
    }

    /// A recorded dataset as the experiment learns it: in joint space by the joints, whatever it says its motion is, and in task space by the
    /// tool when its motion is the joints.
    pub(super) fn in_space(&self, dataset: Dataset) -> Result<Dataset, SimulationError> {
        let of_joints = dataset.motion.iter().cloned().eq(joint_columns(self.joints()));
        let space = match self.experiment.space {
            MotionSpace::Task if !of_joints => return Ok(dataset),
            MotionSpace::Task => "task",
            MotionSpace::Joint => "joint",
        };
        let dataset = Dataset { motion: self.taught_motion(), ..dataset };
        let lacks = |column: &&String| dataset.demonstrations.iter().any(|one| !one.trajectory.columns().contains(column));
        match dataset.motion.iter().find(lacks) {
            Some(column) => {
                let needed = format!("learning.space is \"{space}\", and the arm has {} joints", self.joints());
                Err(SimulationError::Mismatch(format!("{needed}, but they have no column {column}")))
            }
            None => Ok(dataset),
        }
    }

    /// The posture (rad) in which an execution starts, and what makes the arm follow it.
    pub(super) fn follower(&self, execution: &SkillExecution) -> Result<(Vec<f64>, Follower), SimulationError> {
        let start = execution.state();
        if self.experiment.space == MotionSpace::Joint {
            let follower = Follower::joints(self.arm(), self.experiment.robot.impedance.clone());
            return Ok((start.position.iter().copied().collect(), follower));
        }
        let orientation = start.orientation.unwrap_or_else(|| pointing_down(0.0));
        let place = Translation3::new(start.position[0], start.position[1], start.position[2]);
        let posture = self.posture(&Isometry3::from_parts(place, orientation), "the skill's start", ASK_NEARER)?;
        Ok((posture, Follower::Tool { tracker: self.tracker(), orientation }))
    }

    /// `base_from_tool` at a position of the skill; without an orientation in task space.
    pub(super) fn tool_at(&self, position: &[f64]) -> Isometry3<f64> {
        match self.experiment.space {
            MotionSpace::Task => Isometry3::translation(position[0], position[1], position[2]),
            MotionSpace::Joint => self.arm().tool_pose(position),
        }
    }

    /// A planned movement with the place of the tool among its columns.
    pub(super) fn with_place(&self, plan: Trajectory) -> Result<Trajectory, SimulationError> {
        if self.experiment.space == MotionSpace::Task {
            return Ok(plan);
        }
        let (joints, mut arm) = (plan.select(&self.taught_motion())?, self.arm());
        let pose = |row: usize| arm.tool_pose(&joints.row(row).iter().copied().collect::<Vec<_>>());
        let poses: Vec<Isometry3<f64>> = (0..joints.nrows()).map(pose).collect();
        let columns = PLACE_COLUMNS.map(String::from).into_iter().chain(plan.columns().iter().cloned()).collect();
        let values = DMatrix::from_fn(joints.nrows(), 3 + plan.columns().len(), |row, j| match j {
            0..=2 => poses[row].translation.vector[j],
            _ => plan.values()[(row, j - 3)],
        });
        Ok(Trajectory::new(plan.times_s().to_vec(), columns, values)?)
    }
}

/// The tool's pose at the start of a demonstration, if it has an orientation.
pub(super) fn first_pose(trajectory: &Trajectory) -> Option<Isometry3<f64>> {
    let place = trajectory.select(&PLACE_COLUMNS).ok()?;
    let orientation: UnitQuaternion<f64> = *trajectory.orientations()?.first()?;
    Some(Isometry3::from_parts(Translation3::new(place[(0, 0)], place[(0, 1)], place[(0, 2)]), orientation))
}
