//! The views of a layout, each with its properties.

use rerun::EntityPath;
use rerun::blueprint::components::{BackgroundKind, LinkAxis};
use rerun::blueprint::{ContainerLike, Spatial3DView, TextLogView, TimeSeriesView, View};
use rerun::datatypes::{TimeRange, TimeRangeBoundary, VisibleTimeRange};
use rerun::external::re_sdk_types::blueprint::archetypes::{
    Background, EyeControls3D, LineGrid3D, PlotLegend, ScalarAxis, TextLogColumns, TimeAxis, VisibleTimeRanges,
};
use rerun::external::re_sdk_types::blueprint::datatypes::{TextLogColumn, TextLogColumnKind, TimelineColumn};

use super::axis_range::{LEAST_STEP, LEAST_STEP_OF_HIGH, LEAST_STEP_OF_LOW, Ranges};
use super::blueprint_property::Properties;
use super::convert;
use super::entity_path::{SIM_TIME, TIMELINES};
use super::layout::Shown;
use super::palette;
use super::recorder::Fault;

/// A coordinate is seen over at least this range (m): noise of one that stands still is no motion.
const LEAST_RANGE_M: f64 = 0.02;

/// What the plot of a coordinate is called; `others` are the colours of what stands beside the run.
fn motion_title(axis: &str, others: &str) -> String {
    format!("Motion {axis} (m): taught grey, planned blue, executed orange{others}")
}

/// Makes views and keeps their properties.
#[derive(Default)]
pub(super) struct Views {
    pub properties: Properties,
    /// What has been told, as far as it is known.
    pub ranges: Ranges,
}

impl Views {
    /// A scene seen by the camera, in which the whole of growing paths is seen.
    pub fn scene(
        &mut self,
        title: &str,
        origin: &str,
        growing: impl IntoIterator<Item = EntityPath>,
        shown: &Shown<'_>,
    ) -> Result<View, Fault> {
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
        for path in growing {
            self.properties.set_for_entity(&view, &path, VisibleTimeRanges::new(ranges.clone()));
        }
        Ok(view)
    }

    /// A plot over time, linked with all others. A legend would stand over the data: titles name the colours.
    pub fn plot(&mut self, name: &str, origin: &str) -> Result<View, Fault> {
        self.plot_with(name, origin, (LEAST_STEP, 0.0))
    }

    /// The same for a place that is lower than others, of what may end at a bound: with free space above, so that a line there is not taken for the frame.
    pub fn bounded_plot(&mut self, name: &str, origin: &str) -> Result<View, Fault> {
        let range = self.ranges.of(origin, LEAST_STEP_OF_LOW, 0.0);
        self.plot_in(name, origin, range.map(|[low, high]| [low, high + 0.15 * (high - low)]))
    }

    /// The same for a place that is higher than others.
    pub fn high_plot(&mut self, name: &str, origin: &str) -> Result<View, Fault> {
        self.plot_with(name, origin, (LEAST_STEP_OF_HIGH, 0.0))
    }

    fn plot_with(&mut self, name: &str, origin: &str, (least_step, least_range): (f64, f64)) -> Result<View, Fault> {
        let range = self.ranges.of(origin, least_step, least_range);
        self.plot_in(name, origin, range)
    }

    /// A plot of a range; the viewer chooses one if there is none.
    fn plot_in(&mut self, name: &str, origin: &str, range: Option<[f64; 2]>) -> Result<View, Fault> {
        let view = view(TimeSeriesView::new(name).with_origin(origin))?;
        self.properties.set(&view, "PlotLegend", PlotLegend::new().with_visible(false));
        self.properties.set(&view, "TimeAxis", TimeAxis::new().with_link(LinkAxis::LinkToGlobal));
        if let Some(range) = range {
            self.properties.set(&view, "ScalarAxis", ScalarAxis::new().with_range(range));
        }
        Ok(view)
    }

    /// A plot of what lies between 0 and 1.
    pub fn fraction_plot(&mut self, name: &str, origin: &str) -> Result<View, Fault> {
        self.plot_in(name, origin, Some([-0.1, 1.1]))
    }

    /// A coordinate over time.
    pub fn motion(&mut self, axis: &str, others: &str) -> Result<View, Fault> {
        self.coordinate(&motion_title(axis, others), &format!("plots/motion/{axis}"))
    }

    /// The same under another name.
    pub fn coordinate(&mut self, name: &str, origin: &str) -> Result<View, Fault> {
        self.plot_with(name, origin, (LEAST_STEP, LEAST_RANGE_M))
    }

    pub fn events(&mut self) -> Result<View, Fault> {
        let view = view(TextLogView::new("All events").with_origin("/events"))?;
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
