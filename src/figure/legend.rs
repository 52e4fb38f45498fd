//! The legend: every name once, with a sample of what it looks like, below the panels.

use plotters::coord::Shift;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::canvas::{Drawn, Page, TEXT_PT, plain, steps, width_pt};
use super::chart::Figure;
use super::draw_mark::draw_sample;
use super::mark::Mark;

/// Height of a row (pt).
const ROW_PT: f64 = 15.0;
/// Space above, to the labels of the panels (pt).
const ABOVE_PT: f64 = 8.0;
/// Width of a sample with the space behind it (pt).
const SAMPLE_PT: f64 = 34.0;
/// Space between columns, and at both sides (pt).
const GAP_PT: f64 = 14.0;

/// The entries in rows and columns.
pub(super) struct Legend<'a> {
    entries: Vec<&'a Mark>,
    columns: usize,
    column_pt: f64,
    left_pt: f64,
}

impl<'a> Legend<'a> {
    /// The legend of a figure on a page of this width (pt).
    pub fn of(figure: &'a Figure, page_pt: f64) -> Self {
        let mut entries: Vec<&Mark> = Vec::new();
        for mark in figure.panels.iter().flat_map(|panel| &panel.marks) {
            if !mark.legend.is_empty() && entries.iter().all(|known| known.legend != mark.legend) {
                entries.push(mark);
            }
        }
        let widest = entries.iter().map(|mark| width_pt(&mark.legend, TEXT_PT)).fold(0.0, f64::max);
        let column_pt = SAMPLE_PT + widest + GAP_PT;
        let columns = (((page_pt - 2.0 * GAP_PT) / column_pt) as usize).clamp(1, entries.len().max(1));
        let left_pt = ((page_pt - columns as f64 * column_pt + GAP_PT) / 2.0).max(GAP_PT);
        Self { entries, columns, column_pt, left_pt }
    }

    /// Its height (pt).
    pub fn height_pt(&self) -> f64 {
        if self.entries.is_empty() { 0.0 } else { self.entries.len().div_ceil(self.columns) as f64 * ROW_PT + ABOVE_PT + GAP_PT }
    }

    /// Draws it at the top of an area.
    pub fn draw(&self, area: &Page<'_, Shift>) -> Drawn<()> {
        for (index, mark) in self.entries.iter().enumerate() {
            let x = self.left_pt + (index % self.columns) as f64 * self.column_pt;
            let y = ABOVE_PT + (index / self.columns) as f64 * ROW_PT + ROW_PT / 2.0;
            draw_sample(mark, [x, y], SAMPLE_PT - 8.0, area)?;
            let style = plain(Pos::new(HPos::Left, VPos::Center));
            area.draw_text(&mark.legend, &style, (steps(x + SAMPLE_PT), steps(y))).map_err(|error| error.to_string())?;
        }
        Ok(())
    }
}
