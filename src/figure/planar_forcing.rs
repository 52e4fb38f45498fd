//! Forcing terms over the phase with the Gaussians that make them.

use nalgebra::Matrix2;

use super::chart::{Axis, Chart, Figure};
use super::mark::Mark;
use super::transitions::chain_name;
use crate::math::covariance_outline;
use crate::palette::GREY;
use crate::planar::{ForcingCurve, Guidance, Method, Obstacle, PlanarOutcome, StateGaussian, obstacles};

/// Width and height of a panel (pt): of one for all situations, and of one of several.
const PANEL_PT: [f64; 2] = [560.0, 230.0];
const SMALL_PANEL_PT: [f64; 2] = [360.0, 180.0];
/// The axes of the plane.
const AXES: [(usize, &str); 2] = [(0, "x"), (1, "y")];
/// Gaussians are drawn at this many standard deviations.
const DEVIATIONS: f64 = 2.0;
/// Width of the model's lines (pt): the borders of its states are far thinner.
const MODEL_PT: f64 = 1.6;

/// Two panels, x above y: what demonstrations ask for, and what `method` makes of it for taught situations and for new ones, in its colour. Thin
/// ellipses are the states at two standard deviations, for every situation that is drawn. Chains have a colour each. Where obstacles differ in
/// width, each width has two panels of its own side by side.
#[must_use]
pub fn planar_forcing(title: &str, outcome: &PlanarOutcome, guidance: Guidance, method: Method) -> Figure {
    let (own, demonstrated): (Vec<&ForcingCurve>, Vec<&ForcingCurve>) =
        outcome.forcing_with(guidance).filter(|curve| curve.method.is_none_or(|of| of == method)).partition(|curve| curve.method.is_some());
    let both = |title: &str, own: &[&ForcingCurve], demonstrated: &[&ForcingCurve]| {
        AXES.map(|(axis, name)| Chart { title: title.to_owned(), ..panel(name, axis, method, own, demonstrated) })
    };
    let mut widths = obstacles(&outcome.cases);
    widths.retain(|one| own.iter().any(|curve| curve.half_width_m() == Some(one.half_width_m())));
    if widths.len() < 2 {
        return Figure { title: title.to_owned(), panels: both("", &own, &demonstrated).into(), columns: 1, panel_size_pt: PANEL_PT };
    }
    let of = |one: &Obstacle| both(&one.name(), &of_width(&own, one.half_width_m()), &of_width(&demonstrated, one.half_width_m()));
    let panels = widths.iter().flat_map(of);
    Figure { title: title.to_owned(), panels: panels.collect(), columns: 2, panel_size_pt: SMALL_PANEL_PT }
}

/// The curves that were told this half width (m).
fn of_width<'a>(curves: &[&'a ForcingCurve], half_width_m: f64) -> Vec<&'a ForcingCurve> {
    curves.iter().copied().filter(|curve| curve.half_width_m() == Some(half_width_m)).collect()
}

/// Ellipses behind, what was demonstrated on them, and the model's lines on top: dashed for taught situations, as in paths, which lets what they
/// lie on be seen.
fn panel(name: &str, axis: usize, method: Method, own: &[&ForcingCurve], demonstrated: &[&ForcingCurve]) -> Chart {
    let mut chart = Chart::plot("", [Axis::new("phase input (-)"), Axis::new(&format!("forcing along {name} (m)"))]);
    let points = |curve: &ForcingCurve| curve.phase.iter().zip(&curve.forcing_m).map(|(u, f)| [*u, f[axis]]).collect();
    let outlines = own.iter().flat_map(|curve| {
        let of = curve.chain.map_or(method.title().to_owned(), chain_name);
        let (name, color) = (format!("states of {of}, two standard deviations"), curve.color_of_states());
        curve.states.iter().map(move |state| Mark::faint_area(&name, color, outline(state, axis)))
    });
    chart.marks.extend(outlines);
    chart.marks.extend(demonstrated.iter().map(|curve| Mark::line("demonstrated", GREY, 0.8, points(curve))));
    for taught in [false, true] {
        let draw = if taught { Mark::dashes } else { Mark::line };
        let lines = own.iter().filter(|curve| curve.taught == taught);
        let lines = lines.map(|curve| draw(&named_line(curve, method), curve.color(), MODEL_PT, points(curve)));
        chart.marks.extend(lines);
    }
    chart
}

/// What the legend calls the line of a curve.
fn named_line(curve: &ForcingCurve, method: Method) -> String {
    let of = curve.chain.map_or(method.title().to_owned(), chain_name);
    format!("{of}, {}", if curve.taught { "taught" } else { "not taught" })
}

fn outline(state: &StateGaussian, axis: usize) -> Vec<[f64; 2]> {
    let row = axis + 1;
    let covariance = Matrix2::new(state.covariance[0][0], state.covariance[0][row], state.covariance[row][0], state.covariance[row][row]);
    covariance_outline([state.mean[0], state.mean[row]], &covariance, DEVIATIONS)
}
