//! What the colours of a recording mean.

use rerun::Color;

use crate::palette::{Rgb, meaning};

/// A colour in rerun's terms.
pub(super) const fn rgb(color: Rgb) -> Color {
    Color(rerun::datatypes::Rgba32::from_rgb(color.red, color.green, color.blue))
}

/// What was taught.
pub(super) const TAUGHT: Color = rgb(meaning::TAUGHT);
/// The same in a scene: lighter, for objects are as bright as that.
pub(super) const TAUGHT_PATH: Color = rgb(Rgb::new(188, 188, 188));
/// What was generated.
pub(super) const PLANNED: Color = rgb(meaning::PLANNED);
/// What was executed.
pub(super) const EXECUTED: Color = rgb(meaning::EXECUTED);
/// What another method generates.
pub(super) const BASELINE: Color = rgb(meaning::BASELINE);
/// A stiff state.
pub(super) const STIFF: Color = rgb(meaning::STIFF);
/// A state that complies.
pub(super) const COMPLIES: Color = rgb(meaning::COMPLIES);
/// A state that minimises the force error.
pub(super) const MINIMISES: Color = rgb(meaning::MINIMISES);
/// What is measured.
pub(super) const MEASURED: Color = rgb(meaning::MEASURED);
/// What is expected.
pub(super) const EXPECTED: Color = rgb(meaning::EXPECTED);
/// What the person does.
pub(super) const PERSON: Color = rgb(meaning::PERSON);
/// Contact that must not be.
pub(super) const FAULT: Color = rgb(Rgb::new(230, 30, 60));
/// Contact that may be, and nearest points.
pub(super) const TOUCH: Color = rgb(Rgb::new(255, 255, 255));
/// Nothing of interest.
pub(super) const IDLE: Color = rgb(Rgb::new(70, 74, 82));
/// Behind the scene.
pub(super) const BACKGROUND: Color = rgb(Rgb::new(74, 82, 94));

/// A lighter shade, for lines on black.
pub(super) fn light(color: Color) -> Color {
    lighter(color, 2)
}

/// A much lighter one, for words on grey.
pub(super) fn for_words(color: Color) -> Color {
    lighter(color, 3)
}

/// A colour that is so many fifths of the way to white.
fn lighter(color: Color, fifths: u8) -> Color {
    let [r, g, b, a] = color.to_array();
    let lighter = |c: u8| c + (255 - c) / 5 * fifths;
    Color::from_unmultiplied_rgba(lighter(r), lighter(g), lighter(b), a)
}
