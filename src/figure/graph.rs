//! A graph of nodes and weighted edges as marks.

use nalgebra::Vector2;

use super::canvas::{TEXT_PT, width_pt};
use super::mark::{Anchor, Mark, Shape, Symbol};
use crate::palette::{BLACK, Rgb};

/// Radius of a node (pt).
pub(super) const NODE_PT: f64 = 11.0;

/// A node.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// What is written in it.
    pub name: String,
    /// Where it is.
    pub at: [f64; 2],
    /// Its colour.
    pub color: Rgb,
    /// What the legend calls nodes of this colour; may be empty.
    pub legend: String,
}

/// A directed edge.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge {
    /// Number of the node that it leaves.
    pub from: usize,
    /// Number of the node that it enters.
    pub to: usize,
    /// What is written beside it.
    pub label: String,
    /// Its width (pt).
    pub width_pt: f64,
    /// Its colour.
    pub color: Rgb,
}

/// The marks of a graph in a panel with one scale, where `pt` is the length of a point in the units of the nodes' places. Edges bend to
/// their left, so that two between the same nodes do not cover each other.
#[must_use]
pub fn graph(nodes: &[Node], edges: &[Edge], pt: f64) -> Vec<Mark> {
    let mut marks: Vec<Mark> = Vec::new();
    for edge in edges {
        let (Some(from), Some(to)) = (nodes.get(edge.from), nodes.get(edge.to)) else { continue };
        let (start, end) = (Vector2::from(from.at), Vector2::from(to.at));
        let way = end - start;
        let Some(along) = way.try_normalize(0.0) else { continue };
        let left = Vector2::new(-along.y, along.x);
        let bend = (start + end) / 2.0 + left * (way.norm() * 0.16);
        let curve = |t: f64| start * (1.0 - t).powi(2) + bend * (2.0 * t * (1.0 - t)) + end * t.powi(2);
        // The arrow is seen from the edge of one node to that of the other.
        let margin = (NODE_PT * pt / way.norm()).min(0.45);
        let points = (0..=24).map(|i| curve(margin + (1.0 - 2.0 * margin) * f64::from(i) / 24.0).into()).collect();
        marks.push(Mark { legend: String::new(), color: edge.color, shape: Shape::Arrow { points, width_pt: edge.width_pt } });
        if edge.label.is_empty() {
            continue;
        }
        let beside = curve(0.5) + left * (clear_of_edge_pt(&edge.label, left) * pt);
        marks.push(Mark::words(BLACK, beside.into(), Anchor::Middle, &edge.label));
    }
    for node in nodes {
        marks.push(Mark::symbols(&node.legend, node.color, Symbol::Disc, NODE_PT, vec![node.at]));
        marks.push(Mark::words(BLACK, node.at, Anchor::Middle, &node.name));
    }
    marks
}

/// How far the middle of a label is from its edge (pt) for the label's box, seen along the direction `aside`, to leave a gap to it.
fn clear_of_edge_pt(label: &str, aside: Vector2<f64>) -> f64 {
    /// The gap (pt).
    const GAP_PT: f64 = 2.0;
    aside.x.abs() * width_pt(label, TEXT_PT) / 2.0 + aside.y.abs() * TEXT_PT / 2.0 + GAP_PT
}
