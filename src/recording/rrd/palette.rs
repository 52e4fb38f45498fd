//! The colours of a recording. Data colours are those of Okabe and Ito, told apart by people with any colour vision.

use rerun::Color;

const fn rgb(r: u8, g: u8, b: u8) -> Color {
    Color(rerun::datatypes::Rgba32::from_rgb(r, g, b))
}

/// What was taught.
pub(super) const TAUGHT: Color = rgb(150, 150, 150);
/// What was generated.
pub(super) const PLANNED: Color = rgb(86, 180, 233);
/// What was executed.
pub(super) const EXECUTED: Color = rgb(230, 159, 0);
/// A stiff state.
pub(super) const STIFF: Color = rgb(0, 158, 115);
/// A state that complies.
pub(super) const COMPLIES: Color = rgb(204, 121, 167);
/// A state that minimises the force error.
pub(super) const MINIMISES: Color = rgb(240, 228, 66);
/// What is measured.
pub(super) const MEASURED: Color = rgb(0, 114, 178);
/// What is expected.
pub(super) const EXPECTED: Color = rgb(240, 228, 66);
/// What the person does.
pub(super) const PERSON: Color = rgb(213, 94, 0);
/// Nothing of interest.
pub(super) const IDLE: Color = rgb(70, 74, 82);
/// Behind the scene.
pub(super) const BACKGROUND: Color = rgb(74, 82, 94);

/// A lighter shade, for text on dark grey.
pub(super) fn light(color: Color) -> Color {
    let [r, g, b, a] = color.to_array();
    let lighter = |c: u8| c + (255 - c) / 5 * 2;
    Color::from_unmultiplied_rgba(lighter(r), lighter(g), lighter(b), a)
}
