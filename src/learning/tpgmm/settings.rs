//! How a task-parameterised mixture is learned.

use crate::learning::SettingFault;

/// Where expectation maximisation starts from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TpGmmStart {
    /// Every demonstration cut into equal time slices, one per component.
    TimeSlices,
    /// k-means on the samples as all frames see them; the number picks the random stream.
    KMeans(u64),
}

/// Settings of one task-parameterised mixture.
#[derive(Debug, Clone, PartialEq)]
pub struct TpGmmSettings {
    /// Number of components (1 to 200). Default 16, as for the parametric model.
    pub components: usize,
    /// Smallest eigenvalue of a covariance whose columns are scaled to unit variance in their frame (-, 1e-8 to 0.1). Default 1e-5, as for
    /// the parametric model.
    pub covariance_floor: f64,
    /// Starts by k-means (0 to 1000), beside the one by time slices. Default 0: frames in which movements end hardly vary, so the
    /// likelihood prefers mixtures that spend their components there. Past an obstacle with the side told, k-means raised the likelihood
    /// and took the clearance at a new width from 0.99 to 0.19 of 1 m.
    pub kmeans_starts: u64,
    /// Most iterations (1 to 100000). Default 200.
    pub max_iterations: usize,
    /// Iterations stop once the objective rises by less than this fraction of itself (-, 0 to 1); 0 uses all iterations. Default 1e-6.
    pub tolerance: f64,
}

impl Default for TpGmmSettings {
    fn default() -> Self {
        Self { components: 16, covariance_floor: 1e-5, kmeans_starts: 0, max_iterations: 200, tolerance: 1e-6 }
    }
}

impl TpGmmSettings {
    /// Everything that is outside its range; `prefix` is how the owner calls these settings.
    #[must_use]
    pub fn faults(&self, prefix: &str) -> Vec<SettingFault> {
        let checks = [
            ("components", self.components as f64, 1.0, 200.0),
            ("covariance_floor", self.covariance_floor, 1e-8, 0.1),
            ("kmeans_starts", self.kmeans_starts as f64, 0.0, 1000.0),
            ("max_iterations", self.max_iterations as f64, 1.0, 100_000.0),
            ("tolerance", self.tolerance, 0.0, 1.0),
        ];
        let fault =
            |(name, value, from, to): &(&str, f64, f64, f64)| SettingFault::outside(&format!("{prefix}.{name}"), *value, *from, *to, "");
        checks.iter().filter_map(fault).collect()
    }

    /// All starts, in the order they are made.
    #[must_use]
    pub fn starts(&self) -> Vec<TpGmmStart> {
        std::iter::once(TpGmmStart::TimeSlices).chain((0..self.kmeans_starts).map(TpGmmStart::KMeans)).collect()
    }
}
