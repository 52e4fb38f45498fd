//! Ellipses over time as curves: all those of a plot in one entity, for an entity costs more than what is drawn of it.

use rerun::components::AggregationPolicy;
use rerun::{EntityPath, Scalars, SeriesLines};

use super::lanes::{beta_color, beta_in_words};
use super::recorder::{Fault, Recorder};

/// Points of half an ellipse.
const POINTS: usize = 41;

/// The ellipse of a state in a plot over time.
pub(super) struct Outline<'a> {
    /// What the state does about forces.
    pub beta: f64,
    /// When it is drawn exactly (s).
    pub times_s: Vec<f64>,
    /// Its upper and its lower half at a time (s); NaN outside of it.
    pub halves: Box<dyn Fn(f64) -> [f64; 2] + 'a>,
}

/// Logs the ellipses, in the order of the states: of each the upper and the lower half. Rows lie at the times of all of them; outside of an
/// ellipse there is nothing to draw, which is NaN.
pub(super) fn log_outlines(recorder: &Recorder, entity: &EntityPath, outlines: &[Outline<'_>]) -> Result<(), Fault> {
    let mut times_s: Vec<f64> = outlines.iter().flat_map(|outline| outline.times_s.iter().copied()).collect();
    times_s.sort_by(f64::total_cmp);
    times_s.dedup();
    if times_s.is_empty() {
        return Ok(());
    }
    let rows = times_s.iter().flat_map(|time_s| outlines.iter().flat_map(|outline| (outline.halves)(*time_s)));
    let columns = Scalars::new(rows).columns(std::iter::repeat_n(2 * outlines.len(), times_s.len()))?;
    recorder.always(entity.clone(), &looks(outlines))?;
    recorder.at_times(entity.clone(), &times_s, columns)
}

/// Places at equal angles around an ellipse: its steep ends have as many as its flat middle. The ends themselves are not rounded out of it.
pub(super) fn around(middle: f64, half_width: f64) -> impl Iterator<Item = f64> {
    let inside = half_width * (1.0 - 1e-9);
    (0..POINTS).map(move |i| middle - inside * (std::f64::consts::PI * i as f64 / (POINTS - 1) as f64).cos())
}

fn looks(outlines: &[Outline<'_>]) -> SeriesLines {
    let twice = || outlines.iter().enumerate().flat_map(|one| [one; 2]);
    SeriesLines::new()
        .with_names(twice().map(|(state, outline)| format!("state {state}, {}", beta_in_words(outline.beta))))
        .with_colors(twice().map(|(_, outline)| beta_color(outline.beta)))
        .with_widths(twice().map(|_| 1.0))
        .with_aggregation_policy(AggregationPolicy::Off)
}
