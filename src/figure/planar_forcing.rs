//! Forcing terms over the phase with the Gaussians that make them.

use nalgebra::Matrix2;

use super::chart::{Axis, Chart, Figure};
use super::mark::Mark;
use super::outline::covariance_ellipse;
use super::planar_paths::method_color;
use crate::palette::{GREY, Rgb, VERMILION};
use crate::planar::{ForcingCurve, Guidance, Method, PlanarOutcome, StateGaussian};

/// Width and height of a panel (pt).
const PANEL_PT: [f64; 2] = [560.0, 230.0];
/// Gaussians are drawn at this many standard deviations.
const DEVIATIONS: f64 = 2.0;

/// Two panels, x above y: what demonstrations ask for, and what `method` makes of it for taught situations and for new ones. Ellipses are the
/// states at two standard deviations, for every situation that is drawn.
#[must_use]
pub fn planar_forcing(title: &str, outcome: &PlanarOutcome, guidance: Guidance, method: Method) -> Figure {
    let curves: Vec<&ForcingCurve> = outcome.forcing.iter().filter(|curve| curve.guidance == guidance).collect();
    let panels = ["x", "y"].iter().enumerate().map(|(axis, name)| panel(name, axis, &curves, method)).collect();
    Figure { title: title.to_owned(), panels, columns: 1, panel_size_pt: PANEL_PT }
}

fn panel(name: &str, axis: usize, curves: &[&ForcingCurve], method: Method) -> Chart {
    let mut chart = Chart::plot("", [Axis::new("phase input (-)"), Axis::new(&format!("forcing along {name} (m)"))]);
    let points = |curve: &ForcingCurve| curve.phase.iter().zip(&curve.forcing_m).map(|(u, f)| [*u, f[axis]]).collect();
    let demonstrated = curves.iter().filter(|curve| curve.method.is_none());
    chart.marks.extend(demonstrated.map(|curve| Mark::line("demonstrated", GREY, 0.6, points(curve))));
    for curve in curves.iter().filter(|curve| curve.method == Some(method)) {
        let (kind, color) = if curve.taught { ("taught", method_color(method)) } else { ("new", VERMILION) };
        let outlines = curve.states.iter().map(|state| outline(state, axis, color, &format!("states, {kind}")));
        chart.marks.extend(outlines);
        chart.marks.push(Mark::line(&format!("{}, {kind}", method.title()), color, 1.4, points(curve)));
    }
    chart
}

fn outline(state: &StateGaussian, axis: usize, color: Rgb, legend: &str) -> Mark {
    let row = axis + 1;
    let covariance = Matrix2::new(state.covariance[0][0], state.covariance[0][row], state.covariance[row][0], state.covariance[row][row]);
    Mark::area(legend, color, 0.08, covariance_ellipse([state.mean[0], state.mean[row]], &covariance, DEVIATIONS))
}
