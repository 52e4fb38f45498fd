//! What the colours of a recording mean.

use rerun::Color;

use crate::palette::{self, Rgb};

/// A colour in rerun's terms.
pub(super) const fn rgb(color: Rgb) -> Color {
    Color(rerun::datatypes::Rgba32::from_rgb(color.red, color.green, color.blue))
}

/// What was taught.
pub(super) const TAUGHT: Color = rgb(palette::GREY);
/// What was generated.
pub(super) const PLANNED: Color = rgb(palette::SKY_BLUE);
/// What was executed.
pub(super) const EXECUTED: Color = rgb(palette::ORANGE);
/// A stiff state.
pub(super) const STIFF: Color = rgb(palette::GREEN);
/// A state that complies.
pub(super) const COMPLIES: Color = rgb(palette::PURPLE);
/// A state that minimises the force error.
pub(super) const MINIMISES: Color = rgb(palette::YELLOW);
/// What is measured.
pub(super) const MEASURED: Color = rgb(palette::BLUE);
/// What is expected.
pub(super) const EXPECTED: Color = rgb(palette::YELLOW);
/// What the person does.
pub(super) const PERSON: Color = rgb(palette::VERMILION);
/// Nothing of interest.
pub(super) const IDLE: Color = rgb(Rgb::new(70, 74, 82));
/// Behind the scene.
pub(super) const BACKGROUND: Color = rgb(Rgb::new(74, 82, 94));

/// A lighter shade, for text on dark grey.
pub(super) fn light(color: Color) -> Color {
    let [r, g, b, a] = color.to_array();
    let lighter = |c: u8| c + (255 - c) / 5 * 2;
    Color::from_unmultiplied_rgba(lighter(r), lighter(g), lighter(b), a)
}
