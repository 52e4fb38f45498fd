//! Drawings for papers: what a run left behind as SVG and PNG, the only room that knows plotters and resvg.
//!
//! A [`Figure`] is plain data: panels of marks in the units of their axes, and one legend for all. [`svg()`] draws it. Text stays text and no
//! font is needed to draw it; nothing lies outside of the page. With the feature `png`, a picture is made of the drawing. Colours are those of [`crate::palette`].

mod arc;
mod arm_compliance;
mod arm_forces;
mod arm_forcing;
mod arm_motion;
mod arm_paths;
mod arm_run;
mod arm_settings;
mod arm_states;
mod canvas;
mod chart;
mod draw_chart;
mod draw_mark;
mod error;
mod extent;
mod graph;
mod legend;
mod mark;
mod planar_forcing;
mod planar_paths;
#[cfg(feature = "png")]
mod raster;
mod state_numbers;
mod stretches;
mod svg;
mod ticks;
mod transitions;

pub use arm_compliance::arm_compliance;
pub use arm_forces::arm_forces;
pub use arm_forcing::arm_forcing;
pub use arm_motion::arm_motion;
pub use arm_paths::arm_paths;
pub use arm_run::ArmRun;
pub use arm_settings::arm_settings;
pub use arm_states::arm_states;
pub use chart::{Axis, Chart, Figure};
pub use error::FigureError;
pub use graph::{Edge, Node, graph};
pub use mark::{Anchor, Mark, Shape, Symbol};
pub use planar_forcing::planar_forcing;
pub use planar_paths::planar_paths;
#[cfg(feature = "png")]
pub use raster::png;
pub use svg::svg;
pub use transitions::transitions;
