//! Where to yield: states in which the demonstrations disagree (20).
//!
//! A state's covariance also holds the movement *inside* the state, so a fast stiff state looks more variable than a slow loose one,
//! and a threshold in metres is not one in centimetres. The default statistic keeps only what demonstrations disagree about:
//!
//! ```text
//! e_kt = f_kt - E[f | phase_kt, theta_k, state i]          ebar_ki = sum_t gamma e_kt / n_ki
//! B_i = sum_k (n_ki / n_i) ebar_ki ebar_ki^T                                                                  (m^2)
//! ```

use nalgebra::{DMatrix, DVector};

use crate::learning::phmm::{Phmm, Sequence, expect, gather};
use crate::learning::{Gmr, LearningError, SettingFault};

/// Which matrix of a state is held against the threshold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Statistic {
    /// `Sigma_i` itself, as (20) is written: also holds the movement inside the state.
    Literal,
    /// `Sigma_i` given the phase: holds noise, curvature and disagreement.
    Conditional,
    /// `B_i`, the covariance between demonstrations.
    BetweenDemonstration,
}

/// The threshold `sigma`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Threshold {
    /// A value (m^2, > 0).
    Absolute(f64),
    /// The middle (in the logarithm) between the two groups into which the states' values fall best; nobody complies when the groups'
    /// means are less than a factor of ten apart.
    Automatic,
}

/// Which states comply.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ComplianceSettings {
    /// Default between demonstrations.
    pub statistic: Statistic,
    /// `sigma`. Default 1e-4 m^2: demonstrations that agree to 1 cm mean it.
    pub threshold: Threshold,
}

impl Default for ComplianceSettings {
    fn default() -> Self {
        Self { statistic: Statistic::BetweenDemonstration, threshold: Threshold::Absolute(1e-4) }
    }
}

impl ComplianceSettings {
    pub(crate) fn faults(&self, prefix: &str) -> Vec<SettingFault> {
        let Threshold::Absolute(sigma) = self.threshold else { return Vec::new() };
        let name = format!("{prefix}.threshold_m2");
        SettingFault::outside(&name, sigma, f64::MIN_POSITIVE, f64::MAX, "m^2").into_iter().collect()
    }
}

/// The compliance of every state.
#[derive(Debug, Clone, PartialEq)]
pub struct Compliance {
    /// Which statistic was used.
    pub statistic: Statistic,
    /// `sigma` (m^2); infinite when no threshold could be found, so that no state complies.
    pub threshold_m2: f64,
    /// The largest `|entry|` of each state's statistic over the spatial columns (N; m^2).
    pub values_m2: Vec<f64>,
    /// `beta` of each state (N; -1 complies, 0 is stiff).
    pub beta: Vec<f64>,
    /// `B_i` of each state over all columns (N of d x d).
    pub between: Vec<DMatrix<f64>>,
}

impl Compliance {
    /// Nothing complies, for a model of so many states over so many columns.
    #[must_use]
    pub fn stiff(states: usize, columns: usize) -> Self {
        Self {
            statistic: Statistic::BetweenDemonstration,
            threshold_m2: f64::INFINITY,
            values_m2: vec![0.0; states],
            beta: vec![0.0; states],
            between: vec![DMatrix::zeros(columns, columns); states],
        }
    }

    /// From the spread of every state, looking at the given columns; values below `noise_m2` count as noise when a threshold is
    /// sought.
    pub(crate) fn decide(spreads: Vec<StateSpread>, spatial: &[usize], settings: &ComplianceSettings, noise_m2: f64) -> Self {
        let value = |s: &StateSpread| {
            let matrix = match settings.statistic {
                Statistic::Literal => &s.literal,
                Statistic::Conditional => &s.conditional,
                Statistic::BetweenDemonstration => &s.between,
            };
            spatial.iter().flat_map(|j| spatial.iter().map(|k| matrix[(*j, *k)].abs())).fold(0.0, f64::max)
        };
        let values_m2: Vec<f64> = spreads.iter().map(value).collect();
        let threshold_m2 = match settings.threshold {
            Threshold::Absolute(sigma) => sigma,
            Threshold::Automatic => automatic_threshold(&values_m2, noise_m2),
        };
        let beta = values_m2.iter().map(|v| if *v > threshold_m2 { -1.0 } else { 0.0 }).collect();
        let between = spreads.into_iter().map(|s| s.between).collect();
        Self { statistic: settings.statistic, threshold_m2, values_m2, beta, between }
    }
}

/// The three statistics of one state (d x d each; squared unit of the columns).
pub(crate) struct StateSpread {
    literal: DMatrix<f64>,
    conditional: DMatrix<f64>,
    between: DMatrix<f64>,
}

/// The statistics of all states of a model learned from these sequences.
pub(crate) fn state_spreads(model: &Phmm, sequences: &[Sequence]) -> Result<Vec<StateSpread>, LearningError> {
    let (n, d) = (model.states(), model.dimension() - 1);
    let gmr = Gmr::new(&model.means, &model.covariances, 1)?;
    let degenerate = || LearningError::Model("a covariance is not positive definite".to_owned());
    let (mut totals, mut between) = (vec![0.0; n], vec![DMatrix::zeros(d, d); n]);
    for sequence in sequences {
        let expectation = expect(model, sequence).ok_or_else(degenerate)?;
        for (i, group) in gather(model, sequence, &expectation).iter().enumerate() {
            let off = &group.mean - model.mean_at(i, &sequence.theta);
            let residual: DVector<f64> = off.rows(1, d) - gmr.gain(i) * off.rows(0, 1);
            totals[i] += group.count;
            between[i] += group.count * &residual * residual.transpose();
        }
    }
    let spread = |(i, b): (usize, DMatrix<f64>)| StateSpread {
        literal: model.covariances[i].view((1, 1), (d, d)).into_owned(),
        conditional: gmr.conditional_covariance(i).clone(),
        between: if totals[i] > 0.0 { b / totals[i] } else { b },
    };
    Ok(between.into_iter().enumerate().map(spread).collect())
}

/// Two groups' means must be this factor apart to be two groups.
const LEAST_RATIO: f64 = 10.0;

/// The split of the sorted logarithms with the largest variance between the two sides (Otsu's rule); infinite without two groups.
fn automatic_threshold(values: &[f64], noise: f64) -> f64 {
    let mut logs: Vec<f64> = values.iter().map(|v| v.max(noise).max(f64::MIN_POSITIVE).ln()).collect();
    logs.sort_by(f64::total_cmp);
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let gain = |at: usize| (at * (logs.len() - at)) as f64 * (mean(&logs[at..]) - mean(&logs[..at])).powi(2);
    let Some(at) = (1..logs.len()).max_by(|a, b| gain(*a).total_cmp(&gain(*b))) else { return f64::INFINITY };
    if mean(&logs[at..]) - mean(&logs[..at]) < LEAST_RATIO.ln() {
        return f64::INFINITY;
    }
    (0.5 * (logs[at - 1] + logs[at])).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_automatic_threshold_splits_two_groups_and_refuses_one() {
        let sigma = automatic_threshold(&[1e-6, 7e-6, 1.4e-3, 2e-3, 3e-6], 1e-9);
        assert!(sigma > 7e-6 && sigma < 1.4e-3);
        assert_eq!(automatic_threshold(&[1e-6, 2e-6, 3e-6], 1e-9), f64::INFINITY);
        assert_eq!(automatic_threshold(&[1e-12, 1e-30, 0.0], 1e-8), f64::INFINITY, "all below the noise");
        assert_eq!(automatic_threshold(&[], 1e-9), f64::INFINITY);
    }
}
