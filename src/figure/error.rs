//! Why a figure could not be drawn.

/// Why a figure could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// There is nothing to draw.
    #[error("the figure `{0}` has no panel with finite marks")]
    Empty(String),
    /// The drawing library refused.
    #[error("the figure `{title}` could not be drawn: {message}")]
    Drawing {
        /// The figure.
        title: String,
        /// What the library said.
        message: String,
    },
    /// A drawing could not be made a picture.
    #[cfg(feature = "png")]
    #[error("no picture can be made of the figure: {0}")]
    Raster(String),
}
