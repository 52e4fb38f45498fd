//! A figure as data: panels with axes, and what is in them.

use super::mark::Mark;

/// A drawing: panels of one size in rows, and one legend for all of them below.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// What it shows, above the panels.
    pub title: String,
    /// The panels, row by row.
    pub panels: Vec<Chart>,
    /// Panels per row, at least 1.
    pub columns: usize,
    /// Width and height of a panel with its title and labels (pt).
    pub panel_size_pt: [f64; 2],
}

/// One panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Its title; may be empty.
    pub title: String,
    /// The horizontal and the vertical axis; none for a drawing without measures, such as a graph.
    pub axes: Option<[Axis; 2]>,
    /// Whether a unit is as long on both axes, as in a map.
    pub equal_aspect: bool,
    /// What is drawn, the last on top.
    pub marks: Vec<Mark>,
}

/// An axis. Its range is that of the marks.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What it measures, with the unit in round brackets.
    pub label: String,
    /// Values that must be in its range, if they are not already.
    pub includes: Vec<f64>,
    /// Its range is at least so long, around the middle of what is in it: noise of something that stands still is no motion.
    pub least_range: f64,
}

impl Axis {
    /// An axis that is at least so long.
    #[must_use]
    pub fn at_least(label: &str, least_range: f64) -> Self {
        Self { least_range, ..Self::new(label) }
    }

    /// An axis whose range is that of its marks.
    #[must_use]
    pub fn new(label: &str) -> Self {
        Self { label: label.to_owned(), includes: Vec::new(), least_range: 0.0 }
    }
}

impl Chart {
    /// A panel like a map: both axes in one scale.
    #[must_use]
    pub fn map(title: &str, axes: [Axis; 2]) -> Self {
        Self { title: title.to_owned(), axes: Some(axes), equal_aspect: true, marks: Vec::new() }
    }

    /// A panel that fills its place: each axis in a scale of its own.
    #[must_use]
    pub fn plot(title: &str, axes: [Axis; 2]) -> Self {
        Self { title: title.to_owned(), axes: Some(axes), equal_aspect: false, marks: Vec::new() }
    }

    /// A panel without axes.
    #[must_use]
    pub fn bare(title: &str) -> Self {
        Self { title: title.to_owned(), axes: None, equal_aspect: true, marks: Vec::new() }
    }
}
