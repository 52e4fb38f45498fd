//! What a run leaves behind, apart from its steps: enough to judge and report it without the engine.

use nalgebra::{Point3, Vector3};

use super::{Beside, LessonRecord, Snapshots, StepRecord, WorldTrace};
use crate::demonstration::{Dataset, Trajectory};
use crate::learning::{LearningReport, Skill};
use crate::robot::{Finding, RobotModel};
use crate::world::{Clearance, ContactEpisode};

/// Everything that one experiment produced.
#[derive(Clone, Debug)]
pub struct RunOutcome {
    /// The robot that did it.
    pub robot: RobotModel,
    /// What is odd about the robot's file.
    pub robot_warnings: Vec<Finding>,
    /// The demonstrations, with their replayed wrenches.
    pub dataset: Dataset,
    /// What the lessons looked like; none when the demonstrations were read.
    pub lessons: Vec<LessonRecord>,
    /// The learned skill.
    pub skill: Skill,
    /// How learning went.
    pub learning: LearningReport,
    /// What the skill plans for this setting without any force: position of the motion columns over time.
    pub plan: Trajectory,
    /// The execution, sampled at the log rate.
    pub steps: Vec<StepRecord>,
    /// The largest force of the person in the execution, every engine step considered (N).
    pub human_peak_force_n: f64,
    /// The largest force of the objects on fingers and tool in the execution, every engine step considered (N).
    pub tool_peak_force_n: f64,
    /// Where the skill says that the tool ends in this setting (m, world).
    pub goal: Vector3<f64>,
    /// Contacts of the execution, every engine step considered.
    pub collisions: Vec<ContactEpisode>,
    /// Smallest distances of the execution.
    pub clearances: Vec<Clearance>,
    /// Teaching, replay, execution: how long each took.
    pub phases: Vec<PhaseSummary>,
    /// Hash over the bits of every body's state at every engine step of every phase.
    pub state_hash: u64,
    /// What was kept of the states, world by world, in the order of the phases.
    pub traces: Vec<WorldTrace>,
    /// States of the execution from which it can be taken up.
    pub snapshots: Snapshots,
    /// The setting's objects at the end of the run.
    pub final_objects: Vec<FinalObject>,
    /// What was executed beside the run, to be held against it; not part of its hash.
    pub beside: Vec<Beside>,
}

/// Where an object ended.
#[derive(Clone, Debug)]
pub struct FinalObject {
    /// Its name.
    pub name: String,
    /// Its place (m, world).
    pub position: Point3<f64>,
    /// Its speed (m/s).
    pub speed_m_per_s: f64,
}

/// One phase of the run.
#[derive(Clone, Debug)]
pub struct PhaseSummary {
    /// `teach`, `replay`, `learn` or `execute`.
    pub name: String,
    /// Engine steps taken.
    pub steps: u64,
    /// Wall time (s); says nothing about the result.
    pub wall_s: f64,
}

/// A force at a point, for drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AppliedForce {
    /// Where (m, world).
    pub point: Point3<f64>,
    /// How much (N, world axes).
    pub force: Vector3<f64>,
}
