//! The states of the motion model: ellipsoids in the scene, ellipses over time in the plots, coloured by beta.

use nalgebra::{UnitQuaternion, Vector3};
use rerun::{Ellipsoids3D, Points3D, Radius};

use super::camera::Camera;
use super::convert;
use super::entity_path::{ACTIVE_LABEL, ACTIVE_STATE, STATE_OUTLINES, STATES};
use super::lanes::{beta_color, beta_in_words};
use super::outline_figure::{Outline, around, log_outlines};
use super::palette;
use super::paths::AXES;
use super::recorder::{Fault, Recorder, Since};
use super::task_states::{Plan, State, states};
use crate::simulation::{Experiment, RunOutcome, StepRecord};

/// Ellipses are drawn at this many standard deviations: 95 % of a Gaussian in one dimension.
pub(super) const DEVIATIONS: f64 = 2.0;

/// Half axes of ellipsoids are at least this long (m) seen from far, or those of states on which all agree could not be seen.
const THINNEST_M: f64 = 0.004;

/// Logs the states of the skill in the setting of `experiment`, as a camera sees them; a skill without states logs none.
pub(super) fn log_states(
    recorder: &Recorder,
    experiment: &Experiment,
    outcome: &RunOutcome,
    (duration_s, camera): (f64, &Camera),
) -> Result<(), Fault> {
    let states = states(experiment, outcome, duration_s)?;
    let Some(plan) = Plan::new(&outcome.plan, duration_s).filter(|_| !states.is_empty()) else { return Ok(()) };
    let all: Vec<usize> = (0..states.len()).collect();
    recorder.from(Since::Start, STATES.path(), &ellipsoids(&states, &all, camera).with_line_radii([Radius::new_ui_points(0.7)]))?;
    for (axis, name) in AXES.iter().enumerate() {
        let outlines: Vec<Outline<'_>> = states.iter().map(|state| outline(state, axis, &plan)).collect();
        log_outlines(recorder, &STATE_OUTLINES.of(&[name]), &outlines)?;
    }
    Ok(())
}

/// Logs the active state of some records when it changes, its name beside the work.
pub(super) fn log_active(
    recorder: &Recorder,
    experiment: &Experiment,
    outcome: &RunOutcome,
    records: &[StepRecord],
    (duration_s, camera): (f64, &Camera),
) -> Result<(), Fault> {
    let states = &states(experiment, outcome, duration_s)?;
    if states.is_empty() {
        return Ok(());
    }
    let now = |i: usize| (records[i].state, records[i].is_over());
    let known = |i: &usize| records[*i].state < states.len() && (*i == 0 || now(*i) != now(i - 1));
    let changes: Vec<usize> = (recorder.first()..records.len()).filter(known).collect();
    let times: Vec<f64> = changes.iter().map(|i| records[*i].time_s).collect();
    let active: Vec<usize> = changes.iter().map(|i| records[*i].state).collect();
    recorder.at_times(ACTIVE_STATE.path(), &times, ellipsoids(states, &active, camera).columns_of_unit_batches()?)?;
    // What the arm does: a run without coupling does not listen to the skill.
    let listens = experiment.execution.coupling.enabled;
    let acting = |i: &usize| if now(*i).1 || !listens { 0.0 } else { states[now(*i).0].beta };
    let label = |i: &usize| match now(*i) {
        (_, true) => format!("the skill is over: {}", beta_in_words(acting(i))),
        (state, false) if !listens && states[state].beta != 0.0 => format!("state {state}: stiff, as the coupling is off"),
        (state, false) => format!("state {state}: {}", beta_in_words(acting(i))),
    };
    let words = convert::vector(&camera.words(0));
    let labels = Points3D::update_fields()
        .with_positions(active.iter().map(|_| words))
        .with_labels(changes.iter().map(label))
        .with_colors(changes.iter().map(|i| palette::for_words(beta_color(acting(i)))));
    recorder.at_times(ACTIVE_LABEL.path(), &times, labels.columns_of_unit_batches()?)?;
    recorder.always(ACTIVE_LABEL.path(), &Points3D::update_fields().with_radii([0.0]).with_show_labels(true))?;
    let look = Ellipsoids3D::update_fields().with_line_radii([Radius::new_ui_points(2.0)]);
    recorder.always(ACTIVE_STATE.path(), &look)
}

fn ellipsoids(states: &[State], which: &[usize], camera: &Camera) -> Ellipsoids3D {
    let axes: Vec<(Vector3<f64>, UnitQuaternion<f64>)> = which.iter().map(|i| thick_axes(&states[*i], camera.share)).collect();
    let center = |i: &usize| convert::vector(&states[*i].place);
    Ellipsoids3D::update_fields()
        .with_centers(which.iter().map(center))
        .with_half_sizes(axes.iter().map(|(half, _)| convert::vector(half)))
        .with_quaternions(axes.iter().map(|(_, turn)| convert::quaternion(turn)))
        .with_colors(which.iter().map(|i| beta_color(states[*i].beta)))
}

/// The principal axes, none thinner than can be seen.
fn thick_axes(state: &State, share: f64) -> (Vector3<f64>, UnitQuaternion<f64>) {
    let (half, turn) = state.principal_axes(DEVIATIONS);
    (half.map(|length| length.max(THINNEST_M * share)), turn)
}

/// The ellipse of a state over time, carried along the planned coordinate `m(t)`:
/// `x = m(t) ± k sigma_x sqrt(1 - (t - t_i)^2 / (k sigma_t)^2)`.
fn outline<'a>(state: &State, axis: usize, plan: &'a Plan) -> Outline<'a> {
    let (middle_s, half_width) = (state.time_s, DEVIATIONS * state.time_deviation_s);
    let half_height = DEVIATIONS * state.spread[(axis, axis)].max(0.0).sqrt();
    let halves = move |time_s: f64| {
        let (middle, away) = (plan.at(axis, time_s), (time_s - middle_s) / half_width);
        let half = half_height * (1.0 - away * away).sqrt();
        [middle + half, middle - half]
    };
    let times_s = around(middle_s, half_width).filter(|time_s| (0.0..=plan.duration_s).contains(time_s)).collect();
    Outline { beta: state.beta, times_s, halves: Box::new(halves) }
}
