//! Colours that people with any colour vision tell apart: one palette for figures and recordings, so that a thing has one colour everywhere.

pub mod meaning;
mod okabe_ito;
mod rgb;

pub use okabe_ito::{BLACK, BLUE, BROWN, GREEN, GREY, LIME, MAGENTA, MAROON, ORANGE, PINK, SKY_BLUE, VERMILION, VIOLET, YELLOW};
pub use rgb::Rgb;
