//! What everything in the plane is drawn with: lines and points in rerun's numbers.

use rerun::{Color, LineStrips2D, Radius};

/// The order of points (-): they lie on every path.
pub(super) const ON_TOP: f32 = 30.0;

/// An outline (m) as a line that ends where it starts.
pub(super) fn closed(mut outline: Vec<[f64; 2]>) -> Vec<[f32; 2]> {
    outline.extend(outline.first().copied());
    points(&outline)
}

/// A path (m).
pub(super) fn points(path: &[[f64; 2]]) -> Vec<[f32; 2]> {
    path.iter().map(point).collect()
}

/// A place (m).
pub(super) fn point(place: &[f64; 2]) -> [f32; 2] {
    place.map(|coordinate| coordinate as f32)
}

/// Lines of one colour, `width` points wide on the screen.
pub(super) fn strips(lines: Vec<Vec<[f32; 2]>>, color: Color, width: f32) -> LineStrips2D {
    LineStrips2D::new(lines).with_colors([color]).with_radii([Radius::new_ui_points(width / 2.0)])
}
