//! Executes a learned skill: the CPDMP runs in the control loop, fed by the arm's own wrench estimate.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use super::feedback::StateFeedback;
use super::pose_tracking::TrackerSnapshot;
use super::wrench_observer::ObserverSnapshot;
use super::{
    ArmModel, Command, Controller, Feedback, ImpedanceSettings, Observation, PoseTracker, PostureTracker, Telemetry, WrenchObserver,
};
use crate::learning::{ExecutionSnapshot, Skill, SkillExecution, SkillState, StepInput};

/// How the arm follows a skill.
pub enum Follower {
    /// The motion columns begin with x, y, z of the tool in the base frame; `orientation` is held when the skill has none.
    Tool {
        /// What follows the tool's pose.
        tracker: PoseTracker,
        /// `base_from_tool` when the skill does not say it.
        orientation: UnitQuaternion<f64>,
    },
    /// The motion columns are the arm's joints, from the shoulder.
    Joints(PostureTracker),
}

/// Runs a [`SkillExecution`] on the arm.
pub struct SkillController {
    skill: SkillExecution,
    follower: Follower,
    observer: WrenchObserver,
    feedback: Option<StateFeedback>,
    step_s: f64,
    stiffness: f64,
    /// Which of force x, y, z and torque x, y, z the skill takes, in its order, and room for their values. What the arm does not measure is zero.
    wrench_places: Vec<Option<usize>>,
    wrench: Vec<f64>,
    telemetry: Telemetry,
    started: bool,
}

/// The skill expects a wrench that the arm does not measure.
#[derive(Debug, thiserror::Error)]
#[error("the arm does not measure `{column}`, which the skill's force model expects; it measures {}", WRENCH_COLUMNS.join(", "))]
pub struct UnmeasuredWrench {
    /// The column.
    pub column: String,
}

impl Follower {
    /// A follower of skills in joint space.
    pub fn joints(model: ArmModel, impedance: ImpedanceSettings) -> Self {
        Self::Joints(PostureTracker::new(model, impedance))
    }
}

impl SkillController {
    /// Executes `execution` of `skill` in control steps of `step_s` (s) with the arm `model`. A skill without a force model expects no force;
    /// its motion columns on which no force of the arm's tool acts then stay as planned.
    ///
    /// # Errors
    /// When the skill's force model expects a wrench that the arm does not measure.
    pub fn new(
        skill: &Skill,
        execution: SkillExecution,
        follower: Follower,
        observer: WrenchObserver,
        (feedback, model): (Feedback, ArmModel),
        step_s: f64,
    ) -> Result<Self, UnmeasuredWrench> {
        let expected = skill.force.iter().flat_map(|force| &force.columns);
        if let Some(column) = expected.into_iter().find(|column| wrench_place(column).is_none()) {
            return Err(UnmeasuredWrench { column: column.clone() });
        }
        let wrench_places: Vec<_> = execution.wrench_columns().iter().map(|column| wrench_place(column)).collect();
        let wrench = vec![0.0; wrench_places.len()];
        let feedback = StateFeedback::new(feedback, model, skill.motion.columns.len(), step_s);
        let (telemetry, stiffness) = (Telemetry::default(), skill.motion.stiffness);
        Ok(Self { skill: execution, follower, observer, feedback, step_s, stiffness, wrench_places, wrench, telemetry, started: false })
    }

    /// One step of the skill, from what the arm measures.
    fn advance(&mut self, observation: &Observation) {
        let (q, v) = (observation.position.as_slice(), observation.velocity.as_slice());
        let state = self.skill.state();
        let (measured, jacobian) = match &mut self.follower {
            Follower::Tool { .. } => (self.feedback.as_mut().map(|feedback| feedback.of_tool(state, q, v)), None),
            Follower::Joints(tracker) => {
                (self.feedback.as_mut().map(|feedback| feedback.of_joints(state, q, v)), Some(tracker.jacobian(q)))
            }
        };
        self.skill.step(&StepInput { wrench: &self.wrench, measured, jacobian, ..StepInput::of(self.step_s) });
    }
}

/// What of a controller changes from step to step.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ControllerSnapshot {
    skill: ExecutionSnapshot,
    /// Of a follower in task space.
    tracker: Option<TrackerSnapshot>,
    observer: ObserverSnapshot,
    started: bool,
}

impl SkillController {
    /// Where the controller is, between two steps.
    pub fn snapshot(&self) -> ControllerSnapshot {
        let tracker = match &self.follower {
            Follower::Tool { tracker, .. } => Some(tracker.snapshot()),
            Follower::Joints(_) => None,
        };
        ControllerSnapshot { skill: self.skill.snapshot(), tracker, observer: self.observer.snapshot(), started: self.started }
    }

    /// Goes on from where a controller of the same skill and arm was, in the same bits. Returns whether the snapshot fits this one.
    pub fn restore(&mut self, from: ControllerSnapshot) -> bool {
        let tracked = match (&mut self.follower, from.tracker) {
            (Follower::Tool { tracker, .. }, Some(there)) => tracker.restore(there),
            (Follower::Joints(_), None) => true,
            _ => false,
        };
        self.started = from.started;
        tracked && self.skill.restore(from.skill) && self.observer.restore(from.observer)
    }
}

impl Controller for SkillController {
    fn decide(&mut self, observation: &Observation, command: &mut Command) {
        let wrench = self.observer.observe(observation);
        for (value, &place) in self.wrench.iter_mut().zip(&self.wrench_places) {
            *value = place.map_or(0.0, |place| wrench[place]);
        }
        if self.started {
            self.advance(observation);
        }
        self.started = true;
        let state = self.skill.state();
        let (reference, coupling_displacement, deviation) = match &mut self.follower {
            Follower::Tool { orientation, .. } => in_task_space(state, orientation, self.stiffness),
            Follower::Joints(tracker) => in_joint_space(state, tracker, self.stiffness),
        };
        self.telemetry = Telemetry {
            reference,
            wrench,
            expected_force: expected_force(state.expected_wrench.as_slice(), &self.wrench_places),
            coupling_displacement,
            deviation,
            phase: state.phase,
            time_fraction: state.u,
            state: state.state,
            beta: state.beta,
            activation: state.activation,
        };
        command.gripper = state.gripper.unwrap_or(1.0);
        match &mut self.follower {
            Follower::Tool { tracker, .. } => tracker.track(&reference, &observation.position, &mut command.joints),
            Follower::Joints(tracker) => {
                tracker.track(state.position.as_slice(), state.velocity.as_slice(), &observation.position, &mut command.joints);
            }
        }
    }

    fn telemetry(&self) -> &Telemetry {
        &self.telemetry
    }
}

/// Columns of a wrench in the order of the estimate: force, torque.
pub const WRENCH_COLUMNS: [&str; 6] = ["fx_n", "fy_n", "fz_n", "tx_nm", "ty_nm", "tz_nm"];

/// The place of a wrench column in the estimate.
fn wrench_place(column: &str) -> Option<usize> {
    WRENCH_COLUMNS.iter().position(|name| *name == column)
}

/// Wanted tool pose, displacement that the forces ask for (m), and how far they have moved the reference (m).
fn in_task_space(state: &SkillState, orientation: &UnitQuaternion<f64>, stiffness: f64) -> (Isometry3<f64>, Vector3<f64>, Vector3<f64>) {
    let place = Translation3::new(state.position[0], state.position[1], state.position[2]);
    let reference = Isometry3::from_parts(place, state.orientation.unwrap_or(*orientation));
    (reference, first_three(state.zeta.as_slice()) / stiffness, first_three(state.deviation.as_slice()))
}

/// The same of a skill in joint space, at the tool.
fn in_joint_space(state: &SkillState, tracker: &mut PostureTracker, stiffness: f64) -> (Isometry3<f64>, Vector3<f64>, Vector3<f64>) {
    let q = state.position.as_slice();
    let shift = tracker.tool_shift(q, state.deviation.as_slice());
    let reference = tracker.tool_pose(q);
    let columns = tracker.jacobian(q).column_iter().zip(state.zeta.iter());
    let displacement = columns.fold(Vector3::zeros(), |sum, (column, z)| sum + column.fixed_rows::<3>(0) * (z / stiffness));
    (reference, displacement, shift)
}

/// The force among the expected values, each of which belongs to a place of the wrench.
fn expected_force(expected: &[f64], places: &[Option<usize>]) -> Vector3<f64> {
    let mut force = Vector3::zeros();
    for (value, place) in expected.iter().zip(places) {
        if let Some(place @ 0..3) = *place {
            force[place] = *value;
        }
    }
    force
}

fn first_three(values: &[f64]) -> Vector3<f64> {
    Vector3::from_fn(|i, _| values.get(i).copied().unwrap_or(0.0))
}
