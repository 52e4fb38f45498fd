//! The numbers of the states over the bars that they have in a panel over time.

use super::arm_run::ArmRun;
use super::canvas::{TEXT_PT, width_pt};
use super::chart::Chart;
use super::mark::{Anchor, Mark};
use crate::palette::BLACK;

/// Space between the number of a state and what is drawn (pt).
const GAP_PT: f64 = 2.5;

/// Writes the number of every state above its bar, clear of other bars and numbers and of the threshold. `plot_pt` is about the width and height
/// of what is between the axes (pt).
pub(super) fn number_states(run: &ArmRun, plot_pt: [f64; 2], chart: &mut Chart) {
    let drawn = chart.marks.iter().filter(|mark| !mark.places().is_empty());
    let mut taken: Vec<Region> = drawn.map(|mark| region(mark.places())).collect();
    let highest = taken.iter().map(|[_, [_, top]]| *top).fold(f64::MIN_POSITIVE, f64::max);
    let end_s = run.steps.last().map_or(0.0, |step| step.time_s).max(run.duration_s);
    // The axes are longer than what is drawn: by their margins, and by a number that stands on the highest bar.
    let [s_per_pt, height_per_pt] = [1.1 * end_s / plot_pt[0], 1.3 * highest / plot_pt[1]];
    for state in &run.states {
        let (Some([from, to]), name) = (state.active, state.state.to_string()) else { continue };
        let (middle, half_s) = (0.5 * (from + to) * run.duration_s, 0.5 * width_pt(&name, TEXT_PT) * s_per_pt);
        let (across, height) = ([middle - half_s, middle + half_s], TEXT_PT * height_per_pt);
        let foot = lowest_free(&taken, across, [height, GAP_PT * height_per_pt]);
        taken.push([across, [foot, foot + height]]);
        chart.marks.push(Mark::words(BLACK, [middle, foot + 0.5 * height], Anchor::Middle, &name));
    }
    if let Some([_, vertical]) = &mut chart.axes {
        vertical.includes = taken.iter().map(|[_, [_, top]]| *top).collect();
    }
}

/// Least and greatest coordinate on either axis.
type Region = [[f64; 2]; 2];

fn region(places: &[[f64; 2]]) -> Region {
    [0, 1].map(|axis| {
        let values = places.iter().map(|place| place[axis]);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
    })
}

/// The lowest place from zero upwards for something of a height that lies `across` an interval, with a gap to everything that is taken.
fn lowest_free(taken: &[Region], across: [f64; 2], [height, gap]: [f64; 2]) -> f64 {
    let mut foot = gap;
    let beside = |[[left, right], _]: &&Region| *left < across[1] && *right > across[0];
    while let Some([_, [_, top]]) = taken.iter().filter(beside).find(|[_, [low, top]]| *low < foot + height && top + gap > foot) {
        foot = top + gap;
    }
    foot
}
