//! The layout that a recording opens with: a page for the execution, one for the teaching, one for the replay, one that says how to read them.

use nalgebra::Vector3;
use rerun::blueprint::components::{PanelState, PlayState};
use rerun::blueprint::{
    Blueprint, BlueprintPanel, ContainerLike, Horizontal, SelectionPanel, StateTimelineView, Tabs, TextDocumentView, TimePanel, Vertical,
    View,
};

use super::axis_range::Ranges;
use super::beside;
use super::blueprint_property::Properties;
use super::camera::Camera;
use super::entity_path::{
    BESIDE_COLORS, BESIDE_PATH, ERROR_COLORS, EVENTS_SO_FAR, EXECUTED_PATH, Entity, FORCE_COLORS, REPLAY_NAME, REPLAY_TIME, RESULT,
    SCENE_KEY, SIM_TIME, TEACHING_NAME, TEACHING_PATH, TEACHING_TIME, Timeline,
};
use super::paths::AXES;
use super::recorder::Fault;
use super::views::Views;
use crate::simulation::Beside;

/// Titles stand where a legend would cover what is drawn.
const PATHS: &str = "Taught grey, planned blue, executed orange";
const PATHS_OF_BASELINE: &str = "Taught grey, planned by the LWR-DMP blue, executed orange";
const BASELINE: &str = ", LWR-DMP black";

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
    /// What colours the states of the skill have, for a title; none when it has no states.
    pub states: Option<&'static str>,
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

/// The scene with the events at the left; motion, forces, compliance and lanes at the right.
fn execution(views: &mut Views, shown: &Shown<'_>) -> Result<Horizontal, Fault> {
    let others = beside::for_title(shown.beside);
    // Only the baseline has no states.
    let paths = if shown.states.is_some() { PATHS } else { PATHS_OF_BASELINE };
    let states = shown.states.map(|states| format!("; {states}")).unwrap_or_default();
    let parts = [(paths, true), (&others, true), (BASELINE, shown.baseline), (&states, true)];
    let title: String = parts.into_iter().filter_map(|(part, told)| told.then_some(part)).collect();
    let growing = std::iter::once(EXECUTED_PATH.path()).chain(shown.beside.iter().map(|one| BESIDE_PATH.of(&[&one.name])));
    let scene = views.scene(&title, "/world", growing, shown)?;
    let axes = axes(&shown.way_m);
    let [first, second] = [views.motion(axes[0], &others)?, views.motion(axes[1], &others)?];
    let mut right: Vec<ContainerLike> = vec![first.into(), second.into(), Tabs::new(more(views, axes, shown)?).into()];
    let mut shares = vec![1.0, 1.0, 1.25];
    if shown.states.is_some() {
        let title = "How far demonstrations disagree in the active state (orange), threshold sigma (purple); mm or mrad";
        right.push(views.low_plot(title, "plots/spread")?.into());
        shares.push(0.7);
    }
    let lanes = if shown.states.is_some() { "Compliance, gripper, person, state" } else { "Compliance, gripper, person" };
    right.push(StateTimelineView::new(lanes).with_origin("/lanes").into());
    shares.push(1.35);
    let left = Vertical::new([scene.into(), below_the_scene(views)?.into()]).with_row_shares(vec![3.6, 1.0]);
    Ok(Horizontal::new([left.into(), Vertical::new(right).with_row_shares(shares).into()]).with_column_shares(vec![1.25, 1.0]))
}

/// How the run ended, what the colours in the scene mean, and what has happened.
fn below_the_scene(views: &mut Views) -> Result<Horizontal, Fault> {
    let page = |name: &str, origin: &Entity| TextDocumentView::new(name).with_origin(origin.pattern);
    let events: [ContainerLike; 2] = [page("Events until now", &EVENTS_SO_FAR).into(), views.events()?.into()];
    let parts: [ContainerLike; 3] = [page("Result", &RESULT).into(), page("Key", &SCENE_KEY).into(), Tabs::new(events).into()];
    Ok(Horizontal::new(parts).with_column_shares(vec![1.15, 1.0, 1.15]))
}

/// The coordinates, those for the large plots first: x and z, as in the paper, unless one of them hardly moves and y does; what moves comes first.
fn axes(way_m: &Vector3<f64>) -> [&'static str; 3] {
    let moves = |axis: usize| way_m[axis] >= MOVES_M;
    match (moves(0), moves(1), moves(2)) {
        (true, true, false) => ["x", "y", "z"],
        (false, true, false) => ["y", "x", "z"],
        (false, true, true) => ["y", "z", "x"],
        _ => ["x", "z", "y"],
    }
}

/// What is looked at in its turn.
fn more(views: &mut Views, [first, second, third]: [&str; 3], shown: &Shown<'_>) -> Result<Vec<ContainerLike>, Fault> {
    let mut side_by_side = |name: &str, plots: &[(&str, &str)]| -> Result<Horizontal, Fault> {
        let plots: Result<Vec<View>, Fault> = plots.iter().map(|(title, origin)| views.plot(title, origin)).collect();
        Ok(Horizontal::new(plots?.into_iter().map(Into::into)).with_name(name))
    };
    let forces = side_by_side("", &[("x (N)", "plots/force/x"), ("y (N)", "plots/force/y"), ("z (N)", "plots/force/z")])?;
    let colors = TextDocumentView::new("Key").with_origin(FORCE_COLORS.pattern);
    let force = Horizontal::new([forces.into(), colors.into()]).with_name("Force").with_column_shares(vec![4.6, 1.0]);
    let person = side_by_side("Person", &[("Force (N)", "plots/person/force"), ("Power (W)", "plots/person/power")])?;
    let forcing = [first, second].map(|axis| (format!("Forcing {axis} (m)"), format!("plots/forcing/{axis}")));
    let forcing = side_by_side("Forcing", &forcing.each_ref().map(|(title, origin)| (title.as_str(), origin.as_str())))?;
    let coupling = side_by_side("Coupling", &[("Displacement (m): x orange, y green, z blue", "plots/coupling")])?;
    let motion = views.motion(third, &beside::for_title(shown.beside))?;
    let motion = Horizontal::new([motion.into()]).with_name(format!("Motion {third}"));
    let gripper = views.fraction_plot("0 closed, 1 open: commanded blue, measured orange", "plots/gripper")?;
    let gripper = Horizontal::new([gripper.into()]).with_name("Gripper");
    let mut tabs: Vec<ContainerLike> = vec![force.into(), forcing.into(), coupling.into(), gripper.into(), motion.into()];
    if shown.person {
        tabs.insert(1, person.into());
    }
    if !shown.beside.is_empty() {
        // The comparison is what such a scenario is about.
        tabs.splice(0..0, compared(views, shown.beside)?);
    }
    Ok(tabs)
}

/// Forces of the run and of everything beside it: how far they are from what was expected, if something beside it expects any, and as they were
/// measured.
fn compared(views: &mut Views, beside: &[Beside]) -> Result<Vec<ContainerLike>, Fault> {
    let mut page = |name: &str, key: &Entity, origin: &str| -> Result<ContainerLike, Fault> {
        let plot = |axis: &&str| Ok(views.plot(&format!("{axis} (N)"), &format!("plots/beside/{origin}/{axis}"))?.into());
        let plots: Vec<ContainerLike> = AXES.iter().map(plot).collect::<Result<_, Fault>>()?;
        let key = TextDocumentView::new("Key").with_origin(key.pattern);
        Ok(Horizontal::new([Horizontal::new(plots).into(), key.into()]).with_name(name).with_column_shares(vec![4.6, 1.0]).into())
    };
    let mut pages = vec![page("Forces compared", &BESIDE_COLORS, "force")?];
    if beside.iter().any(|one| one.outcome.skill.force.is_some()) {
        pages.insert(0, page("Force errors", &ERROR_COLORS, "force_error")?);
    }
    Ok(pages)
}

/// The lessons: the scene at the left; motion, person and gripper at the right.
fn teaching(views: &mut Views, shown: &Shown<'_>) -> Result<Horizontal, Fault> {
    let title = format!("A person (vermilion) leads the weightless arm. {}", choose(TEACHING_TIME));
    let scene = views.scene(&title, "/teaching", [TEACHING_PATH.path()], shown)?;
    let [first, second, _] = axes(&shown.way_m);
    let mut taught = |axis: &str| views.coordinate(&format!("Taught {axis} (m)"), &format!("teaching_plots/motion/{axis}"));
    let right: [ContainerLike; 5] = [
        taught(first)?.into(),
        taught(second)?.into(),
        views.plot("Force of the person (N)", "teaching_plots/person")?.into(),
        views.fraction_plot("Gripper: 0 closed, 1 open", "teaching_plots/gripper")?.into(),
        demonstration("/teaching_lanes", TEACHING_NAME.pattern).into(),
    ];
    let right = Vertical::new(right).with_row_shares(vec![1.0, 1.0, 1.0, 0.7, 0.6]);
    Ok(Horizontal::new([scene.into(), right.into()]).with_column_shares(vec![1.25, 1.0]))
}

/// Which demonstration it is: its number over time, and the name of the one at the cursor, for which a lane has no room.
fn demonstration(lane: &str, name: &str) -> Horizontal {
    let number = StateTimelineView::new("Number of the demonstration").with_origin(lane);
    let name = TextDocumentView::new("Its name").with_origin(name);
    Horizontal::new([number.into(), name.into()]).with_column_shares(vec![1.6, 1.0])
}

/// What a page says that is empty on all timelines but one.
fn choose(timeline: Timeline) -> String {
    format!("Empty? Choose {} at the bottom left", timeline.name)
}

/// The replays: what the arm felt, per axis.
fn replay(views: &mut Views) -> Result<Vertical, Fault> {
    let plots: [ContainerLike; 4] = [
        views.high_plot(&format!("Measured force x (N). {}", choose(REPLAY_TIME)), "replay_plots/force/x")?.into(),
        views.high_plot("Measured force y (N)", "replay_plots/force/y")?.into(),
        views.high_plot("Measured force z (N)", "replay_plots/force/z")?.into(),
        demonstration("/replay_lanes", REPLAY_NAME.pattern).into(),
    ];
    Ok(Vertical::new(plots).with_row_shares(vec![1.0, 1.0, 1.0, 0.5]))
}
