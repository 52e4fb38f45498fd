//! The layout that a recording opens with: a page for the execution, one for the teaching, one for the replay.

use rerun::blueprint::components::{BackgroundKind, Corner2D, LinkAxis, PanelState, PlayState};
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
use super::entity_path::{EXECUTED_PATH, Entity, SIM_TIME, TEACHING_PATH, TIMELINES};
use super::palette;
use super::recorder::Fault;

/// Titles stand where a legend cannot cover anything.
const SCENE_TITLE: &str = "Execution: taught grey, planned blue, executed orange; states stiff green, complying purple; person vermilion";

/// The layout with the properties of its views: one page for the execution, one for what came before it. `floor_m` is the height of the
/// floor (m, world).
pub(super) fn layout(camera: Camera, floor_m: f64, taught: bool, play: PlayState) -> Result<(Blueprint, Properties), Fault> {
    let mut views = Views::default();
    let execution = execution(&mut views, camera, floor_m)?.with_name("Execution");
    let teaching = teaching(&mut views, camera, floor_m)?.with_name("Teaching (timeline teaching_time)");
    let replay = replay(&mut views)?.with_name("Replay (timeline replay_time)");
    let mut pages: Vec<ContainerLike> = vec![execution.into()];
    if taught {
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
fn execution(views: &mut Views, camera: Camera, floor_m: f64) -> Result<Horizontal, Fault> {
    let scene = views.scene(SCENE_TITLE, "/world", &EXECUTED_PATH, camera, floor_m)?;
    let lateral = views.plot("Motion x (m): taught grey, planned blue, executed orange", "plots/motion/x", None)?;
    let vertical = views.plot("Motion z (m): taught grey, planned blue, executed orange", "plots/motion/z", None)?;
    let legend = Some(Corner2D::RightTop);
    let beside =
        |name: &str, plots: Vec<View>| -> ContainerLike { Horizontal::new(plots.into_iter().map(Into::into)).with_name(name).into() };
    let force = ["x", "y", "z"].map(|axis| {
        let legend = legend.filter(|_| axis == "x");
        views.plot(&format!("Force {axis} (N)"), &format!("plots/force/{axis}"), legend)
    });
    let person = [views.plot("Force (N)", "plots/person/force", None)?, views.plot("Power (W)", "plots/person/power", None)?];
    let forcing = [views.plot("Forcing x (m)", "plots/forcing/x", None)?, views.plot("Forcing z (m)", "plots/forcing/z", None)?];
    let more = [
        beside("Force", force.into_iter().collect::<Result<_, Fault>>()?),
        beside("Person", person.into()),
        beside("Forcing term", forcing.into()),
        views.plot("Coupling (m)", "plots/coupling", legend)?.into(),
        views.plot("Gripper", "plots/gripper", Some(Corner2D::LeftBottom))?.into(),
        views.plot("Motion y (m)", "plots/motion/y", None)?.into(),
    ];
    let spread = views.plot("How far demonstrations disagree in the active state", "plots/spread", legend)?;
    let lanes = StateTimelineView::new("Compliance, gripper, person, state").with_origin("/lanes");
    let words = Tabs::new([views.events()?.into(), TextDocumentView::new("How to read").with_origin("/guide").into()]);
    let left = Vertical::new([scene.into(), words.into()]).with_row_shares(vec![5.0, 1.0]);
    let right: [ContainerLike; 5] = [lateral.into(), vertical.into(), Tabs::new(more).into(), spread.into(), lanes.into()];
    let right = Vertical::new(right).with_row_shares(vec![1.0, 1.0, 1.25, 0.7, 1.35]);
    Ok(Horizontal::new([left.into(), right.into()]).with_column_shares(vec![1.25, 1.0]))
}

/// The lessons: the scene at the left; motion, person and gripper at the right.
fn teaching(views: &mut Views, camera: Camera, floor_m: f64) -> Result<Horizontal, Fault> {
    let scene = views.scene("Teaching: a person (vermilion) leads the weightless arm", "/teaching", &TEACHING_PATH, camera, floor_m)?;
    let right: [ContainerLike; 5] = [
        views.plot("Taught x (m)", "teaching_plots/motion/x", None)?.into(),
        views.plot("Taught z (m)", "teaching_plots/motion/z", None)?.into(),
        views.plot("Force of the person (N)", "teaching_plots/person", None)?.into(),
        views.plot("Gripper: 0 closed, 1 open", "teaching_plots/gripper", None)?.into(),
        StateTimelineView::new("Demonstration").with_origin("/teaching_lanes").into(),
    ];
    let right = Vertical::new(right).with_row_shares(vec![1.0, 1.0, 1.0, 0.7, 0.6]);
    Ok(Horizontal::new([scene.into(), right.into()]).with_column_shares(vec![1.25, 1.0]))
}

/// The replays: what the arm felt, per axis.
fn replay(views: &mut Views) -> Result<Vertical, Fault> {
    let plots: [ContainerLike; 4] = [
        views.plot("Measured force x (N)", "replay_plots/force/x", None)?.into(),
        views.plot("Measured force y (N)", "replay_plots/force/y", None)?.into(),
        views.plot("Measured force z (N)", "replay_plots/force/z", None)?.into(),
        StateTimelineView::new("Demonstration").with_origin("/replay_lanes").into(),
    ];
    Ok(Vertical::new(plots).with_row_shares(vec![1.0, 1.0, 1.0, 0.5]))
}

/// Makes views and keeps their properties.
#[derive(Default)]
struct Views {
    properties: Properties,
}

impl Views {
    /// A scene seen by the camera, in which the whole of a growing path is seen.
    fn scene(&mut self, title: &str, origin: &str, path: &Entity, camera: Camera, floor_m: f64) -> Result<View, Fault> {
        let view = view(Spatial3DView::new(title).with_origin(origin))?;
        let eye = EyeControls3D::new()
            .with_position(convert::vector(&camera.eye))
            .with_look_target(convert::vector(&camera.target))
            .with_eye_up([0.0, 0.0, 1.0]);
        self.properties.set(&view, "EyeControls3D", eye);
        self.properties.set(&view, "Background", Background::new(BackgroundKind::SolidColor).with_color(palette::BACKGROUND));
        let floor = rerun::components::Plane3D::new([0.0, 0.0, 1.0], floor_m as f32);
        self.properties.set(&view, "LineGrid3D", LineGrid3D::new().with_spacing(0.25).with_plane(floor));
        let until_now = TimeRange { start: TimeRangeBoundary::Infinite, end: TimeRangeBoundary::AT_CURSOR };
        let ranges = TIMELINES.map(|timeline| VisibleTimeRange { timeline: timeline.name.into(), range: until_now });
        self.properties.set_for_entity(&view, &path.path(), VisibleTimeRanges::new(ranges));
        Ok(view)
    }

    /// A plot over time, linked with all others. A legend stands over the data: those that are full of it name their colours in the title.
    fn plot(&mut self, name: &str, origin: &str, legend: Option<Corner2D>) -> Result<View, Fault> {
        let view = view(TimeSeriesView::new(name).with_origin(origin))?;
        let legend = legend.map_or_else(|| PlotLegend::new().with_visible(false), |corner| PlotLegend::new().with_corner(corner));
        self.properties.set(&view, "PlotLegend", legend);
        self.properties.set(&view, "TimeAxis", TimeAxis::new().with_link(LinkAxis::LinkToGlobal));
        Ok(view)
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
