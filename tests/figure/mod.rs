//! Figures as SVG.

mod drawing;
