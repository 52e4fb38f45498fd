//! Which state follows which: a transition graph as a panel (the paper's Fig. 4).

use super::chart::Chart;
use super::graph::{Edge, NODE_PT, Node, graph};
use super::mark::{Mark, Symbol};
use crate::learning::phmm::{StateChain, TransitionGraph};
use crate::palette::{BLACK, GREY};
use crate::planar::chain_color;

/// Width of the graph, and distance of the lanes of two chains (pt).
const GRAPH_PT: [f64; 2] = [560.0, 90.0];
/// Widths of the rarest and of the surest edge (pt).
const EDGE_PT: [f64; 2] = [0.5, 2.0];
/// States nearer in phase than this share of the phase's range are drawn this far apart (-): or their discs would touch.
const LEAST_STEP: f64 = 0.055;

/// The graph as a panel `width_pt` wide: states from left to right in the order of their phase, one lane per chain, on
/// arrows that are not the only way on the share of the departures that take them. States of several chains lie between their lanes, states of none below all lanes, in grey.
#[must_use]
pub fn transitions(title: &str, states: &TransitionGraph, chains: &[StateChain], width_pt: f64) -> Chart {
    let along = places(states);
    let node = |(index, along): (usize, &f64)| {
        let of: Vec<usize> = (0..chains.len()).filter(|chain| chains[*chain].states.contains(&index)).collect();
        let lane = if of.is_empty() { chains.len() as f64 } else { of.iter().sum::<usize>() as f64 / of.len() as f64 };
        let (color, legend) = match of[..] {
            [] => (GREY, "in no chain".to_owned()),
            [chain] => (chain_color(chain), chain_name(chain)),
            _ => (GREY.lighter(0.5), "in several chains".to_owned()),
        };
        let mark = if states.nodes[index].start { "*" } else { "" };
        Node { name: format!("{index}{mark}"), at: [along * GRAPH_PT[0], -lane * GRAPH_PT[1]], color, legend }
    };
    let nodes: Vec<Node> = along.iter().enumerate().map(node).collect();
    let edge = |edge: &crate::learning::phmm::TransitionEdge| Edge {
        from: edge.from,
        to: edge.to,
        label: if alone(states, edge.from) { String::new() } else { format!("{:.2}", edge.probability) },
        width_pt: EDGE_PT[0] + (EDGE_PT[1] - EDGE_PT[0]) * edge.probability,
        color: BLACK,
    };
    let edges: Vec<Edge> = states.edges.iter().map(edge).collect();
    let mut chart = Chart::bare(title);
    // The legend names the chains in their order, whichever state comes first.
    chart.marks.extend((0..chains.len()).map(|chain| Mark::entry(&chain_name(chain), chain_color(chain), Symbol::Disc, NODE_PT)));
    chart.marks.extend(graph(&nodes, &edges, GRAPH_PT[0] / width_pt.max(1.0)));
    chart
}

/// Whether only one state follows a state.
fn alone(states: &TransitionGraph, from: usize) -> bool {
    states.edges.iter().filter(|edge| edge.from == from).count() == 1
}

/// What people call a chain: they count from 1.
pub(super) fn chain_name(chain: usize) -> String {
    format!("chain {}", chain + 1)
}

/// Where each state is from left (0) to right: by its phase, at least [`LEAST_STEP`] after the state before it.
fn places(states: &TransitionGraph) -> Vec<f64> {
    let phases: Vec<f64> = states.nodes.iter().map(|node| node.phase).collect();
    let low = phases.iter().copied().fold(f64::INFINITY, f64::min);
    let range = (phases.iter().copied().fold(f64::NEG_INFINITY, f64::max) - low).max(f64::MIN_POSITIVE);
    let mut order: Vec<usize> = (0..phases.len()).collect();
    order.sort_by(|a, b| phases[*a].total_cmp(&phases[*b]));
    let mut places = vec![0.0; phases.len()];
    let mut before = f64::NEG_INFINITY;
    for state in order {
        before = ((phases[state] - low) / range).max(before + LEAST_STEP);
        places[state] = before;
    }
    places
}
