//! What is drawn in a panel.

use crate::palette::Rgb;

/// Something drawn in the units of the panel's axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// What the legend calls it; marks of one name share an entry. Empty: not in the legend.
    pub legend: String,
    /// Its colour.
    pub color: Rgb,
    /// What it is.
    pub shape: Shape,
}

/// The shape of a mark. Sizes and widths are in points of the page.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A line through points.
    Line {
        /// The points.
        points: Vec<[f64; 2]>,
        /// Its width (pt).
        width_pt: f64,
        /// Whether it is dashed.
        dashed: bool,
    },
    /// A closed outline, filled.
    Area {
        /// The outline.
        outline: Vec<[f64; 2]>,
        /// How much of what is behind it is covered (0 … 1).
        opacity: f64,
        /// Width of its border (pt).
        border_pt: f64,
    },
    /// A stretch of the horizontal axis, filled from the bottom of the panel to its top.
    Band {
        /// Its ends.
        stretch: [f64; 2],
        /// How much of what is behind it is covered (0 … 1).
        opacity: f64,
    },
    /// Symbols at places.
    Symbols {
        /// The places.
        places: Vec<[f64; 2]>,
        /// The symbol.
        symbol: Symbol,
        /// Radius (pt).
        radius_pt: f64,
    },
    /// An arrow with its head at the last point.
    Arrow {
        /// The way of its shaft, two points or more.
        points: Vec<[f64; 2]>,
        /// Width of the shaft (pt).
        width_pt: f64,
    },
    /// Words at a place.
    Words {
        /// The place.
        at: [f64; 2],
        /// The words.
        text: String,
        /// Where the place is in the words.
        anchor: Anchor,
    },
}

/// A symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symbol {
    /// A filled circle.
    Disc,
    /// A circle.
    Ring,
    /// A diagonal cross.
    Cross,
    /// A filled square.
    Square,
}

/// Where the place of words is in them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// At their left end.
    Left,
    /// In their middle.
    Middle,
    /// At their right end.
    Right,
}

impl Mark {
    /// A solid line.
    #[must_use]
    pub fn line(legend: &str, color: Rgb, width_pt: f64, points: Vec<[f64; 2]>) -> Self {
        Self { legend: legend.to_owned(), color, shape: Shape::Line { points, width_pt, dashed: false } }
    }

    /// A dashed line.
    #[must_use]
    pub fn dashes(legend: &str, color: Rgb, width_pt: f64, points: Vec<[f64; 2]>) -> Self {
        Self { legend: legend.to_owned(), color, shape: Shape::Line { points, width_pt, dashed: true } }
    }

    /// A filled outline.
    #[must_use]
    pub fn area(legend: &str, color: Rgb, opacity: f64, outline: Vec<[f64; 2]>) -> Self {
        Self { legend: legend.to_owned(), color, shape: Shape::Area { outline, opacity, border_pt: 0.8 } }
    }

    /// A filled outline with a thin border, for areas of which many lie on each other.
    #[must_use]
    pub fn faint_area(legend: &str, color: Rgb, outline: Vec<[f64; 2]>) -> Self {
        Self { legend: legend.to_owned(), color, shape: Shape::Area { outline, opacity: 0.05, border_pt: 0.3 } }
    }

    /// A symbol in the legend for marks that are drawn elsewhere, or later.
    #[must_use]
    pub fn entry(legend: &str, color: Rgb, symbol: Symbol, radius_pt: f64) -> Self {
        Self::symbols(legend, color, symbol, radius_pt, Vec::new())
    }

    /// A stretch of the horizontal axis. It does not widen the axis.
    #[must_use]
    pub fn band(legend: &str, color: Rgb, opacity: f64, stretch: [f64; 2]) -> Self {
        Self { legend: legend.to_owned(), color, shape: Shape::Band { stretch, opacity } }
    }

    /// Symbols.
    #[must_use]
    pub fn symbols(legend: &str, color: Rgb, symbol: Symbol, radius_pt: f64, places: Vec<[f64; 2]>) -> Self {
        Self { legend: legend.to_owned(), color, shape: Shape::Symbols { places, symbol, radius_pt } }
    }

    /// Words around a place.
    #[must_use]
    pub fn words(color: Rgb, at: [f64; 2], anchor: Anchor, text: &str) -> Self {
        Self { legend: String::new(), color, shape: Shape::Words { at, text: text.to_owned(), anchor } }
    }

    /// The places that must be on the page.
    pub(super) fn places(&self) -> &[[f64; 2]] {
        match &self.shape {
            Shape::Line { points, .. } | Shape::Arrow { points, .. } => points,
            Shape::Area { outline, .. } => outline,
            Shape::Symbols { places, .. } => places,
            Shape::Words { at, .. } => std::slice::from_ref(at),
            Shape::Band { .. } => &[],
        }
    }

    /// Whether every place is a finite one.
    pub(super) fn is_finite(&self) -> bool {
        if let Shape::Band { stretch, .. } = &self.shape {
            return stretch.iter().all(|number| number.is_finite());
        }
        self.places().iter().flatten().all(|number| number.is_finite())
    }
}
