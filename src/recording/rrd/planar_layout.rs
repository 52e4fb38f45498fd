//! The layout that the recording of a planar experiment opens with: the plane at the left, a view per method, and below it how to read it; forcing
//! terms, the transition graph and the result at the right.

use rerun::blueprint::components::{BackgroundKind, LinkAxis, PanelState, PlayState};
use rerun::blueprint::{
    Blueprint, BlueprintPanel, ContainerLike, GraphView, Grid, Horizontal, SelectionPanel, Spatial2DView, Tabs, TextDocumentView,
    TimePanel, TimeSeriesView, Vertical, View,
};
use rerun::datatypes::{Range2D, TimeInt, TimeRange, TimeRangeBoundary};
use rerun::external::re_sdk_types::blueprint::archetypes::{Background, PlotLegend, TimeAxis, VisualBounds2D};

use super::blueprint_property::Properties;
use super::entity_path::Entity;
use super::planar_entity::{CLEARANCES, CONTENTS, GUIDE, PHASE_INPUT, RESULT};
use super::planar_forcing::recorded;
use super::planar_grid::{bounds, with_numbers};
use super::planar_pages::{Page, pages_of};
use super::planar_recorder::ticks;
use super::recorder::Fault;
use super::{palette, planar_graph};
use crate::planar::{Guidance, Method, PlanarOutcome};

/// The layout with the properties of its views.
pub(super) fn layout(outcome: &PlanarOutcome) -> Result<(Blueprint, Properties), Fault> {
    let mut views = Views { properties: Properties::default(), bounds: with_numbers(bounds(outcome)), inputs: inputs(outcome) };
    let mut maps: Vec<ContainerLike> = Vec::new();
    for guidance in outcome.guidances() {
        for method in outcome.methods_with(guidance) {
            maps.push(views.map(guidance, method)?.into());
        }
    }
    // One row for what is told in one way.
    let columns = outcome.guidances().iter().map(|guidance| outcome.methods_with(*guidance).len()).max().unwrap_or(1);
    let mut forcing: Vec<ContainerLike> = Vec::new();
    for (guidance, method) in recorded(outcome) {
        let mut pages: Vec<ContainerLike> = Vec::new();
        for Page { name, look, entities } in pages_of(outcome, guidance, method) {
            let [x, y] = entities;
            let plots = [views.forcing("x", &look, x)?.into(), views.forcing("y", &look, y)?.into()];
            pages.push(Vertical::new(plots).with_name(name).into());
        }
        let name = called(guidance, method);
        forcing.push(if pages.len() == 1 { pages.remove(0) } else { Tabs::new(pages).with_name(name).into() });
    }
    let mut right: Vec<ContainerLike> = vec![Tabs::new(forcing).into()];
    let mut shares = vec![2.5];
    if let Some(transitions) = &outcome.transitions {
        let graph = GraphView::new("States and chains, the side not told").with_origin("/transitions");
        right.push(graph.with_visual_bounds(&VisualBounds2D::new(planar_graph::bounds(transitions))).into());
        shares.push(0.55);
    }
    right.push(pages([("Result", &RESULT), ("Clearances", &CLEARANCES)]).into());
    shares.push(1.05);
    let maps = Grid::new(maps).with_grid_columns(columns as u32);
    // A new reader reads first: what says how to is never behind something else.
    let guide = pages([("How to read", &GUIDE), ("What is in the recording", &CONTENTS)]);
    let left = Vertical::new([maps.into(), guide.into()]).with_row_shares(vec![4.0, 1.0]);
    let right = Vertical::new(right).with_row_shares(shares);
    let blueprint = Blueprint::new(Horizontal::new([left.into(), right.into()]).with_column_shares(vec![1.2, 1.0]))
        .with_blueprint_panel(BlueprintPanel::from_state(PanelState::Hidden))
        .with_selection_panel(SelectionPanel::from_state(PanelState::Hidden))
        .with_time_panel(
            TimePanel::new().with_state(PanelState::Collapsed).with_timeline(PHASE_INPUT.name).with_play_state(PlayState::Paused),
        );
    Ok((blueprint, views.properties))
}

/// Makes views and keeps their properties.
struct Views {
    properties: Properties,
    /// What the plane's views show (m): the same in all of them, or they could not be compared.
    bounds: [[f64; 2]; 2],
    /// What the plots show, on the timeline.
    inputs: [i64; 2],
}

impl Views {
    fn map(&mut self, guidance: Guidance, method: Method) -> Result<View, Fault> {
        let own = format!("/map/movements/{}/{}/**", guidance.key(), method.key());
        let shared = ["/map", "/map/grid/**", "/map/obstacles", "/map/demonstrations", "/map/goals"].map(str::to_owned);
        let name = called(guidance, method);
        let view = view(Spatial2DView::new(name).with_origin("/").with_contents(shared.into_iter().chain([own])))?;
        let [x, y] = self.bounds;
        let range = Range2D { x_range: x.into(), y_range: [-y[1], -y[0]].into() };
        self.properties.set(&view, "VisualBounds2D", VisualBounds2D::new(range));
        let white = palette::rgb(crate::palette::Rgb::new(255, 255, 255));
        self.properties.set(&view, "Background", Background::new(BackgroundKind::SolidColor).with_color(white));
        Ok(view)
    }

    /// A legend of dozens of curves would cover them: the title names what is drawn.
    fn forcing(&mut self, axis: &str, look: &str, entities: Vec<String>) -> Result<View, Fault> {
        let name = format!("Forcing along {axis} (m), 0 s start … 1 s end; {look}");
        let view = view(TimeSeriesView::new(name).with_origin("/forcing").with_contents(entities))?;
        self.properties.set(&view, "PlotLegend", PlotLegend::new().with_visible(false));
        // Left to itself the viewer shows a piece around the cursor.
        let [from, to] = self.inputs;
        let whole = TimeRange { start: TimeRangeBoundary::Absolute(TimeInt(from)), end: TimeRangeBoundary::Absolute(TimeInt(to)) };
        self.properties.set(&view, "TimeAxis", TimeAxis::new().with_link(LinkAxis::Independent).with_view_range(whole));
        Ok(view)
    }
}

/// The least and the greatest phase input, with a little space around, on the timeline.
fn inputs(outcome: &PlanarOutcome) -> [i64; 2] {
    let inputs = outcome.forcing.iter().flat_map(|curve| &curve.phase);
    let [low, high] = inputs.fold([0.0_f64, 1.0_f64], |[low, high], input| [low.min(*input), high.max(*input)]);
    [ticks(low - 0.02), ticks(high + 0.02)]
}

/// Two pages of words, the second behind the first.
fn pages(pages: [(&str, &Entity); 2]) -> Tabs {
    Tabs::new(pages.map(|(name, entity)| TextDocumentView::new(name).with_origin(entity.pattern).into()))
}

/// A method's name, with what it is told.
fn called(guidance: Guidance, method: Method) -> String {
    guidance.told().map_or_else(|| method.title().to_owned(), |told| format!("{}, {told}", method.title()))
}

fn view(built: impl Into<ContainerLike>) -> Result<View, Fault> {
    match built.into() {
        ContainerLike::View(view) => Ok(view),
        _ => Err("rerun made a container where a view was asked for".into()),
    }
}
