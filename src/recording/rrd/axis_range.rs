//! Ranges of the plots' vertical axes. Left to itself the viewer may write one number beside a plot, or half of one at its edge.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use rerun::external::arrow::array::{Array, Float64Array};
use rerun::{EntityPath, Scalars, SerializedComponentColumn};

/// The viewer writes numbers at powers of ten that are some points apart: this share of the height of a plot, of one that is lower, and of one
/// that is higher.
pub(super) const LEAST_STEP: f64 = 0.22;
pub(super) const LEAST_STEP_OF_LOW: f64 = 0.4;
pub(super) const LEAST_STEP_OF_HIGH: f64 = 0.18;

/// A second number is not worth a range that is more than so many times what is drawn: that would be a line in two fifths of a plot.
const MOST_EXTENDED: f64 = 2.5;

/// Free space above and below, as a share of the range: a number at the end of what is drawn is whole.
const SPACE: f64 = 0.1;

/// The least and the greatest scalar of every entity that has been logged.
#[derive(Clone, Debug, Default)]
pub(super) struct Ranges(Arc<Mutex<BTreeMap<String, [f64; 2]>>>);

impl Ranges {
    /// Takes note of what a column says of an entity, if it holds scalars.
    pub fn note(&self, entity: &EntityPath, column: &SerializedComponentColumn) {
        let values = column.list_array.values();
        let Some(values) = values.as_any().downcast_ref::<Float64Array>().filter(|_| column.descriptor == Scalars::descriptor_scalars())
        else {
            return;
        };
        let finite = values.values().iter().filter(|value| value.is_finite());
        let [low, high] = finite.fold(NOTHING, |[low, high], value| [low.min(*value), high.max(*value)]);
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let range = known.entry(entity.to_string()).or_insert(NOTHING);
        *range = [range[0].min(low), range[1].max(high)];
    }

    /// What a plot of everything below `origin` should show, at least `least_range`, whose numbers are at least `least_step` of its height apart;
    /// none when nothing is known.
    pub fn of(&self, origin: &str, least_step: f64, least_range: f64) -> Option<[f64; 2]> {
        let below = format!("/{}/", origin.trim_matches('/'));
        let known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let of_origin = known.iter().filter(|(entity, _)| format!("{entity}/").starts_with(&below));
        let [low, high] = of_origin.fold(NOTHING, |[low, high], (_, range)| [low.min(range[0]), high.max(range[1])]);
        let missing = (least_range - (high - low)).max(0.0);
        (low <= high).then(|| shown([low - missing / 2.0, high + missing / 2.0], least_step))
    }
}

/// The range of no value.
const NOTHING: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

/// A range around another one in which at least two numbers are written, none of them at its edge, unless that takes too much room.
fn shown([mut low, mut high]: [f64; 2], least_step: f64) -> [f64; 2] {
    if high - low <= f64::EPSILON * high.abs().max(1.0) {
        (low, high) = (low - 1.0, high + 1.0);
    }
    let drawn = [low, high];
    let step = 10_f64.powf(((high - low) * least_step).log10().ceil());
    let [down, up] = [(low / step).floor() * step, (high / step).ceil() * step];
    let written = (high / step).floor() - (low / step).ceil() + 1.0;
    let near = 1.5 * SPACE * (high - low);
    let [below, above] = [low - down, up - high];
    // Of two numbers that could be the second one, the nearer.
    let to_low = written < 2.0 && below > 0.0 && (below <= above || above <= 0.0);
    if written < 1.0 || to_low || below < near {
        low = down;
    }
    if written < 1.0 || (written < 2.0 && !to_low) || above < near {
        high = up;
    }
    if high - low > MOST_EXTENDED * (drawn[1] - drawn[0]) {
        [low, high] = drawn;
    }
    let space = SPACE * (high - low);
    [low - space, high + space]
}

#[cfg(test)]
mod tests {
    use super::*;

    const RANGES: [[f64; 2]; 12] = [
        [-0.113, -0.058],
        [0.0, 9.6],
        [0.0, 7.7],
        [-7.7, 0.0],
        [0.51, 0.83],
        [2.1, 2.9],
        [0.0, 0.0],
        [5.0, 5.0],
        [-40.0, 61.0],
        [-3e-6, 1e-6],
        [-27.6, 18.4],
        [-31.0, 29.0],
    ];

    /// What is drawn with some space around it.
    fn with_space(range: [f64; 2]) -> f64 {
        let drawn = if range[0] < range[1] { range[1] - range[0] } else { 2.0 };
        (1.0 + 2.0 * SPACE) * drawn
    }

    #[test]
    fn everything_is_inside_and_takes_a_good_part_of_the_plot() {
        for range in RANGES {
            for least_step in [LEAST_STEP, LEAST_STEP_OF_LOW, LEAST_STEP_OF_HIGH] {
                let [low, high] = shown(range, least_step);
                assert!(low < range[0] && high > range[1], "{range:?}: {low} … {high}");
                assert!(high - low <= MOST_EXTENDED * with_space(range) * (1.0 + 1e-12), "{range:?}: {low} … {high}");
            }
        }
        // 28 N to one side and 18 N to the other are not drawn up to 100 N.
        let [low, high] = shown([-27.6, 18.4], LEAST_STEP);
        assert!(low > -35.0 && high < 25.0, "{low} … {high}");
    }

    #[test]
    fn two_numbers_are_written_where_there_is_room() {
        for range in &RANGES[1..9] {
            for least_step in [LEAST_STEP, LEAST_STEP_OF_LOW, LEAST_STEP_OF_HIGH] {
                let [low, high] = shown(*range, least_step);
                // What is added above and below makes the same step a smaller share of the height.
                let grown = (1.0 + 2.0 * 1.5 * SPACE) * (1.0 + 2.0 * SPACE);
                let step = 10_f64.powf(((high - low) * least_step / grown).log10().ceil());
                let edge = 0.06 * (high - low);
                let written = ((high - edge) / step).floor() - ((low + edge) / step).ceil() + 1.0;
                assert!(written >= 2.0, "{range:?}: {low} … {high} by {step}");
            }
        }
    }
}
