//! Figures as SVG and PNG.

mod arm;
mod drawing;
#[cfg(feature = "png")]
mod picture;
mod planar;
mod transition_graph;
