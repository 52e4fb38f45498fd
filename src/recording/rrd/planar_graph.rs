//! Which state follows which (the paper's Fig. 4).

use rerun::datatypes::Range2D;
use rerun::{Color, GraphEdges, GraphNodes};

use super::palette;
use super::planar_entity::GRAPH;
use super::planar_recorder::PlanarRecorder;
use super::recorder::Fault;
use crate::planar::{Transitions, chain_color};

/// Width of the graph, and distance of the lanes of two chains (points of the view).
const SIZE: [f64; 2] = [620.0, 56.0];

/// Space around the outermost states (points of the view).
const MARGIN: [f64; 2] = [50.0, 26.0];

/// What the view of the graph shows: every lane, and the boxes of the outermost states.
pub(super) fn bounds(transitions: &Transitions) -> Range2D {
    let phases = || transitions.graph.nodes.iter().map(|node| node.phase * SIZE[0]);
    let x = [phases().fold(0.0, f64::min) - MARGIN[0], phases().fold(SIZE[0], f64::max) + MARGIN[0]];
    // States of no chain, where there are some, lie on a lane of their own below.
    let in_none = |state: usize| transitions.chains.iter().all(|chain| !chain.states.contains(&state));
    let lanes = transitions.chains.len() + usize::from((0..transitions.graph.nodes.len()).any(in_none));
    let y = [-MARGIN[1], lanes.saturating_sub(1) as f64 * SIZE[1] + MARGIN[1]];
    Range2D { x_range: x.into(), y_range: y.into() }
}

/// Logs the graph: states from left to right by their phase, one lane per chain; states of several chains lie between.
pub(super) fn log_graph(recorder: &PlanarRecorder, transitions: &Transitions) -> Result<(), Fault> {
    let (graph, chains) = (&transitions.graph, &transitions.chains);
    let of = |state: usize| (0..chains.len()).filter(|chain| chains[*chain].states.contains(&state)).collect::<Vec<_>>();
    let place = |(index, phase): (usize, f64)| {
        let of = of(index);
        let lane = if of.is_empty() { chains.len() as f64 } else { of.iter().sum::<usize>() as f64 / of.len() as f64 };
        [(phase * SIZE[0]) as f32, (lane * SIZE[1]) as f32]
    };
    let color = |index: usize| -> Color {
        match of(index)[..] {
            [chain] => palette::rgb(chain_color(chain)),
            _ => palette::TAUGHT,
        }
    };
    let count = graph.nodes.len();
    let names = graph.nodes.iter().map(|node| node.state.to_string());
    let labels = graph.nodes.iter().map(|node| if node.start { format!("{}: start", node.state) } else { node.state.to_string() });
    let nodes = GraphNodes::new(names)
        .with_positions(graph.nodes.iter().map(|node| node.phase).enumerate().map(place))
        .with_colors((0..count).map(color))
        .with_labels(labels);
    recorder.always(GRAPH.path(), &nodes)?;
    let edges = graph.edges.iter().map(|edge| (edge.from.to_string(), edge.to.to_string()));
    recorder.always(GRAPH.path(), &GraphEdges::new(edges).with_directed_edges())
}
