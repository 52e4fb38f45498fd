//! The page: what the parts of a figure have in common.

use plotters::prelude::{DrawingArea, RGBAColor, SVGBackend};
use plotters::style::{Color, FontFamily, FontStyle, RGBColor, ShapeStyle, TextStyle};
use plotters::style::{FontDesc, text_anchor::Pos};

use crate::palette::{BLACK, Rgb};

/// Steps of the drawing library per point of the page: it only knows whole ones, and a curve needs finer.
pub(super) const STEPS_PER_PT: f64 = 10.0;

/// Size of text (pt).
pub(super) const TEXT_PT: f64 = 9.0;
/// Size of titles of panels (pt).
pub(super) const TITLE_PT: f64 = 10.0;
/// Size of the figure's title (pt).
pub(super) const HEADING_PT: f64 = 12.0;

/// Width of a character, as a fraction of the text's size: more than that of most fonts without serifs.
const CHARACTER: f64 = 0.56;

/// Part of the page in steps.
pub(super) type Page<'a, Coordinates> = DrawingArea<SVGBackend<'a>, Coordinates>;

/// What goes wrong while drawing, in words.
pub(super) type Drawn<T> = Result<T, String>;

/// A length on the page in steps.
pub(super) fn steps(pt: f64) -> i32 {
    (pt * STEPS_PER_PT).round() as i32
}

/// Width of words (pt), at least as wide as they are drawn.
pub(super) fn width_pt(text: &str, size_pt: f64) -> f64 {
    text.chars().count() as f64 * CHARACTER * size_pt
}

/// A colour that covers `opacity` of what is behind it.
pub(super) fn color(rgb: Rgb, opacity: f64) -> RGBAColor {
    RGBColor(rgb.red, rgb.green, rgb.blue).mix(opacity.clamp(0.0, 1.0))
}

/// A line of this width.
pub(super) fn stroke(rgb: Rgb, width_pt: f64) -> ShapeStyle {
    ShapeStyle { color: color(rgb, 1.0), filled: false, stroke_width: steps(width_pt).max(1) as u32 }
}

/// A filled shape without a border.
pub(super) fn fill(rgb: Rgb, opacity: f64) -> ShapeStyle {
    ShapeStyle { color: color(rgb, opacity), filled: true, stroke_width: 0 }
}

/// Text of this size. The library writes its sizes divided by 1.24.
pub(super) fn text(size_pt: f64, rgb: Rgb, style: FontStyle, anchor: Pos) -> TextStyle<'static> {
    let font = FontDesc::new(FontFamily::SansSerif, size_pt * STEPS_PER_PT * 1.24, style);
    TextStyle { font, color: color(rgb, 1.0).to_backend_color(), pos: anchor }
}

/// Plain black text.
pub(super) fn plain(anchor: Pos) -> TextStyle<'static> {
    text(TEXT_PT, BLACK, FontStyle::Normal, anchor)
}
