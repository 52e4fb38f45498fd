//! How to read the recording of a planar experiment, in words: of what it shows, and of nothing else.

use super::planar_forcing::recorded;
use super::planar_map::goals;
use crate::planar::{Method, Obstacle, PlanarOutcome, obstacles};

/// A paragraph about the plane and one about the plots.
pub(super) fn reading(outcome: &PlanarOutcome) -> String {
    format!("{}\n\n{}", plane(outcome), plots(outcome))
}

fn plane(outcome: &PlanarOutcome) -> String {
    let obstacles = obstacles(&outcome.cases);
    let new = outcome.cases.iter().any(|case| !case.taught);
    let thin = if new { ", thin in situations that were demonstrated, thick in others" } else { "" };
    let mut text = format!("Grey paths: how a person passed an elliptic obstacle. Coloured paths: what each method made of it{thin}; ");
    text.push_str(&colors(outcome, &obstacles));
    text.push_str(match &goals(outcome)[..] {
        [_] => " Movements should end at the dark point.",
        goals if goals.iter().all(|(_, taught)| *taught) => " Movements should end at the dark points.",
        _ => " Movements should end at the dark points, which were taught, and the yellow ones, which were not.",
    });
    if outcome.cases.iter().flat_map(|case| &case.movements).any(|movement| movement.collides) {
        text.push_str(" A large vermilion point is a collision, where it is deepest.");
    }
    text.push_str(" Dots: movements at the cursor's phase. Grid: 1 m.");
    text
}

/// What colours of paths mean: of several obstacles each has one, and so has what passes it; else each method has one.
fn colors(outcome: &PlanarOutcome, obstacles: &[Obstacle]) -> String {
    let of_obstacles: Vec<String> = obstacles.iter().filter_map(|one| Some(format!("{}: {}", one.look?.1, one.name()))).collect();
    if of_obstacles.is_empty() {
        let all = outcome.guidances().into_iter().flat_map(|guidance| outcome.methods_with(guidance));
        return format!("each method has a colour ({}).", listed(all));
    }
    format!(
        "each obstacle has a colour, and so has what passes it ({}). Where paths lie on each other, those past wider obstacles are wider lines below.",
        of_obstacles.join("; ")
    )
}

/// `blue: CPDMP; orange: LWR-DMP`, each once.
fn listed(methods: impl Iterator<Item = Method>) -> String {
    let mut all: Vec<Method> = methods.collect();
    all.sort();
    all.dedup();
    all.into_iter().map(|method| format!("{}: {}", method.look().1, method.title())).collect::<Vec<_>>().join("; ")
}

fn plots(outcome: &PlanarOutcome) -> String {
    let chains = outcome.forcing.iter().any(|curve| curve.chain.is_some());
    let widths = outcome.forcing.iter().any(|curve| curve.half_width_m().is_some());
    let whole = recorded(outcome).into_iter().map(|(_, method)| method).filter(|method| *method != Method::CpdmpChain);
    let [of_chain, states_of_chain] =
        if chains { ["; each chain has a colour of its own", ", those of a chain in its colour"] } else { [""; 2] };
    let pages =
        if widths { "Each width of the obstacle has a page." } else { "Situations that were demonstrated and others have a page each." };
    format!(
        "Plots: forcing terms over the phase. Grey: what the demonstrations ask for (eq. 4 of the paper). Thick lines: what the model makes of it \
         ({}{of_chain}). Thin ellipses: its states at two standard deviations, green{states_of_chain}. {pages}",
        listed(whole)
    )
}
