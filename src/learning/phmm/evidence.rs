//! How well the demonstrations determine a state's mean: the posterior over `Z_i = [W_i mean_i]`.
//!
//! With the prior `W = 0` of strength `kappa` and a flat one on the mean, `Z_i` given `Sigma_i` is matrix-normal with row covariance
//! `Sigma_i` and column precision `Lambda_i`, so that for `Omega = [phi; 1]`
//!
//! ```text
//! Lambda_i = sum_k w_ki Omega_k Omega_k^T + kappa diag(r^2, 0)               w_ki = m_i n_ki / n_i
//! Var(Z_i Omega) = Sigma_i Omega^T Lambda_i^-1 Omega,     predictive: Sigma_i (1 + Omega^T Lambda_i^-1 Omega)
//! Omega^T Lambda_i^-1 Omega = 1/m_i + (phi - c_i)^T (m_i C_i + kappa diag(r^2))^-1 (phi - c_i)
//! ```
//!
//! Samples of one demonstration are not independent, so the evidence counts demonstrations: `m_i = n_i^2 / sum_k n_ki^2` is how many
//! take part in the state. `c_i` and `C_i` are mean and covariance of their features, `r` the spread of each over all demonstrations.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::Group;
use crate::learning::LearningError;
use crate::learning::parameters::mean_and_deviations;

/// Least strength of the prior (demonstrations): a direction that no demonstration shows is uncertain, but not infinitely so.
const LEAST_PRIOR: f64 = 1e-3;
/// What a state without any sample counts as (demonstrations).
const NEXT_TO_NONE: f64 = 1e-3;

/// What is known about one state's mean.
#[derive(Debug, Clone, PartialEq)]
pub struct StateEvidence {
    /// `m_i`: how many demonstrations take part in the state.
    pub demonstrations: f64,
    /// `c_i`: mean of their features (q).
    pub centre: DVector<f64>,
    /// `m_i C_i + kappa diag(r^2)`: what they say about the weights (q x q, SPD).
    pub information: DMatrix<f64>,
}

impl StateEvidence {
    /// From the state's groups, the demonstrations' features, the strength of the prior (demonstrations) and the factors of the features'
    /// spreads (none: 1).
    pub(super) fn of(groups: &[&Group], phis: &[&DVector<f64>], ridge: f64, factors: &[f64]) -> Self {
        let (mean, deviations) = mean_and_deviations(phis);
        let spread = |j: usize| {
            let variance = deviations.column(j).norm_squared() / phis.len() as f64;
            // A parameter that never varied counts as shown with the spread of its own size.
            if variance > 0.0 {
                variance.sqrt()
            } else if mean[j] != 0.0 {
                mean[j].abs()
            } else {
                1.0
            }
        };
        let q = mean.len();
        let count: f64 = groups.iter().map(|g| g.count).sum();
        let squares: f64 = groups.iter().map(|g| g.count * g.count).sum();
        let known = count > 0.0 && squares > 0.0;
        let demonstrations = if known { count * count / squares } else { NEXT_TO_NONE };
        let share = |k: usize| if known { groups[k].count / count } else { 1.0 / phis.len() as f64 };
        let centre = phis.iter().enumerate().fold(DVector::zeros(q), |sum, (k, phi)| sum + *phi * share(k));
        let prior = DVector::from_fn(q, |j, _| ridge.max(LEAST_PRIOR) * (spread(j) * factors.get(j).unwrap_or(&1.0)).powi(2));
        let mut information = DMatrix::from_diagonal(&prior);
        for (k, phi) in phis.iter().enumerate() {
            let off = *phi - &centre;
            information += demonstrations * share(k) * &off * off.transpose();
        }
        Self { demonstrations, centre, information }
    }

    /// `Omega^T Lambda_i^-1 Omega` at `phi` (q): variance of the mean over variance inside the state (-). Infinite when the evidence is
    /// not positive definite.
    #[must_use]
    pub fn ratio(&self, phi: &DVector<f64>) -> f64 {
        if phi.is_empty() {
            return 1.0 / self.demonstrations;
        }
        let off = phi - &self.centre;
        let known = Cholesky::new(self.information.clone());
        known.map_or(f64::INFINITY, |factor| 1.0 / self.demonstrations + off.dot(&factor.solve(&off)))
    }

    /// Checks numbers and shapes for `q` features.
    ///
    /// # Errors
    /// What is wrong, with the state's number.
    pub fn check(&self, state: usize, q: usize) -> Result<(), LearningError> {
        let numbers = self.centre.iter().chain(self.information.iter()).all(|x| x.is_finite());
        let shaped = self.centre.len() == q && self.information.shape() == (q, q);
        let counted = self.demonstrations > 0.0 && self.demonstrations.is_finite();
        if numbers && shaped && counted && (q == 0 || Cholesky::new(self.information.clone()).is_some()) {
            return Ok(());
        }
        Err(LearningError::Skill(format!("state {state}: the evidence is not finite and positive definite over {q} features")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn groups(counts: &[f64]) -> Vec<Group> {
        counts.iter().map(|n| Group { count: *n, mean: DVector::zeros(2), scatter: DMatrix::zeros(2, 2) }).collect()
    }

    fn evidence(counts: &[f64], phis: &[[f64; 2]], ridge: f64) -> StateEvidence {
        let phis: Vec<DVector<f64>> = phis.iter().map(|phi| DVector::from_row_slice(phi)).collect();
        StateEvidence::of(&groups(counts).iter().collect::<Vec<_>>(), &phis.iter().collect::<Vec<_>>(), ridge, &[])
    }

    const SHOWN: [[f64; 2]; 5] = [[0.1, 3.0], [0.2, 1.0], [0.3, 2.5], [0.4, 1.5], [0.15, 2.0]];

    #[test]
    fn the_ratio_is_the_quadratic_form_of_the_whole_precision() {
        let (counts, ridge) = ([10.0, 20.0, 5.0, 10.0, 12.0], 0.3);
        let known = evidence(&counts, &SHOWN, ridge);
        let n: f64 = counts.iter().sum();
        let m = n * n / counts.iter().map(|c| c * c).sum::<f64>();
        let mut lambda = DMatrix::zeros(3, 3);
        for (count, phi) in counts.iter().zip(SHOWN) {
            let omega = DVector::from_vec(vec![phi[0], phi[1], 1.0]);
            lambda += m * count / n * &omega * omega.transpose();
        }
        for j in 0..2 {
            let mean = SHOWN.iter().map(|phi| phi[j]).sum::<f64>() / 5.0;
            lambda[(j, j)] += ridge * SHOWN.iter().map(|phi| (phi[j] - mean).powi(2)).sum::<f64>() / 5.0;
        }
        let omega = DVector::from_vec(vec![0.7, -1.0, 1.0]);
        let expected = omega.dot(&(lambda.try_inverse().unwrap() * &omega));
        assert!((known.ratio(&DVector::from_vec(vec![0.7, -1.0])) - expected).abs() < 1e-9 * expected);
    }

    #[test]
    fn it_counts_demonstrations_and_grows_away_from_them_in_any_unit() {
        let known = evidence(&[7.0; 5], &SHOWN, 0.1);
        assert!((known.demonstrations - 5.0).abs() < 1e-12);
        assert_eq!(evidence(&[700.0; 5], &SHOWN, 0.1), known, "the rate of sampling says nothing");
        let scaled = evidence(&[7.0; 5], &SHOWN.map(|[a, b]| [1e3 * a, 1e-3 * b]), 0.1);
        let mut before = known.ratio(&known.centre);
        assert!((before - 0.2).abs() < 1e-12);
        for step in 1..50 {
            let away = &known.centre + DVector::from_vec(vec![0.05, 0.2]) * f64::from(step);
            let ratio = known.ratio(&away);
            assert!(ratio > before);
            let same = scaled.ratio(&DVector::from_vec(vec![1e3 * away[0], 1e-3 * away[1]]));
            assert!((same / ratio - 1.0).abs() < 1e-9);
            before = ratio;
        }
    }

    #[test]
    fn what_was_never_shown_is_uncertain_and_finite() {
        let constant = evidence(&[5.0; 3], &[[0.2, 1.0], [0.2, 2.0], [0.2, 4.0]], 0.0);
        assert!(constant.ratio(&DVector::from_vec(vec![0.4, 2.0])) > 100.0 && constant.check(0, 2).is_ok());
        let unvisited = evidence(&[0.0; 3], &[[0.2, 1.0], [0.3, 2.0], [0.4, 4.0]], 0.0);
        assert!(unvisited.ratio(&unvisited.centre) > 100.0 && unvisited.check(0, 2).is_ok());
        assert!(evidence(&[5.0], &[[0.2, 1.0]], 0.0).check(3, 1).unwrap_err().to_string().contains("state 3"));
    }
}
