//! The layout that a recording opens with: a page for the execution, one for the teaching, one for the replay.

use nalgebra::Vector3;
use rerun::blueprint::components::{BackgroundKind, LinkAxis, PanelState, PlayState};
use rerun::blueprint::{
    Blueprint, BlueprintPanel, ContainerLike, Horizontal, SelectionPanel, Spatial3DView, StateTimelineView, Tabs, TextDocumentView,
    TextLogView, TimePanel, TimeSeriesView, Vertical, View,
};
use rerun::datatypes::{TimeRange, TimeRangeBoundary, VisibleTimeRange};
use rerun::external::re_sdk_types::blueprint::archetypes::{
    Background, EyeControls3D, LineGrid3D, PlotLegend, TextLogColumns, TimeAxis, VisibleTimeRanges,
};
use rerun::external::re_sdk_types::blueprint::datatypes::{TextLogColumn, TextLogColumnKind, TimelineColumn};

use super::blueprint_property::Properties;
use super::camera::Camera;
use super::convert;
use super::entity_path::{EXECUTED_PATH, Entity, FORCE_COLORS, SIM_TIME, TEACHING_PATH, TIMELINES};
use super::palette;
use super::recorder::Fault;

/// Titles stand where a legend would cover what is drawn.
const PATHS: &str = "Taught grey, planned blue, executed orange";
const BASELINE: &str = ", LWR-DMP black";
const STATES: &str = "; stiff green, complying purple, minimising force yellow";
const PERSON: &str = "; person vermilion";

/// A coordinate that moves less than this (m) is not worth one of the two large plots.
const MOVES_M: f64 = 0.02;

/// What decides about the layout.
pub(super) struct Shown {
    pub camera: Camera,
    /// Height of the floor (m, world).
    pub floor_m: f64,
    /// How far the tool goes along x, y and z (m).
    pub way_m: Vector3<f64>,
    /// Whether there are lessons to be seen.
    pub taught: bool,
    /// Whether a baseline is shown beside the run.
    pub baseline: bool,
    /// Whether the skill has states.
    pub states: bool,
}

/// The layout with the properties of its views: one page for the execution, one for what came before it.
pub(super) fn layout(shown: &Shown, play: PlayState) -> Result<(Blueprint, Properties), Fault> {
    let mut views = Views::default();
    let execution = execution(&mut views, shown)?.with_name("Execution");
    let teaching = teaching(&mut views, shown)?.with_name("Teaching (timeline teaching_time)");
    let replay = replay(&mut views)?.with_name("Replay (timeline replay_time)");
    let mut pages: Vec<ContainerLike> = vec![execution.into()];
    if shown.taught {
        pages.push(teaching.into());
    }
    pages.push(replay.into());
    let blueprint = Blueprint::new(Tabs::new(pages))
        .with_blueprint_panel(BlueprintPanel::from_state(PanelState::Hidden))
        .with_selection_panel(SelectionPanel::from_state(PanelState::Hidden))
        .with_time_panel(TimePanel::new().with_state(PanelState::Collapsed).with_timeline(SIM_TIME.name).with_play_state(play));
    Ok((blueprint, views.properties))
}

/// The scene with the events at the left; motion, forces, compliance and lanes at the right.
fn execution(views: &mut Views, shown: &Shown) -> Result<Horizontal, Fault> {
    let parts = [(PATHS, true), (BASELINE, shown.baseline), (STATES, shown.states), (PERSON, true)];
    let title: String = parts.into_iter().filter_map(|(part, told)| told.then_some(part)).collect();
    let scene = views.scene(&title, "/world", &EXECUTED_PATH, shown)?;
    let axes = axes(&shown.way_m);
    let [first, second] = [views.motion(axes[0])?, views.motion(axes[1])?];
    let mut right: Vec<ContainerLike> = vec![first.into(), second.into(), Tabs::new(more(views, axes)?).into()];
    let mut shares = vec![1.0, 1.0, 1.25];
    if shown.states {
        let title = "How far demonstrations disagree in the active state (orange), threshold sigma (purple); mm or mrad";
        right.push(views.plot(title, "plots/spread")?.into());
        shares.push(0.7);
    }
    right.push(StateTimelineView::new("Compliance, gripper, person, state").with_origin("/lanes").into());
    shares.push(1.35);
    let words = Tabs::new([views.events()?.into(), TextDocumentView::new("How to read").with_origin("/guide").into()]);
    let left = Vertical::new([scene.into(), words.into()]).with_row_shares(vec![5.0, 1.0]);
    Ok(Horizontal::new([left.into(), Vertical::new(right).with_row_shares(shares).into()]).with_column_shares(vec![1.25, 1.0]))
}

/// The coordinates, those for the large plots first: x and z, as in the paper, unless one of them hardly moves and y does.
fn axes(way_m: &Vector3<f64>) -> [&'static str; 3] {
    let moves = |axis: usize| way_m[axis] >= MOVES_M;
    match (moves(0), moves(1), moves(2)) {
        (_, true, false) => ["x", "y", "z"],
        (false, true, true) => ["y", "z", "x"],
        _ => ["x", "z", "y"],
    }
}

/// What is looked at in its turn.
fn more(views: &mut Views, [first, second, third]: [&str; 3]) -> Result<[ContainerLike; 6], Fault> {
    let mut beside = |name: &str, plots: &[(&str, &str)]| -> Result<Horizontal, Fault> {
        let plots: Result<Vec<View>, Fault> = plots.iter().map(|(title, origin)| views.plot(title, origin)).collect();
        Ok(Horizontal::new(plots?.into_iter().map(Into::into)).with_name(name))
    };
    let forces = beside("", &[("x (N)", "plots/force/x"), ("y (N)", "plots/force/y"), ("z (N)", "plots/force/z")])?;
    let colors = TextDocumentView::new("Key").with_origin(FORCE_COLORS.pattern);
    let force = Horizontal::new([forces.into(), colors.into()]).with_name("Force").with_column_shares(vec![4.6, 1.0]);
    let person = beside("Person", &[("Force (N)", "plots/person/force"), ("Power (W)", "plots/person/power")])?;
    let forcing = [first, second].map(|axis| (format!("Forcing {axis} (m)"), format!("plots/forcing/{axis}")));
    let forcing = beside("Forcing term", &forcing.each_ref().map(|(title, origin)| (title.as_str(), origin.as_str())))?;
    let coupling = beside("Coupling", &[("Displacement (m): x orange, y green, z blue", "plots/coupling")])?;
    let gripper = beside("Gripper", &[("0 closed, 1 open: commanded blue, measured orange", "plots/gripper")])?;
    let motion = beside(&format!("Motion {third}"), &[(&motion_title(third), &format!("plots/motion/{third}"))])?;
    Ok([force.into(), person.into(), forcing.into(), coupling.into(), gripper.into(), motion.into()])
}

/// The lessons: the scene at the left; motion, person and gripper at the right.
fn teaching(views: &mut Views, shown: &Shown) -> Result<Horizontal, Fault> {
    let scene = views.scene("Teaching: a person (vermilion) leads the weightless arm", "/teaching", &TEACHING_PATH, shown)?;
    let [first, second, _] = axes(&shown.way_m);
    let mut taught = |axis: &str| views.plot(&format!("Taught {axis} (m)"), &format!("teaching_plots/motion/{axis}"));
    let right: [ContainerLike; 5] = [
        taught(first)?.into(),
        taught(second)?.into(),
        views.plot("Force of the person (N)", "teaching_plots/person")?.into(),
        views.plot("Gripper: 0 closed, 1 open", "teaching_plots/gripper")?.into(),
        StateTimelineView::new("Demonstration").with_origin("/teaching_lanes").into(),
    ];
    let right = Vertical::new(right).with_row_shares(vec![1.0, 1.0, 1.0, 0.7, 0.6]);
    Ok(Horizontal::new([scene.into(), right.into()]).with_column_shares(vec![1.25, 1.0]))
}

/// The replays: what the arm felt, per axis.
fn replay(views: &mut Views) -> Result<Vertical, Fault> {
    let plots: [ContainerLike; 4] = [
        views.plot("Measured force x (N)", "replay_plots/force/x")?.into(),
        views.plot("Measured force y (N)", "replay_plots/force/y")?.into(),
        views.plot("Measured force z (N)", "replay_plots/force/z")?.into(),
        StateTimelineView::new("Demonstration").with_origin("/replay_lanes").into(),
    ];
    Ok(Vertical::new(plots).with_row_shares(vec![1.0, 1.0, 1.0, 0.5]))
}

fn motion_title(axis: &str) -> String {
    format!("Motion {axis} (m): taught grey, planned blue, executed orange")
}

/// Makes views and keeps their properties.
#[derive(Default)]
struct Views {
    properties: Properties,
}

impl Views {
    /// A scene seen by the camera, in which the whole of a growing path is seen.
    fn scene(&mut self, title: &str, origin: &str, path: &Entity, shown: &Shown) -> Result<View, Fault> {
        let view = view(Spatial3DView::new(title).with_origin(origin))?;
        let eye = EyeControls3D::new()
            .with_position(convert::vector(&shown.camera.eye))
            .with_look_target(convert::vector(&shown.camera.target))
            .with_eye_up([0.0, 0.0, 1.0]);
        self.properties.set(&view, "EyeControls3D", eye);
        self.properties.set(&view, "Background", Background::new(BackgroundKind::SolidColor).with_color(palette::BACKGROUND));
        let floor = rerun::components::Plane3D::new([0.0, 0.0, 1.0], shown.floor_m as f32);
        self.properties.set(&view, "LineGrid3D", LineGrid3D::new().with_spacing(0.25).with_plane(floor));
        let until_now = TimeRange { start: TimeRangeBoundary::Infinite, end: TimeRangeBoundary::AT_CURSOR };
        let ranges = TIMELINES.map(|timeline| VisibleTimeRange { timeline: timeline.name.into(), range: until_now });
        self.properties.set_for_entity(&view, &path.path(), VisibleTimeRanges::new(ranges));
        Ok(view)
    }

    /// A plot over time, linked with all others. A legend would stand over the data: titles name the colours.
    fn plot(&mut self, name: &str, origin: &str) -> Result<View, Fault> {
        let view = view(TimeSeriesView::new(name).with_origin(origin))?;
        self.properties.set(&view, "PlotLegend", PlotLegend::new().with_visible(false));
        self.properties.set(&view, "TimeAxis", TimeAxis::new().with_link(LinkAxis::LinkToGlobal));
        Ok(view)
    }

    /// A coordinate over time.
    fn motion(&mut self, axis: &str) -> Result<View, Fault> {
        self.plot(&motion_title(axis), &format!("plots/motion/{axis}"))
    }

    fn events(&mut self) -> Result<View, Fault> {
        let view = view(TextLogView::new("Events").with_origin("/events"))?;
        let column = |kind| TextLogColumn { kind, visible: true.into() };
        // The texts begin with the time: the viewer's own column of it is too narrow for five digits.
        let time = TimelineColumn { timeline: SIM_TIME.name.into(), visible: false.into() };
        let columns = TextLogColumns::new()
            .with_timeline_columns([time])
            .with_text_log_columns([column(TextLogColumnKind::LogLevel), column(TextLogColumnKind::Body)]);
        self.properties.set(&view, "TextLogColumns", columns);
        Ok(view)
    }
}

fn view(built: impl Into<ContainerLike>) -> Result<View, Fault> {
    match built.into() {
        ContainerLike::View(view) => Ok(view),
        _ => Err("rerun made a container where a view was asked for".into()),
    }
}
