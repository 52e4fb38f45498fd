//! What stands below the scene: how the run ended, and what the colours in the scene mean that its title has no room for.

use rerun::TextDocument;

use super::entity_path::{RESULT, SCENE_KEY};
use super::force_figure::Told;
use super::lanes::beta_in_words;
use super::recorder::{Fault, Recorder};
use crate::learning::cpdmp::{CouplingMode, CouplingSettings};
use crate::simulation::Experiment;

/// Logs the result in words, or that there is none yet.
pub(super) fn log_result(recorder: &Recorder, experiment: &Experiment, result: Option<&str>) -> Result<(), Fault> {
    let none_yet = || format!("{}, seed {}: not over", experiment.name, experiment.seed);
    let words = result.map_or_else(none_yet, str::to_owned);
    recorder.always(RESULT.path(), &TextDocument::new(words))
}

/// Logs the key of the scene; `betas` are those of its states.
pub(super) fn log_key(recorder: &Recorder, told: Told, betas: &[f64]) -> Result<(), Fault> {
    let mut lines = Vec::new();
    if !betas.is_empty() {
        lines.push(format!("Ellipsoids, states: {}; the active one with thick lines", colors_of(betas).join(", ")));
    }
    let arrows = [("measured dark blue", true), ("expected yellow", told.expected), ("the person's vermilion", told.person)];
    let arrows: Vec<&str> = arrows.into_iter().filter_map(|(color, there)| there.then_some(color)).collect();
    lines.push(format!("Arrows, forces: {}", arrows.join(", ")));
    lines.push("Points, contacts: red must not be, white may be".to_owned());
    lines.push("White line: a smallest distance, while it happens".to_owned());
    recorder.always(SCENE_KEY.path(), &TextDocument::new(lines.join("\n")))
}

/// The colours of states, each with what it means.
fn colors_of(betas: &[f64]) -> Vec<&'static str> {
    let kinds = [(0.0, "stiff green"), (-1.0, "complying purple"), (1.0, "minimising force violet")];
    let there = |kind: f64| betas.iter().any(|beta| beta_in_words(*beta) == beta_in_words(kind));
    kinds.into_iter().filter(|(kind, _)| there(*kind)).map(|(_, color)| color).collect()
}

/// The colours that states have, for a title: those of these betas; without any, those that they can have in this mode of the coupling. At its end
/// a skill is stiff, whatever its states are.
pub(super) fn colors_in_title(coupling: &CouplingSettings, betas: Option<&[f64]>) -> String {
    let can_be: &[f64] = match coupling.mode {
        CouplingMode::MinimiseForceError => &[1.0],
        CouplingMode::Comply => &[-1.0],
        CouplingMode::PerState(_) => &[-1.0, 1.0],
    };
    colors_of(&[&[0.0], betas.unwrap_or(can_be)].concat()).join(", ")
}

#[cfg(test)]
mod tests {
    use super::colors_of;

    #[test]
    fn only_colours_that_are_there_are_named() {
        assert_eq!(colors_of(&[0.0, 0.0]), ["stiff green"]);
        assert_eq!(colors_of(&[0.0, -1.0, 0.0]), ["stiff green", "complying purple"]);
        assert_eq!(colors_of(&[1.0]), ["minimising force violet"]);
    }
}
