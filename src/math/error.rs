//! What can be wrong with numbers handed to this room.

/// A number or a matrix that the requested operation is not defined for.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MathError {
    /// A covariance that is not symmetric positive definite.
    #[error("the {size} x {size} covariance is not symmetric positive definite (smallest eigenvalue {smallest:e})")]
    NotPositiveDefinite {
        /// Rows of the matrix.
        size: usize,
        /// Its smallest eigenvalue (squared unit of the variables).
        smallest: f64,
    },
    /// Two arguments whose sizes must agree do not.
    #[error("{what}: expected {expected}, found {found}")]
    Shape {
        /// Which quantity.
        what: &'static str,
        /// The size that was needed.
        expected: usize,
        /// The size that came.
        found: usize,
    },
    /// A scalar argument outside its range.
    #[error("{what} is {value}, but must be {range}")]
    Range {
        /// Which quantity.
        what: &'static str,
        /// The value that came.
        value: f64,
        /// The allowed range, in words.
        range: &'static str,
    },
}
