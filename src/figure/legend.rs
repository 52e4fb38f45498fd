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
    entries: Vec<(&'a Mark, String)>,
    columns: usize,
    column_pt: f64,
    left_pt: f64,
}

impl<'a> Legend<'a> {
    /// The legend of a figure on a page of this width (pt).
    pub fn of(figure: &'a Figure, page_pt: f64) -> Self {
        let mut entries: Vec<(&Mark, String)> = Vec::new();
        let room_pt = page_pt - 2.0 * GAP_PT - SAMPLE_PT;
        for mark in figure.panels.iter().flat_map(|panel| &panel.marks) {
            if !mark.legend.is_empty() && entries.iter().all(|(known, _)| known.legend != mark.legend) {
                entries.push((mark, fitted(&mark.legend, room_pt)));
            }
        }
        let widest = entries.iter().map(|(_, name)| width_pt(name, TEXT_PT)).fold(0.0, f64::max);
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
        for (index, (mark, name)) in self.entries.iter().enumerate() {
            let x = self.left_pt + (index % self.columns) as f64 * self.column_pt;
            let y = ABOVE_PT + (index / self.columns) as f64 * ROW_PT + ROW_PT / 2.0;
            draw_sample(mark, [x, y], SAMPLE_PT - 8.0, area)?;
            let style = plain(Pos::new(HPos::Left, VPos::Center));
            area.draw_text(name, &style, (steps(x + SAMPLE_PT), steps(y))).map_err(|error| error.to_string())?;
        }
        Ok(())
    }
}

/// A name that is no wider than this (pt): of a longer one its beginning and its end, which tell names apart.
fn fitted(name: &str, room_pt: f64) -> String {
    if width_pt(name, TEXT_PT) <= room_pt {
        return name.to_owned();
    }
    let letters: Vec<char> = name.chars().collect();
    let kept = (room_pt / width_pt("m", TEXT_PT)) as usize;
    let half = kept.saturating_sub(1) / 2;
    letters[..half].iter().chain(&['…']).chain(&letters[letters.len() - half..]).collect()
}

#[cfg(test)]
mod tests {
    use super::{TEXT_PT, fitted, width_pt};

    #[test]
    fn a_name_that_is_too_long_keeps_its_ends() {
        let name = format!("without{}weight", "_".repeat(200));
        for room_pt in [60.0, 100.0, 300.0] {
            let short = fitted(&name, room_pt);
            assert!(width_pt(&short, TEXT_PT) <= room_pt && width_pt(&short, TEXT_PT) > room_pt - 15.0, "{short}");
        }
        let short = fitted(&name, 300.0);
        assert!(short.starts_with("without_") && short.ends_with("_weight"), "{short}");
        assert_eq!(fitted("executed", 300.0), "executed");
    }
}
