//! What of a model the demonstrations choose, instead of its settings.

use super::super::phmm::{PhmmSettings, Sequence};
use super::super::{LearningError, MayGoOn};
use super::{RidgeChoice, StatesChoice, StatesSearch, choose_ridge, choose_states};

/// What of one model is chosen from the demonstrations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Selection {
    /// How the number of states is chosen. Default not at all: the settings say it.
    pub states: Option<StatesSearch>,
    /// Whether the ridge is chosen by leaving demonstrations out. Default no: the settings say it.
    pub ridge: bool,
}

/// What was chosen for one model.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Choices {
    /// How the number of states was chosen, when it was.
    pub states: Option<StatesChoice>,
    /// How the ridge was chosen, when it was.
    pub ridge: Option<RidgeChoice>,
}

/// The settings with everything filled in that `selection` leaves to the data: first the states, then the ridge for so many.
///
/// # Errors
/// As [`choose_states`] and [`choose_ridge`].
pub fn choose(
    sequences: &[Sequence],
    settings: &PhmmSettings,
    selection: Selection,
    seed: u64,
    may_go_on: MayGoOn,
) -> Result<(PhmmSettings, Choices), LearningError> {
    let mut settings = settings.clone();
    let states = selection.states.map(|search| choose_states(sequences, &settings, search, seed, may_go_on)).transpose()?;
    settings.states = states.as_ref().map_or(settings.states, |choice| choice.states);
    let ridge = selection.ridge.then(|| choose_ridge(sequences, &settings, seed, may_go_on)).transpose()?;
    settings.ridge = ridge.as_ref().map_or(settings.ridge, |choice| choice.ridge);
    Ok((settings, Choices { states, ridge }))
}
