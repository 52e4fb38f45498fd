//! From a skill to a path, and from a path to a judgement.

use super::{COLUMNS, Ellipse, Guidance, Ideal, Method, ModelReport, Movement, Shown, Side};
use crate::demonstration::{Dataset, Demonstration, Parameters, Trajectory};
use crate::learning::{ExecutionSettings, LearningError, LearningReport, Skill, generate};

/// Positions of a path that is judged or drawn: enough that a chord leaves the path by less than a millimetre.
pub(super) const SAMPLES: usize = 401;

/// Positions (m) of a trajectory.
pub(super) fn positions(trajectory: &Trajectory) -> Result<Vec<[f64; 2]>, LearningError> {
    let values = trajectory.select(&COLUMNS)?;
    Ok(values.row_iter().map(|row| [row[0], row[1]]).collect())
}

/// The path (m) of a skill for `theta`, from `start` to `goal` (m).
pub(super) fn path_of(skill: &Skill, theta: &Parameters, start: [f64; 2], goal: [f64; 2]) -> Result<Vec<[f64; 2]>, LearningError> {
    let settings = ExecutionSettings {
        theta_m: theta.clone(),
        start: Some(start.to_vec()),
        goal: Some(goal.to_vec()),
        ..ExecutionSettings::default()
    };
    let dt = skill.motion.duration_s / (SAMPLES - 1) as f64;
    positions(&generate(skill, &settings, dt, 1.0)?)
}

/// On which side a path passes the obstacle's centre: where it first crosses the line along x through it.
pub(super) fn side_of(path: &[[f64; 2]], obstacle: &Ellipse) -> Option<Side> {
    let [x, y] = obstacle.centre_m;
    let crossing = path.windows(2).find(|pair| (pair[0][1] - y) * (pair[1][1] - y) <= 0.0 && pair[0][1] != pair[1][1])?;
    let share = (y - crossing[0][1]) / (crossing[1][1] - crossing[0][1]);
    let at = crossing[0][0] + share * (crossing[1][0] - crossing[0][0]);
    Some(if at < x { Side::Left } else { Side::Right })
}

/// A path (m) beside what would have been right. `ideals` is not empty; one that passes on no side is held against the first.
pub(super) fn judged(
    method: Method,
    chain: Option<usize>,
    path: Vec<[f64; 2]>,
    obstacle: &Ellipse,
    ideals: &[Ideal],
    goal: [f64; 2],
) -> Movement {
    let side = side_of(&path, obstacle);
    let ideal = ideals.iter().find(|ideal| Some(ideal.side) == side).unwrap_or(&ideals[0]);
    let clearance_m = obstacle.clearance(&path);
    let squares = path.iter().zip(&ideal.path_m).map(|(a, b)| (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2));
    Movement {
        method,
        chain,
        clearance_m,
        clearance_ratio: clearance_m / ideal.clearance_m,
        collides: clearance_m <= 0.0,
        side,
        path_error_m: (squares.sum::<f64>() / path.len().max(1) as f64).sqrt(),
        goal_error_m: path.last().map_or(f64::INFINITY, |p| (p[0] - goal[0]).hypot(p[1] - goal[1])),
        path_m: path,
    }
}

/// The demonstrations of a dataset, each with its obstacle.
pub(super) fn shown(dataset: &Dataset, obstacles: &[Ellipse]) -> Result<Vec<Shown>, LearningError> {
    let one = |(demonstration, obstacle): (&Demonstration, &Ellipse)| {
        let path_m = positions(&demonstration.trajectory)?;
        Ok(Shown {
            name: demonstration.name.clone(),
            theta: demonstration.theta_m.clone(),
            side: side_of(&path_m, obstacle).unwrap_or(Side::Right),
            clearance_m: obstacle.clearance(&path_m),
            obstacle: *obstacle,
            path_m,
        })
    };
    dataset.demonstrations.iter().zip(obstacles).map(one).collect()
}

/// How a skill was learned; `basis` is the number of functions of a skill without states.
pub(super) fn model_report(method: Method, guidance: Guidance, report: &LearningReport, basis: usize) -> ModelReport {
    ModelReport {
        method,
        guidance,
        states: report.motion.as_ref().map_or(basis, |fit| fit.states),
        starts: report.motion.as_ref().map_or(0, |fit| fit.starts.len()),
        status: report.motion.as_ref().map(|fit| fit.status),
        log_likelihood: report.motion.as_ref().map_or_else(Vec::new, |fit| fit.log_likelihood.clone()),
        warnings: report.warnings.clone(),
    }
}
