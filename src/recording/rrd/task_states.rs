//! The states of the motion model in task space.

use nalgebra::{DVector, Matrix3, Rotation3, SymmetricEigen, UnitQuaternion, Vector3};

use super::paths::COLUMNS;
use super::recorder::Fault;
use crate::demonstration::Trajectory;
use crate::learning::{Skill, TaskSpaceState, task_space_states};
use crate::simulation::{Experiment, RunOutcome};

/// A state in task space.
pub(super) struct State {
    /// When it is (s).
    pub time_s: f64,
    /// Standard deviation of that (s).
    pub time_deviation_s: f64,
    /// Where the planned path is then (m).
    pub place: Vector3<f64>,
    /// How far demonstrations disagree about it (m^2): the part of the state's covariance that decides about compliance. The rest is movement
    /// within the state and curvature, which say nothing about where the tool may be.
    pub spread: Matrix3<f64>,
    /// 0 stiff, -1 complies, +1 minimises the force error.
    pub beta: f64,
}

/// `beta` of each state as the experiment couples it; none for a skill without states.
pub(super) fn betas(experiment: &Experiment, skill: &Skill) -> Result<Vec<f64>, Fault> {
    let learned = &skill.compliance.beta[..skill.motion.states().min(skill.compliance.beta.len())];
    Ok(experiment.execution.coupling.beta(learned)?)
}

/// The states of the skill in the setting of `experiment`; none for a skill without states or without a place.
pub(super) fn states(experiment: &Experiment, outcome: &RunOutcome, duration_s: f64) -> Result<Vec<State>, Fault> {
    let motion = &outcome.skill.motion;
    let columns = COLUMNS.map(|name| motion.columns.iter().position(|column| column == name));
    let [Some(x), Some(y), Some(z)] = columns else { return Ok(Vec::new()) };
    let place = [x, y, z];
    let betas = betas(experiment, &outcome.skill)?;
    let state = |(found, beta): (&TaskSpaceState, f64)| State {
        time_s: found.u * duration_s,
        time_deviation_s: found.u_deviation * duration_s,
        place: Vector3::from(place.map(|column| found.position[column])),
        spread: Matrix3::from_fn(|i, j| found.between[(place[i], place[j])]),
        beta,
    };
    Ok(task_space_states(&outcome.skill, &experiment.question())?.iter().zip(betas).map(state).collect())
}

impl State {
    /// Half axes at `deviations` standard deviations (m) and orientation of the ellipsoid of the spread.
    pub(super) fn principal_axes(&self, deviations: f64) -> (Vector3<f64>, UnitQuaternion<f64>) {
        let eigen = SymmetricEigen::new(self.spread);
        let mut axes = eigen.eigenvectors;
        if axes.determinant() < 0.0 {
            axes.column_mut(2).neg_mut();
        }
        let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
        (eigen.eigenvalues.map(|lambda| deviations * lambda.max(0.0).sqrt()), turn)
    }
}

/// The planned coordinates over the duration of the skill.
pub(super) struct Plan {
    coordinates: [DVector<f64>; 3],
    /// The duration (s).
    pub duration_s: f64,
}

impl Plan {
    /// The plan, if it has a place.
    pub(super) fn new(plan: &Trajectory, duration_s: f64) -> Option<Self> {
        let [Some(x), Some(y), Some(z)] = COLUMNS.map(|name| plan.column(name)) else { return None };
        Some(Self { coordinates: [x, y, z], duration_s })
    }

    /// The coordinate at a time from 0 to the duration (s), between two samples on a straight line.
    pub(super) fn at(&self, axis: usize, time_s: f64) -> f64 {
        let values = &self.coordinates[axis];
        let at = (time_s / self.duration_s).clamp(0.0, 1.0) * (values.len() - 1) as f64;
        let before = (at as usize).min(values.len() - 2);
        values[before] + (values[before + 1] - values[before]) * (at - before as f64)
    }
}
