//! The scale of the plane: what of it is seen, lines at whole metres, and some of their numbers.

use rerun::{Color, Points2D, Radius};

use super::palette;
use super::planar_entity::{GRID, GRID_NUMBERS};
use super::planar_recorder::PlanarRecorder;
use super::planar_shapes::{point, points, strips};
use super::recorder::Fault;
use crate::planar::PlanarOutcome;

/// Lines at whole metres, on white, behind everything.
const GRID_COLOR: Color = palette::rgb(crate::palette::Rgb::new(205, 205, 205));
/// Width of the lines on the screen (pt). Thinner ones break into dots.
const GRID_PT: f32 = 1.2;
/// So many metres at most are written along an axis.
const MOST_NUMBERS: usize = 5;
/// How far below its place a number is written, as a share of the height of the plane.
const WRITTEN_BELOW: f64 = 0.035;

/// Logs the lines and their numbers.
pub(super) fn log_grid(recorder: &PlanarRecorder, outcome: &PlanarOutcome) -> Result<(), Fault> {
    let bounds = bounds(outcome);
    recorder.always(GRID.path(), &strips(grid(bounds), GRID_COLOR, GRID_PT))?;
    numbers(recorder, bounds)
}

/// The least and the greatest coordinate on each axis (m) of anything that moves, with a little space around.
pub(super) fn bounds(outcome: &PlanarOutcome) -> [[f64; 2]; 2] {
    let shown = outcome.demonstrations.iter().flat_map(|shown| &shown.path_m);
    let moved = outcome.cases.iter().flat_map(|case| &case.movements).flat_map(|movement| &movement.path_m);
    let places: Vec<&[f64; 2]> = shown.chain(moved).collect();
    [0, 1].map(|axis| {
        let values = places.iter().map(|place| place[axis]).filter(|value| value.is_finite());
        let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
        let space = 0.05 * (high - low).max(1.0);
        [low - space, high + space]
    })
}

/// Whole metres within bounds (m).
fn whole([low, high]: [f64; 2]) -> std::ops::RangeInclusive<i64> {
    low.ceil() as i64..=high.floor() as i64
}

/// What is seen of a plane with these bounds (m): at the left and below there is room for numbers, which would lie on paths.
pub(super) fn with_numbers([x, y]: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let lower = |[low, high]: [f64; 2], share: f64| [low - share * (high - low), high];
    [lower(x, 0.2), lower(y, 0.06)]
}

/// Some of the whole metres within bounds (m), as numbers at the left and below.
fn numbers(recorder: &PlanarRecorder, [x, y]: [[f64; 2]; 2]) -> Result<(), Fault> {
    let few = |bounds: [f64; 2]| {
        let of = |step: i64| whole(bounds).filter(move |at| at % step == 0).collect::<Vec<_>>();
        [1, 2, 5, 10, 20, 50].map(of).into_iter().find(|some| some.len() <= MOST_NUMBERS).unwrap_or_default()
    };
    let [[left, _], _] = with_numbers([x, y]);
    // The viewer writes below the place.
    let above = WRITTEN_BELOW * (y[1] - y[0]);
    let beside = few(y).into_iter().map(|at| ([(left + x[0]) / 2.0, at as f64 + above], at));
    let below = few(x).into_iter().map(|at| ([at as f64, y[0]], at));
    let (places, metres): (Vec<[f64; 2]>, Vec<i64>) = below.chain(beside).unzip();
    let labels = Points2D::new(points(&places))
        .with_labels(metres.iter().map(|at| format!("{at} m")))
        .with_colors([palette::IDLE])
        .with_radii([Radius::new_ui_points(0.0)])
        .with_show_labels(true);
    recorder.always(GRID_NUMBERS.path(), &labels)
}

/// Lines at whole metres within bounds (m).
fn grid([x, y]: [[f64; 2]; 2]) -> Vec<Vec<[f32; 2]>> {
    let upright = whole(x).map(|at| vec![point(&[at as f64, y[0]]), point(&[at as f64, y[1]])]);
    let level = whole(y).map(|at| vec![point(&[x[0], at as f64]), point(&[x[1], at as f64])]);
    upright.chain(level).collect()
}
