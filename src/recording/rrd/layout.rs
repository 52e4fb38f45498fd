//! The layout that a recording opens with: a page for the execution, one for the teaching, one for the replay, one that says how to read them.

use nalgebra::Vector3;
use rerun::blueprint::components::{PanelState, PlayState};
use rerun::blueprint::{Blueprint, BlueprintPanel, ContainerLike, Horizontal, SelectionPanel, Tabs, TextDocumentView, TimePanel};

use super::axis_range::Ranges;
use super::blueprint_property::Properties;
use super::camera::Camera;
use super::entity_path::SIM_TIME;
use super::execution_page::execution;
use super::lesson_pages::{replay, teaching};
use super::recorder::Fault;
use super::views::Views;
use crate::simulation::Beside;

/// A coordinate that moves less than this (m) is not worth one of the two large plots.
const MOVES_M: f64 = 0.02;

/// What decides about the layout.
pub(super) struct Shown<'a> {
    pub camera: Camera,
    /// Height of the floor (m, world).
    pub floor_m: f64,
    /// How far the tool goes along x, y and z (m).
    pub way_m: Vector3<f64>,
    /// Whether there are lessons to be seen.
    pub taught: bool,
    /// Whether a baseline is shown beside the run.
    pub baseline: bool,
    /// What was executed beside the run.
    pub beside: &'a [Beside],
    /// What colours the states of the skill have, for a title; empty when none is drawn, none when it has none.
    pub states: Option<String>,
    /// The unit of how far demonstrations disagree.
    pub spread_unit: &'static str,
    /// Whether the person helps.
    pub person: bool,
    /// The scenario's name.
    pub scenario: &'a str,
}

/// The layout with the properties of its views: one page for the execution, one for what came before it.
pub(super) fn layout(shown: &Shown<'_>, ranges: &Ranges, play: PlayState) -> Result<(Blueprint, Properties), Fault> {
    let mut views = Views { ranges: ranges.clone(), ..Views::default() };
    let execution = execution(&mut views, shown)?.with_name(format!("Execution of {} (timeline sim_time)", shown.scenario));
    let teaching = teaching(&mut views, shown)?.with_name("Teaching (timeline teaching_time)");
    let replay = replay(&mut views)?.with_name("Replay (timeline replay_time)");
    let mut pages: Vec<ContainerLike> = vec![execution.into()];
    if shown.taught {
        pages.push(teaching.into());
    }
    pages.push(replay.into());
    // Beside the events there was room for two lines of it.
    pages.push(Horizontal::new([TextDocumentView::new("How to read").with_origin("/guide").into()]).with_name("How to read").into());
    let blueprint = Blueprint::new(Tabs::new(pages))
        .with_blueprint_panel(BlueprintPanel::from_state(PanelState::Hidden))
        .with_selection_panel(SelectionPanel::from_state(PanelState::Hidden))
        .with_time_panel(TimePanel::new().with_state(PanelState::Collapsed).with_timeline(SIM_TIME.name).with_play_state(play));
    Ok((blueprint, views.properties))
}

/// The coordinates, those for the large plots first: x and z, as in the paper, unless one of them hardly moves and y does; what moves comes first.
pub(super) fn axes(way_m: &Vector3<f64>) -> [&'static str; 3] {
    let moves = |axis: usize| way_m[axis] >= MOVES_M;
    match (moves(0), moves(1), moves(2)) {
        (true, true, false) => ["x", "y", "z"],
        (false, true, false) => ["y", "x", "z"],
        (false, true, true) => ["y", "z", "x"],
        _ => ["x", "z", "y"],
    }
}
