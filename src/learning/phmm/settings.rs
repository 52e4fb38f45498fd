//! How a parametric hidden Markov model is learned.

use crate::learning::{Features, SettingFault};

/// Which transitions exist.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Topology {
    /// Start in the first state; stay, or go on to the next. For movements that pass through their stages in order.
    LeftToRight,
    /// Any state to any state. For several kinds of movement in one model (section 4.2 of the paper).
    Ergodic,
}

/// What becomes of the covariances once parameters are learned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CovarianceMode {
    /// They are learned with the parameters (section 3.2.1 of the paper).
    Estimated,
    /// They stay as the plain model without parameters left them (section 4.3 of the paper): wider, for they hold what the parameters
    /// explain. Every start then has that plain model as its first stage.
    Fixed,
}

/// Where expectation maximisation starts from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Start {
    /// Every sequence cut into equal time slices, one per state; parameters from the first step on.
    TimeSlices,
    /// The same slices, first a plain model without parameters (the paper's global stage), then the parametric one.
    TimeSlicesGlobal,
    /// The paper's: k-means on z-scored samples, plain model, parametric model; the number picks the random stream.
    KMeans(u64),
    /// From a model that was handed in.
    Given,
}

/// Settings of one parametric hidden Markov model.
#[derive(Debug, Clone, PartialEq)]
pub struct PhmmSettings {
    /// Number of states (1 to 200). Default 16: one per 1.75 s of the paper's 28 s task, where errors stop falling.
    pub states: usize,
    /// Which transitions exist. Default left to right.
    pub topology: Topology,
    /// Whether parameters also move the phase at which a state sits. Default no: twice as accurate outside the demonstrated range,
    /// equal inside.
    pub weights_on_phase: bool,
    /// Which functions of the parameters the means are linear in. Default the parameters themselves.
    pub features: Features,
    /// Whether covariances are learned with the parameters. Default yes.
    pub covariance: CovarianceMode,
    /// Strength of the prior `W = 0` (-, 0 to 1e6), as a number of demonstrations with standardised parameters. Default 0.1: the
    /// best of leave-one-out on hand-made demonstrations, and about 1 % of shrinkage for nine.
    pub ridge: f64,
    /// By how many of its own standard deviations each feature counts as one (q, each at least 1; empty: all 1). Larger where a parameter
    /// hardly varied beside others of its unit: what the prior allows it is then no more than what it allows them.
    pub scale_factors: Vec<f64>,
    /// Smallest eigenvalue of a covariance whose columns are scaled to unit variance (-, 1e-8 to 0.1, or 0 for none). Default 1e-5: 0.3 % of a
    /// column's standard deviation, well below what people repeat. Below 1e-6 rounding alone moves the likelihood by more than 1e-9.
    pub covariance_floor: f64,
    /// Starts by k-means (0 to 1000), beside the two by time slices. Default 4.
    pub kmeans_starts: u64,
    /// Most iterations of each stage (1 to 100000). Default 200.
    pub max_iterations: usize,
    /// Iterations stop once the objective rises by less than this fraction of itself (-, 0 to 1); 0 uses all iterations. Default 1e-6.
    pub tolerance: f64,
}

impl Default for PhmmSettings {
    fn default() -> Self {
        Self {
            states: 16,
            topology: Topology::LeftToRight,
            weights_on_phase: false,
            features: Features::Linear,
            covariance: CovarianceMode::Estimated,
            ridge: 0.1,
            scale_factors: Vec::new(),
            covariance_floor: 1e-5,
            kmeans_starts: 4,
            max_iterations: 200,
            tolerance: 1e-6,
        }
    }
}

impl PhmmSettings {
    /// Everything that is outside its range; `prefix` is how the owner calls these settings.
    #[must_use]
    pub fn faults(&self, prefix: &str) -> Vec<SettingFault> {
        let mut faults = Vec::new();
        let mut check = |name: &str, value: f64, from: f64, to: f64, unit: &str| {
            faults.extend(SettingFault::outside(&format!("{prefix}.{name}"), value, from, to, unit));
        };
        check("states", self.states as f64, 1.0, 200.0, "");
        check("ridge", self.ridge, 0.0, 1e6, "demonstrations");
        if self.covariance_floor != 0.0 {
            check("covariance_floor", self.covariance_floor, 1e-8, 0.1, "");
        }
        check("kmeans_starts", self.kmeans_starts as f64, 0.0, 1000.0, "");
        check("max_iterations", self.max_iterations as f64, 1.0, 1e5, "");
        check("tolerance", self.tolerance, 0.0, 1.0, "");
        faults.extend(self.features.faults(prefix));
        faults
    }

    /// The starts these settings ask for.
    #[must_use]
    pub fn starts(&self) -> Vec<Start> {
        let slices: &[Start] = match self.covariance {
            CovarianceMode::Estimated => &[Start::TimeSlices, Start::TimeSlicesGlobal],
            CovarianceMode::Fixed => &[Start::TimeSlicesGlobal],
        };
        slices.iter().copied().chain((0..self.kmeans_starts).map(Start::KMeans)).collect()
    }
}
