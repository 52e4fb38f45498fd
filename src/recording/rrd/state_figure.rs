//! The states of the motion model in task space: ellipsoids in the scene, ellipses over time in the plots, coloured by beta.

use nalgebra::{Matrix3, Matrix4, Rotation3, SymmetricEigen, UnitQuaternion, Vector3, Vector4};
use rerun::{Color, Ellipsoids3D, FillMode, Scalars};

use super::convert;
use super::entity_path::{ACTIVE_STATE, STATE_LOWER, STATE_UPPER, STATES};
use super::lanes::{beta_color, beta_in_words};
use super::paths::{AXES, style};
use super::recorder::{Fault, Recorder};
use crate::demonstration::Trajectory;
use crate::learning::cpdmp::{MotionModel, Shaping};
use crate::learning::dmp::PhaseInput;
use crate::learning::{ExecutionSettings, TaskSpaceState, task_space_states};
use crate::simulation::{Experiment, RunOutcome, StepRecord};

/// Ellipses are drawn at this many standard deviations: 95 % of a Gaussian in one dimension.
const DEVIATIONS: f64 = 2.0;

/// Points of half an ellipse.
const POINTS: usize = 41;

/// A state in task space: a Gaussian over time (s) and place (m). Within a state the place moves with the planned velocity.
struct State {
    mean: Vector4<f64>,
    covariance: Matrix4<f64>,
    beta: f64,
}

/// Logs the states of the skill in the setting of `experiment`; a skill without states logs none.
pub(super) fn log_states(recorder: &Recorder, experiment: &Experiment, outcome: &RunOutcome, duration_s: f64) -> Result<(), Fault> {
    let states = states(experiment, outcome, duration_s)?;
    if states.is_empty() {
        return Ok(());
    }
    let all: Vec<usize> = (0..states.len()).collect();
    recorder.always(STATES.path(), &ellipsoids(&states, &all).with_line_radii([0.0006]))?;
    log_active(recorder, &states, &outcome.steps)?;
    for (index, state) in states.iter().enumerate() {
        for axis in 0..3 {
            log_ellipse(recorder, index, state, axis)?;
        }
    }
    Ok(())
}

/// The states of the skill in the setting of `experiment`; none for a skill without states or without a place.
fn states(experiment: &Experiment, outcome: &RunOutcome, duration_s: f64) -> Result<Vec<State>, Fault> {
    let motion = &outcome.skill.motion;
    let Shaping::Phmm(phmm) = &motion.shaping else { return Ok(Vec::new()) };
    let place = ["x_m", "y_m", "z_m"].map(|name| motion.columns.iter().position(|column| column == name));
    let [Some(x), Some(y), Some(z)] = place else { return Ok(Vec::new()) };
    let place = [x, y, z];
    let found = task_space_states(&outcome.skill, &question(experiment))?;
    let state = |found: &TaskSpaceState| {
        let phase_variance = phmm.covariances[found.state][(0, 0)];
        let time_variance = phase_variance * duration_s.powi(2) / rate_of_phase(motion, found.u).powi(2);
        let velocity = velocity(&outcome.plan, found.u, duration_s);
        let mut covariance = Matrix4::zeros();
        covariance[(0, 0)] = time_variance;
        for i in 0..3 {
            covariance[(0, 1 + i)] = velocity[i] * time_variance;
            covariance[(1 + i, 0)] = velocity[i] * time_variance;
            for j in 0..3 {
                covariance[(1 + i, 1 + j)] = found.predictive[(place[i], place[j])] + velocity[i] * velocity[j] * time_variance;
            }
        }
        let [x, y, z] = place.map(|column| found.position[column]);
        State { mean: Vector4::new(found.u * duration_s, x, y, z), covariance, beta: found.beta }
    };
    Ok(found.iter().map(state).collect())
}

/// What the experiment asks of the skill.
fn question(experiment: &Experiment) -> ExecutionSettings {
    let theta = |names: &[String]| names.iter().filter_map(|name| Some((name.clone(), experiment.parameters.get(name)?))).collect();
    let duration_s = experiment.execution.duration_s;
    ExecutionSettings { theta_m: theta(&experiment.theta_m), theta_f: theta(&experiment.theta_f), duration_s, ..Default::default() }
}

/// |d input / d u| of the phase input at time fraction `u`: 1 for u itself, alpha s for the phase s.
fn rate_of_phase(motion: &MotionModel, u: f64) -> f64 {
    match motion.phase_input {
        PhaseInput::TimeFraction => 1.0,
        PhaseInput::Phase => motion.alpha * (-motion.alpha * u).exp(),
    }
}

/// Velocity of the planned path at time fraction `u` (m/s).
fn velocity(plan: &Trajectory, u: f64, duration_s: f64) -> Vector3<f64> {
    let last = plan.samples() - 1;
    let at = ((u * last as f64).round() as usize).clamp(1, last.max(2) - 1);
    let step_s = 2.0 * duration_s / last as f64;
    let difference = |name| plan.column_index(name).map_or(0.0, |j| plan.values()[((at + 1).min(last), j)] - plan.values()[(at - 1, j)]);
    Vector3::from(["x_m", "y_m", "z_m"].map(difference)) / step_s
}

/// The active state, logged when it changes.
fn log_active(recorder: &Recorder, states: &[State], records: &[StepRecord]) -> Result<(), Fault> {
    let mut changes: Vec<(f64, usize)> = Vec::new();
    for record in records.iter().filter(|record| record.state < states.len()) {
        if changes.last().is_none_or(|(_, state)| *state != record.state) {
            changes.push((record.time_s, record.state));
        }
    }
    let (times, active): (Vec<f64>, Vec<usize>) = changes.into_iter().unzip();
    let label = |i: &usize| format!("state {i}: {}", beta_in_words(states[*i].beta));
    let shown = ellipsoids(states, &active).with_labels(active.iter().map(label));
    recorder.at_times(ACTIVE_STATE.path(), &times, shown.columns_of_unit_batches()?)?;
    let look = Ellipsoids3D::update_fields().with_line_radii([0.0025]).with_fill_mode(FillMode::DenseWireframe);
    recorder.always(ACTIVE_STATE.path(), &look)
}

fn ellipsoids(states: &[State], which: &[usize]) -> Ellipsoids3D {
    let axes: Vec<(Vector3<f64>, UnitQuaternion<f64>)> = which.iter().map(|i| principal_axes(&states[*i])).collect();
    let center = |i: &usize| convert::vector(&states[*i].mean.fixed_rows::<3>(1).into());
    Ellipsoids3D::update_fields()
        .with_centers(which.iter().map(center))
        .with_half_sizes(axes.iter().map(|(half, _)| convert::vector(half)))
        .with_quaternions(axes.iter().map(|(_, turn)| convert::quaternion(turn)))
        .with_colors(which.iter().map(|i| beta_color(states[*i].beta)))
}

/// Half axes (m) and orientation of the ellipsoid of a state's place.
fn principal_axes(state: &State) -> (Vector3<f64>, UnitQuaternion<f64>) {
    let place: Matrix3<f64> = state.covariance.fixed_view::<3, 3>(1, 1).into();
    let eigen = SymmetricEigen::new(place);
    let mut axes = eigen.eigenvectors;
    if axes.determinant() < 0.0 {
        axes.column_mut(2).neg_mut();
    }
    let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
    (eigen.eigenvalues.map(|lambda| DEVIATIONS * lambda.max(0.0).sqrt()), turn)
}

/// The ellipse of time t and coordinate x as two curves:
/// `x = m_x + (C_tx / C_tt) (t - m_t) ± k sqrt(C_xx - C_tx^2 / C_tt) sqrt(1 - (t - m_t)^2 / (k^2 C_tt))`.
fn log_ellipse(recorder: &Recorder, index: usize, state: &State, axis: usize) -> Result<(), Fault> {
    let c = &state.covariance;
    let (time, place, slope) = (c[(0, 0)], c[(1 + axis, 1 + axis)], c[(0, 1 + axis)] / c[(0, 0)]);
    let half_width = DEVIATIONS * time.sqrt();
    let half_height = DEVIATIONS * (place - slope * c[(0, 1 + axis)]).max(0.0).sqrt();
    // Angles spaced evenly, so that the curves' steep ends have as many points as their flat middles.
    let angle = |i: usize| std::f64::consts::PI * (i as f64 / (POINTS - 1) as f64 - 1.0);
    let offsets: Vec<(f64, f64)> = (0..POINTS).map(|i| (half_width * angle(i).cos(), -half_height * angle(i).sin())).collect();
    let times: Vec<f64> = offsets.iter().map(|(dt, _)| state.mean[0] + dt).collect();
    let name = format!("state, {}", beta_in_words(state.beta));
    for (entity, sign) in [(STATE_UPPER, 1.0), (STATE_LOWER, -1.0)] {
        let entity = entity.of(&[AXES[axis], &index.to_string()]);
        let values = offsets.iter().map(|(dt, dx)| state.mean[1 + axis] + slope * dt + sign * dx);
        recorder.always(entity.clone(), &style(&name, color(state), 1.0))?;
        recorder.at_times(entity, &times, Scalars::new(values).columns_of_unit_batches()?)?;
    }
    Ok(())
}

fn color(state: &State) -> Color {
    beta_color(state.beta)
}
