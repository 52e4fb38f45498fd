//! What is known of the parameters before anything is seen.

use nalgebra::DVector;

/// The demonstrated range of every parameter.
pub(super) struct Prior {
    pub(super) mean: DVector<f64>,
    /// One over the width (p); 0 where no range is known.
    pub(super) inverse_width: DVector<f64>,
    /// Parameters that varied.
    pub(super) active: Vec<usize>,
}

impl Prior {
    pub(super) fn of(ranges: &[[f64; 2]]) -> Self {
        let p = ranges.len();
        let known = |j: usize| (ranges[j][1] - ranges[j][0]).is_finite();
        let mean = DVector::from_fn(p, |j, _| if known(j) { 0.5 * (ranges[j][0] + ranges[j][1]) } else { 0.0 });
        let active = (0..p).filter(|j| !known(*j) || ranges[*j][1] - ranges[*j][0] > 1e-9 * mean[*j].abs()).collect();
        let inverse_width = DVector::from_fn(p, |j, _| if known(j) { 1.0 / (ranges[j][1] - ranges[j][0]) } else { 0.0 });
        Self { mean, inverse_width, active }
    }

    /// Parameters that are known (p).
    pub(super) fn certain(theta: DVector<f64>) -> Self {
        Self { inverse_width: DVector::zeros(theta.len()), mean: theta, active: Vec::new() }
    }

    /// The middle, then both ends of every range: bent features may have several optima.
    pub(super) fn starts(&self) -> Vec<DVector<f64>> {
        let mut starts = vec![self.mean.clone()];
        for j in self.active.iter().filter(|j| self.inverse_width[**j] > 0.0) {
            for side in [-0.5, 0.5] {
                let mut start = self.mean.clone();
                start[*j] += side / self.inverse_width[*j];
                starts.push(start);
            }
        }
        starts
    }

    pub(super) fn penalty(&self, theta: &DVector<f64>) -> f64 {
        self.active.iter().map(|j| ((theta[*j] - self.mean[*j]) * self.inverse_width[*j]).powi(2)).sum()
    }
}
