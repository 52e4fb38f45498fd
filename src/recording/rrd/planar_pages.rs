//! What the plots of forcing terms show, page by page.

use super::planar_entity::{CURVE, DEMONSTRATED, GAUSSIANS};
use super::planar_forcing::{AXES, situation};
use crate::planar::{ForcingCurve, Guidance, Method, Obstacle, PlanarOutcome, Shown, obstacles};

/// Two plots, along x and along y.
pub(super) struct Page {
    /// What it is about.
    pub name: String,
    /// What has which look in it, in a few words.
    pub look: String,
    /// The entities of either plot.
    pub entities: [Vec<String>; 2],
}

/// Which situations a page is about.
#[derive(Clone, Copy)]
enum About {
    /// Those that were demonstrated, or those that were not.
    Taught(bool),
    /// Those with an obstacle that is as wide as this one.
    Width(Obstacle),
}

impl About {
    fn name(self) -> String {
        match self {
            Self::Taught(true) => "Demonstrated situations".to_owned(),
            Self::Taught(false) => "Other situations".to_owned(),
            Self::Width(obstacle) => obstacle.name(),
        }
    }

    fn has(self, curve: &ForcingCurve) -> bool {
        match self {
            Self::Taught(taught) => curve.taught == taught,
            Self::Width(obstacle) => curve.half_width_m() == Some(obstacle.half_width_m()),
        }
    }

    fn has_shown(self, shown: &Shown) -> bool {
        match self {
            Self::Taught(taught) => taught,
            Self::Width(obstacle) => shown.obstacle.half_axes_m[0] == obstacle.half_width_m(),
        }
    }
}

/// What the plots of a method show: where obstacles differ in width, each width has a page; else what was demonstrated has one, and what was not.
pub(super) fn pages_of(outcome: &PlanarOutcome, guidance: Guidance, method: Method) -> Vec<Page> {
    let own: Vec<&ForcingCurve> = outcome.forcing_with(guidance).filter(|curve| curve.method == Some(method)).collect();
    let page = |about: About| {
        let of_page: Vec<&ForcingCurve> = own.iter().copied().filter(|curve| about.has(curve)).collect();
        let shown: Vec<&Shown> = outcome.demonstrations.iter().filter(|shown| about.has_shown(shown)).collect();
        let entities = AXES.map(|axis| {
            let demonstrated = shown.iter().map(|shown| DEMONSTRATED.of(&[axis, &shown.name]).to_string());
            demonstrated.chain(of_page.iter().flat_map(|curve| drawn(curve, [guidance.key(), method.key(), axis]))).collect()
        });
        Page { name: about.name(), look: look(method, &of_page, !shown.is_empty()), entities }
    };
    let all = [About::Taught(true), About::Taught(false)];
    let widths = widths(outcome, &own);
    if widths.len() < 2 {
        all.into_iter().filter(|about| own.iter().any(|curve| about.has(curve))).map(page).collect()
    } else {
        widths.into_iter().map(page).collect()
    }
}

/// The obstacles whose width was told, the narrowest first.
fn widths(outcome: &PlanarOutcome, own: &[&ForcingCurve]) -> Vec<About> {
    let all = obstacles(&outcome.cases).into_iter().map(About::Width);
    all.filter(|about| own.iter().any(|curve| about.has(curve))).collect()
}

/// The entities of a curve along an axis: what the model makes, and its states.
fn drawn(curve: &ForcingCurve, [guidance, method, axis]: [&str; 3]) -> [String; 2] {
    [&CURVE, &GAUSSIANS].map(|entity| entity.of(&[guidance, method, axis, &situation(curve)]).to_string())
}

/// `thick blue: CPDMP, thin green: its states, grey: demonstrated`.
fn look(method: Method, own: &[&ForcingCurve], demonstrated: bool) -> String {
    let model = if own.iter().any(|curve| curve.chain.is_some()) {
        "thick: each chain, thin: its states".to_owned()
    } else {
        format!("thick {}: {}, thin green: its states", method.look().1, method.title())
    };
    if demonstrated { format!("{model}, grey: demonstrated") } else { model }
}
