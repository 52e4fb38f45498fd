//! Forcing terms over the phase, with the states that make them as ellipses (the paper's Figs. 1 and 3).

use rerun::components::AggregationPolicy;
use rerun::{Color, EntityPath, Scalars, SeriesLines};

use super::palette;
use super::planar_entity::{CURVE, DEMONSTRATED, GAUSSIANS};
use super::planar_recorder::PlanarRecorder;
use super::recorder::Fault;
use crate::planar::{ForcingCurve, Guidance, Method, PlanarOutcome, StateGaussian};

/// The axes of the plane, as they name entities.
pub(super) const AXES: [&str; 2] = ["x", "y"];

/// Ellipses lie at this many standard deviations.
const DEVIATIONS: f64 = 2.0;

/// Widths of lines on the screen (pt): of the model, and of what is behind it, its states and what was demonstrated.
const MODEL_PT: f32 = 2.4;
const BEHIND_PT: f32 = 0.8;

/// Points of each half of an ellipse.
const POINTS: usize = 25;

/// The methods whose forcing terms are recorded: the paper's own, whose states are Gaussians.
pub(super) fn recorded(outcome: &PlanarOutcome) -> Vec<(Guidance, Method)> {
    let of = |guidance| outcome.methods_with(guidance).into_iter().filter(|method| method.is_cpdmp()).map(move |method| (guidance, method));
    outcome.guidances().into_iter().flat_map(of).collect()
}

/// Logs what demonstrations ask for, and what the models make of it.
pub(super) fn log_forcing(recorder: &PlanarRecorder, outcome: &PlanarOutcome) -> Result<(), Fault> {
    let demonstrated = outcome.forcing.iter().filter(|curve| curve.method.is_none());
    for (curve, shown) in demonstrated.zip(&outcome.demonstrations) {
        for (axis, name) in AXES.iter().enumerate() {
            line(recorder, DEMONSTRATED.of(&[name, &shown.name]), curve, axis, ("demonstrated", palette::TAUGHT, BEHIND_PT))?;
        }
    }
    for curve in &outcome.forcing {
        let Some(method) = curve.method.filter(|method| method.is_cpdmp()) else { continue };
        let situation = situation(curve);
        for (axis, name) in AXES.iter().enumerate() {
            let names = [curve.guidance.key(), method.key(), name, &situation];
            let kind = if curve.taught { "taught" } else { "unseen" };
            log_ellipses(recorder, GAUSSIANS.of(&names), &curve.states, axis, palette::rgb(curve.color_of_states()))?;
            line(recorder, CURVE.of(&names), curve, axis, (kind, color(curve), MODEL_PT))?;
        }
    }
    Ok(())
}

/// The colour of a curve, lighter where it is a method's: those are made for white, and plots are black.
fn color(curve: &ForcingCurve) -> Color {
    let color = palette::rgb(curve.color());
    if curve.chain.is_some() { color } else { palette::light(color) }
}

/// A name for a curve among those of its method: `half_width_m = 1.5, chain 2`.
pub(super) fn situation(curve: &ForcingCurve) -> String {
    let mut parts: Vec<String> = curve.theta.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    parts.extend(curve.chain.map(|chain| format!("chain {}", chain + 1)));
    parts.join(", ")
}

fn line(
    recorder: &PlanarRecorder,
    entity: EntityPath,
    curve: &ForcingCurve,
    axis: usize,
    (name, color, width): (&str, Color, f32),
) -> Result<(), Fault> {
    recorder.always(entity.clone(), &style(name, color, width, 1))?;
    let values = curve.forcing_m.iter().map(|f| f[axis]);
    recorder.over_phase(entity, &curve.phase, Scalars::new(values).columns_of_unit_batches()?)
}

/// The states of one situation as one entity: two series per state. Rows lie at the phases of all of them, so that every ellipse is exact
/// where it has a point of its own; outside of an ellipse there is nothing to draw, which is NaN.
fn log_ellipses(recorder: &PlanarRecorder, entity: EntityPath, states: &[StateGaussian], axis: usize, color: Color) -> Result<(), Fault> {
    if states.is_empty() {
        return Ok(());
    }
    let mut inputs: Vec<f64> = states.iter().flat_map(own_inputs).collect();
    inputs.sort_by(f64::total_cmp);
    inputs.dedup();
    let rows = inputs.iter().flat_map(|input| states.iter().flat_map(move |state| halves(state, axis, *input)));
    let series = 2 * states.len();
    let columns = Scalars::new(rows).columns(std::iter::repeat_n(series, inputs.len()))?;
    recorder.always(entity.clone(), &style("states", color, BEHIND_PT, series))?;
    recorder.over_phase(entity, &inputs, columns)
}

/// Phases at equal angles around the ellipse: its steep ends have as many as its flat middle.
fn own_inputs(state: &StateGaussian) -> impl Iterator<Item = f64> {
    let (middle, half) = (state.mean[0], DEVIATIONS * state.covariance[0][0].max(0.0).sqrt());
    // The ends themselves are not rounded out of the ellipse.
    let inside = half * (1.0 - 1e-9);
    (0..POINTS).map(move |i| middle - inside * (std::f64::consts::PI * i as f64 / (POINTS - 1) as f64).cos())
}

/// Where the ellipse `d^T Sigma^-1 d = k^2` is cut at a phase: `f_i + Sigma_fu / Sigma_uu d_u ± sqrt(k^2 - d_u^2 / Sigma_uu) sqrt(Sigma_ff|u)`
/// (m); NaN outside of it.
fn halves(state: &StateGaussian, axis: usize, input: f64) -> [f64; 2] {
    let (row, away) = (axis + 1, input - state.mean[0]);
    let [uu, fu, ff] = [state.covariance[0][0], state.covariance[row][0], state.covariance[row][row]];
    let middle = state.mean[row] + fu / uu * away;
    let half = (DEVIATIONS * DEVIATIONS - away * away / uu).sqrt() * (ff - fu * fu / uu).max(0.0).sqrt();
    [middle + half, middle - half]
}

fn style(name: &str, color: Color, width: f32, series: usize) -> SeriesLines {
    SeriesLines::new()
        .with_names(vec![name; series])
        .with_colors(vec![color; series])
        .with_widths(vec![width; series])
        .with_aggregation_policy(AggregationPolicy::Off)
}
