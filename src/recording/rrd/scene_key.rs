//! What stands below the scene: how the run ended, and what the colours in the scene mean that its title has no room for.

use rerun::TextDocument;

use super::arrow::LINEAR_N;
use super::beside;
use super::entity_path::{RESULT, SCENE_KEY};
use super::force_figure::Told;
use super::lanes::beta_in_words;
use super::recorder::{Fault, Recorder};
use crate::learning::cpdmp::{CouplingMode, CouplingSettings};
use crate::simulation::{Beside, Experiment};
use crate::world::NEAR_M;

/// Logs the result in words, or that there is none yet.
pub(super) fn log_result(recorder: &Recorder, experiment: &Experiment, result: Option<&str>) -> Result<(), Fault> {
    let none_yet = || format!("{}, seed {}: not over", experiment.name, experiment.seed);
    let words = result.map_or_else(none_yet, str::to_owned);
    recorder.always(RESULT.path(), &TextDocument::new(words))
}

/// Which contacts and distances a run that is over has to tell of.
#[derive(Clone, Copy)]
pub(super) struct Contacts {
    /// Whether something touched that may.
    pub allowed: bool,
    /// Whether something touched that must not.
    pub refused: bool,
    /// Whether something came near.
    pub near: bool,
}

/// Logs the key of the scene. `betas` are those of the states that are drawn, and `listens` tells whether the coupling is on. What touches is judged
/// when the run is over; `None` before.
pub(super) fn log_key(
    recorder: &Recorder,
    told: Told,
    (betas, listens): (&[f64], bool),
    (contacts, beside): (Option<Contacts>, &[Beside]),
) -> Result<(), Fault> {
    let mut lines = Vec::new();
    if !betas.is_empty() {
        let off = if listens || betas.iter().all(|beta| *beta == 0.0) { "" } else { ", but the coupling is off" };
        lines.push(format!("Ellipsoids, ellipses: states, {}{off}; the active one thick", colors_of(betas).join(", ")));
    }
    let arrows = [("measured force dark blue", true), ("expected yellow", told.expected), ("person vermilion", told.person)];
    lines.push("Executed path thick; others thin, dashed".to_owned());
    lines.push(format!("Arrows: {}; hardly longer above {LINEAR_N} N", those(&arrows)));
    match contacts {
        None => lines.push("White points: contacts; which are forbidden is told when the run is over".to_owned()),
        Some(Contacts { allowed, refused, near }) => {
            let points = those(&[("forbidden red, with the peak force in one step", refused), ("allowed white", allowed)]);
            lines.extend((allowed || refused).then(|| format!("Points, contacts: {points}")));
            lines.extend(near.then(|| format!("White line: smallest distance below {:.0} cm", NEAR_M * 1e2)));
        }
    }
    lines.extend(beside::in_short(beside));
    recorder.always(SCENE_KEY.path(), &TextDocument::new(lines.join("\n")))
}

/// Those that are there.
fn those(all: &[(&str, bool)]) -> String {
    all.iter().filter_map(|(what, there)| there.then_some(*what)).collect::<Vec<_>>().join(", ")
}

/// The colours of states, each with what it means.
fn colors_of(betas: &[f64]) -> Vec<&'static str> {
    let kinds = [(0.0, "stiff green"), (-1.0, "complying pink"), (1.0, "minimising force error violet")];
    let there = |kind: f64| betas.iter().any(|beta| beta_in_words(*beta) == beta_in_words(kind));
    kinds.into_iter().filter(|(kind, _)| there(*kind)).map(|(_, color)| color).collect()
}

/// The colours that states have, for a title: those of these betas, nothing if none is drawn; where they are not known, those that they can have in
/// this mode of the coupling.
pub(super) fn colors_in_title(coupling: &CouplingSettings, betas: Option<&[f64]>) -> String {
    if betas.is_some_and(<[f64]>::is_empty) {
        return String::new();
    }
    let can_be: &[f64] = match coupling.mode {
        CouplingMode::MinimiseForceError => &[1.0],
        CouplingMode::Comply => &[0.0, -1.0],
        CouplingMode::PerState(_) => &[0.0, -1.0, 1.0],
    };
    let betas = betas.unwrap_or(can_be);
    let off = if coupling.enabled || betas.iter().all(|beta| *beta == 0.0) { "" } else { " (coupling off)" };
    colors_of(betas).join(", ") + off
}

#[cfg(test)]
mod tests {
    use super::colors_of;

    #[test]
    fn only_colours_that_are_there_are_named() {
        assert_eq!(colors_of(&[0.0, 0.0]), ["stiff green"]);
        assert_eq!(colors_of(&[0.0, -1.0, 0.0]), ["stiff green", "complying pink"]);
        assert_eq!(colors_of(&[1.0]), ["minimising force error violet"]);
    }
}
