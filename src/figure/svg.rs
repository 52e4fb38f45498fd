//! From a figure to SVG: the heading, the panels in rows, the legend below.

use plotters::prelude::{IntoDrawingArea, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, WHITE};

use super::canvas::{Drawn, HEADING_PT, STEPS_PER_PT, steps, text};
use super::chart::Figure;
use super::draw_chart::draw_chart;
use super::error::FigureError;
use super::legend::Legend;
use crate::palette::BLACK;

/// Height of the heading (pt).
const HEADING_HEIGHT_PT: f64 = 26.0;

/// The figure as an SVG document. Equal figures give equal text.
///
/// # Errors
/// When a panel has nothing to draw.
pub fn svg(figure: &Figure) -> Result<String, FigureError> {
    if figure.panels.is_empty() || figure.panels.iter().any(|panel| !panel.marks.iter().any(|mark| mark.is_finite())) {
        return Err(FigureError::Empty(figure.title.clone()));
    }
    let columns = figure.columns.clamp(1, figure.panels.len());
    let rows = figure.panels.len().div_ceil(columns);
    let width_pt = columns as f64 * figure.panel_size_pt[0];
    let legend = Legend::of(figure, width_pt);
    let height_pt = HEADING_HEIGHT_PT + rows as f64 * figure.panel_size_pt[1] + legend.height_pt();
    let mut document = String::new();
    draw(figure, [columns, rows], &legend, [width_pt, height_pt], &mut document)
        .map_err(|message| FigureError::Drawing { title: figure.title.clone(), message })?;
    Ok(in_points(&document, [width_pt, height_pt]))
}

fn draw(figure: &Figure, [columns, rows]: [usize; 2], legend: &Legend, size_pt: [f64; 2], document: &mut String) -> Drawn<()> {
    let fault = |error: plotters::drawing::DrawingAreaErrorKind<std::io::Error>| error.to_string();
    let size = size_pt.map(|pt| steps(pt) as u32);
    let root = SVGBackend::with_string(document, (size[0], size[1])).into_drawing_area();
    root.fill(&WHITE).map_err(fault)?;
    let heading = text(HEADING_PT, BLACK, FontStyle::Bold, Pos::new(HPos::Center, VPos::Center));
    root.draw_text(&figure.title, &heading, (size[0] as i32 / 2, steps(HEADING_HEIGHT_PT / 2.0))).map_err(fault)?;
    let (_, below) = root.split_vertically(steps(HEADING_HEIGHT_PT));
    let (panels, foot) = below.split_vertically(steps(rows as f64 * figure.panel_size_pt[1]));
    for (panel, area) in figure.panels.iter().zip(panels.split_evenly((rows, columns))) {
        draw_chart(panel, figure.panel_size_pt, &area)?;
    }
    legend.draw(&foot)?;
    root.present().map_err(fault)
}

/// The library counts steps: the page is as many points wide as the figure says, whatever the steps are.
fn in_points(document: &str, size_pt: [f64; 2]) -> String {
    let [width, height] = size_pt.map(steps);
    let counted = format!("width=\"{width}\" height=\"{height}\" viewBox");
    let measured = format!("width=\"{}pt\" height=\"{}pt\" viewBox", f64::from(width) / STEPS_PER_PT, f64::from(height) / STEPS_PER_PT);
    document.replacen(&counted, &measured, 1)
}
