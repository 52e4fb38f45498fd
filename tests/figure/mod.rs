//! Figures as SVG.

mod drawing;
mod transition_graph;
