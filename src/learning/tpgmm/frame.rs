//! Frames of reference, and demonstrations seen from them.

use nalgebra::{DMatrix, DVector};

use crate::learning::LearningError;

/// A frame of reference over `d` columns: `x = A x' + b` maps its coordinates `x'` to those of the task.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    a: DMatrix<f64>,
    b: DVector<f64>,
    inverse: DMatrix<f64>,
}

impl Frame {
    /// From axes `a` (d x d, invertible: turned, mirrored or stretched) and origin `b` (d; unit of the columns).
    ///
    /// # Errors
    /// When shapes disagree, a number is not finite, or the axes span less than `d` directions.
    pub fn new(a: DMatrix<f64>, b: DVector<f64>) -> Result<Self, LearningError> {
        let d = b.len();
        if d == 0 || a.shape() != (d, d) {
            return Err(LearningError::Data(format!("a frame has {d} coordinates of its origin, but axes of shape {:?}", a.shape())));
        }
        if a.iter().chain(b.iter()).any(|x| !x.is_finite()) {
            return Err(LearningError::Data("a frame has a number that is not finite".to_owned()));
        }
        let singular = a.singular_values();
        if singular.min() <= 1e-12 * singular.max() {
            return Err(LearningError::Data(format!("the axes of a frame do not span {d} directions")));
        }
        let inverse = a.clone().try_inverse();
        let inverse = inverse.ok_or_else(|| LearningError::Data(format!("the axes of a frame do not span {d} directions")))?;
        Ok(Self { a, b, inverse })
    }

    /// A frame that is only moved, to the origin `b` (d).
    ///
    /// # Errors
    /// When a number is not finite, or there is none.
    pub fn at(b: &[f64]) -> Result<Self, LearningError> {
        Self::new(DMatrix::identity(b.len(), b.len()), DVector::from_column_slice(b))
    }

    /// Columns (d).
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.b.len()
    }

    /// A sample `[u, x]` (1 + d) as the frame sees it.
    #[must_use]
    pub fn local(&self, sample: &[f64]) -> DVector<f64> {
        let x = &self.inverse * (DVector::from_column_slice(&sample[1..]) - &self.b);
        DVector::from_iterator(sample.len(), std::iter::once(sample[0]).chain(x.iter().copied()))
    }

    /// A mean (1 + d) and covariance (1 + d square) over the phase input and the frame's columns, in coordinates of the task.
    #[must_use]
    pub fn global(&self, mean: &DVector<f64>, covariance: &DMatrix<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let d = self.dimension();
        let (mut a, mut b) = (DMatrix::identity(d + 1, d + 1), DVector::zeros(d + 1));
        a.view_mut((1, 1), (d, d)).copy_from(&self.a);
        b.rows_mut(1, d).copy_from(&self.b);
        (&a * mean + b, &a * covariance * a.transpose())
    }
}

/// One demonstration with its frames, which stay as they are while it lasts.
#[derive(Debug, Clone, PartialEq)]
pub struct FramedSequence {
    /// Samples, row by row (T x (1 + d)): the phase input first, then the columns in coordinates of the task.
    pub values: Vec<f64>,
    /// The frames (P of d), in the same order for every demonstration.
    pub frames: Vec<Frame>,
}

impl FramedSequence {
    /// Variables per sample, the phase input included (1 + d); 0 without a frame.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.frames.first().map_or(0, |frame| frame.dimension() + 1)
    }

    /// Number of samples (T).
    #[must_use]
    pub fn samples(&self) -> usize {
        self.values.len() / self.dimension().max(1)
    }
}
