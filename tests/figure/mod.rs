//! Figures as SVG.

mod arm;
mod drawing;
mod transition_graph;
