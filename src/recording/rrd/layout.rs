//! The layout that a recording opens with: the scene at the left; motion, forces, lanes and events at the right.

use nalgebra::Vector3;
use rerun::blueprint::components::{BackgroundKind, Corner2D, LinkAxis, PanelState, PlayState};
use rerun::blueprint::{
    Blueprint, BlueprintPanel, ContainerLike, Horizontal, SelectionPanel, Spatial3DView, StateTimelineView, Tabs, TextDocumentView, TextLogView,
    TimePanel, TimeSeriesView, Vertical, View,
};
use rerun::datatypes::{TimeRange, TimeRangeBoundary, VisibleTimeRange};
use rerun::external::re_sdk_types::blueprint::archetypes::{Background, EyeControls3D, LineGrid3D, PlotLegend, TimeAxis, VisibleTimeRanges};

use super::blueprint_property::Properties;
use super::convert;
use super::entity_path::{EXECUTED_PATH, SIM_TIME};
use super::recorder::Fault;

/// Where the camera stands, as seen from what it looks at (m): in front of the robot, at its left, above the table.
const EYE_FROM_TARGET_M: Vector3<f64> = Vector3::new(1.15, 0.95, 0.75);

/// The layout with the properties of its views. The camera looks at `target` (m, world); the floor is at `floor_m`.
pub(super) fn layout(target: Vector3<f64>, floor_m: f64) -> Result<(Blueprint, Properties), Fault> {
    let mut views = Views::default();
    let scene = views.scene(target, floor_m)?;
    let lateral = views.plot("Lateral motion x (m)", "plots/motion/x", Corner2D::LeftTop)?;
    let vertical = views.plot("Vertical motion z (m)", "plots/motion/z", Corner2D::LeftTop)?;
    let more = [
        views.plot("Force x (N)", "plots/force/x", Corner2D::LeftTop)?,
        views.plot("Force y (N)", "plots/force/y", Corner2D::LeftTop)?,
        views.plot("Force z (N)", "plots/force/z", Corner2D::LeftTop)?,
        views.plot("Coupling (m)", "plots/coupling", Corner2D::LeftTop)?,
        views.plot("Gripper", "plots/gripper", Corner2D::LeftTop)?,
        views.plot("Motion y (m)", "plots/motion/y", Corner2D::LeftTop)?,
    ];
    let lanes = StateTimelineView::new("Compliance, state, person, gripper").with_origin("/lanes").into();
    let words = [TextLogView::new("Events").with_origin("/events").into(), TextDocumentView::new("How to read").with_origin("/guide").into()];
    let right: [ContainerLike; 5] =
        [lateral.into(), vertical.into(), Tabs::new(more.map(ContainerLike::from)).into(), lanes, Tabs::new(words).into()];
    let right = Vertical::new(right).with_row_shares(vec![1.2, 1.2, 1.1, 1.1, 0.8]);
    let blueprint = Blueprint::new(Horizontal::new([scene.into(), right.into()]).with_column_shares(vec![1.25, 1.0]))
        .with_blueprint_panel(BlueprintPanel::from_state(PanelState::Hidden))
        .with_selection_panel(SelectionPanel::from_state(PanelState::Hidden))
        .with_time_panel(
            TimePanel::new().with_state(PanelState::Collapsed).with_timeline(SIM_TIME.name).with_play_state(PlayState::Paused),
        );
    Ok((blueprint, views.properties))
}

/// Makes views and keeps their properties.
#[derive(Default)]
struct Views {
    properties: Properties,
}

impl Views {
    fn scene(&mut self, target: Vector3<f64>, floor_m: f64) -> Result<View, Fault> {
        let view = view(Spatial3DView::new("Scene: taught grey, planned blue, executed orange").with_origin("/world"))?;
        let eye = EyeControls3D::new()
            .with_position(convert::vector(&(target + EYE_FROM_TARGET_M)))
            .with_look_target(convert::vector(&target))
            .with_eye_up([0.0, 0.0, 1.0]);
        self.properties.set(&view, "EyeControls3D", eye);
        self.properties.set(&view, "Background", Background::new(BackgroundKind::GradientDark));
        let floor = rerun::components::Plane3D::new([0.0, 0.0, 1.0], floor_m as f32);
        self.properties.set(&view, "LineGrid3D", LineGrid3D::new().with_spacing(0.25).with_plane(floor));
        let start = TimeRange { start: TimeRangeBoundary::Infinite, end: TimeRangeBoundary::AT_CURSOR };
        let until_now = VisibleTimeRanges::new([VisibleTimeRange { timeline: SIM_TIME.name.into(), range: start }]);
        self.properties.set_for_entity(&view, &EXECUTED_PATH.path(), until_now);
        Ok(view)
    }

    fn plot(&mut self, name: &str, origin: &str, legend: Corner2D) -> Result<View, Fault> {
        let view = view(TimeSeriesView::new(name).with_origin(origin))?;
        self.properties.set(&view, "PlotLegend", PlotLegend::new().with_corner(legend));
        self.properties.set(&view, "TimeAxis", TimeAxis::new().with_link(LinkAxis::LinkToGlobal));
        Ok(view)
    }
}

fn view(built: impl Into<ContainerLike>) -> Result<View, Fault> {
    match built.into() {
        ContainerLike::View(view) => Ok(view),
        _ => Err("rerun made a container where a view was asked for".into()),
    }
}
