//! Whether one timing for all demonstrations explains them better than each one's own.
//!
//! ```text
//! y_k(u) = B(u) [1; theta_k] + e_k(u)                          places at equal time fractions, by ridge regression on the parameters
//! e_k,-k = e_k / (1 - H_kk)                                    the error of what was left out (PRESS), H the hat matrix
//! ```
//!
//! Movements from other starts, or with long waits, can look alike where they are not at the same point of the task. A warp then adds
//! scatter that the parameters do not explain; the demonstrations keep their own timing.

use nalgebra::{DMatrix, DVector};

use super::LearningError;
use super::parameters::mean_and_deviations;
use crate::demonstration::{Dataset, Demonstration};

/// Time fractions at which places are compared.
const POINTS: usize = 101;
/// Strength of the prior on `B`, in demonstrations (-): as the default of the models.
const RIDGE: f64 = 0.1;

/// One timing is taken when the error falls to this part or less (-): a small gain is chance.
const CLEARLY: f64 = 0.9;

/// A dataset after the question of timing is decided.
pub(super) struct Alignment {
    /// With one timing, or as it was.
    pub dataset: Dataset,
    /// The largest shift in time of each demonstration (s).
    pub shifts_s: Vec<f64>,
    /// Why it is as it was.
    pub warning: Option<String>,
}

impl Alignment {
    /// One timing for all, where that leaves less unexplained.
    pub fn of(dataset: &Dataset) -> Result<Self, LearningError> {
        let aligned = dataset.aligned()?;
        if dataset.demonstrations.len() < 2 {
            return Ok(Self { dataset: aligned.dataset, shifts_s: aligned.shifts_s, warning: None });
        }
        let scales = deviations(dataset)?;
        let (own, one) = (unexplained(dataset, &scales)?, unexplained(&aligned.dataset, &scales)?);
        if one <= CLEARLY * own {
            return Ok(Self { dataset: aligned.dataset, shifts_s: aligned.shifts_s, warning: None });
        }
        let shifts_s = vec![0.0; dataset.demonstrations.len()];
        let warning = format!(
            "not aligned: places that are left out are predicted to {own:.2e} of their spread with each demonstration's own timing, to {one:.2e} with one timing"
        );
        Ok(Self { dataset: dataset.clone(), shifts_s, warning: Some(warning) })
    }
}

/// Positions of a demonstration at equal time fractions (points x d).
fn places(dataset: &Dataset, demonstration: &Demonstration) -> Result<DMatrix<f64>, LearningError> {
    let grid = demonstration.trajectory.resampled((POINTS - 1) as f64 / demonstration.trajectory.duration_s())?;
    Ok(grid.select(&dataset.motion)?)
}

/// Standard deviation of every motion column over all demonstrations (d; unit of the column).
fn deviations(dataset: &Dataset) -> Result<Vec<f64>, LearningError> {
    let all = dataset.demonstrations.iter().map(|d| places(dataset, d)).collect::<Result<Vec<_>, _>>()?;
    let rows: Vec<_> = all.iter().flat_map(|places| places.row_iter()).collect();
    Ok(DMatrix::from_rows(&rows).column_iter().map(|column| column.variance().sqrt()).collect())
}

/// Root mean square error of places that were left out, in standard deviations of each column (-); columns that stand still do not count.
fn unexplained(dataset: &Dataset, scales: &[f64]) -> Result<f64, LearningError> {
    let demonstrations = &dataset.demonstrations;
    let hat = hat_matrix(&demonstrations.iter().map(parameters).collect::<Vec<_>>());
    let all = demonstrations.iter().map(|d| places(dataset, d)).collect::<Result<Vec<_>, _>>()?;
    let mut squares = 0.0;
    for (j, scale) in scales.iter().enumerate().filter(|(_, scale)| **scale > 0.0) {
        for u in 0..POINTS {
            let y = DVector::from_iterator(all.len(), all.iter().map(|places| places[(u, j)]));
            let residual = &y - &hat * &y;
            squares += residual.iter().enumerate().map(|(k, e)| (e / (1.0 - hat[(k, k)]) / scale).powi(2)).sum::<f64>();
        }
    }
    Ok((squares / (all.len() * POINTS * scales.len()) as f64).sqrt())
}

fn parameters(demonstration: &Demonstration) -> DVector<f64> {
    DVector::from_iterator(demonstration.theta_m.len(), demonstration.theta_m.iter().map(|(_, value)| *value))
}

/// `H = 1/K + Z (Z^T Z + ridge I)^-1 Z^T` (K x K) for standardised parameters `Z` (K x p).
fn hat_matrix(thetas: &[DVector<f64>]) -> DMatrix<f64> {
    let (count, (_, mut z)) = (thetas.len() as f64, mean_and_deviations(&thetas.iter().collect::<Vec<_>>()));
    for mut column in z.column_iter_mut() {
        let deviation = (column.norm_squared() / count).sqrt();
        column *= if deviation > 0.0 { 1.0 / deviation } else { 0.0 };
    }
    let mut normal = z.tr_mul(&z);
    normal.iter_mut().step_by(z.ncols() + 1).for_each(|diagonal| *diagonal += RIDGE);
    let solved = normal.cholesky().map(|factor| factor.solve(&z.transpose()));
    let constant = DMatrix::from_element(thetas.len(), thetas.len(), 1.0 / count);
    solved.map_or_else(|| constant.clone(), |solved| &constant + &z * solved)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::demonstration::{ParameterSource, Trajectory};

    /// From a start of its own to one goal, along a bow, at the time fractions `u^power`.
    fn movement(k: usize, power: f64) -> Demonstration {
        let start = [0.1 * (k as f64 * 2.3).sin(), 0.1 * (k as f64 * 1.7).cos()];
        let values = DMatrix::from_fn(201, 2, |t, j| {
            let u = (t as f64 / 200.0).powf(power);
            let s = u * u * (3.0 - 2.0 * u);
            start[j] * (1.0 - s) + [0.5 * s, 0.2 * s + 0.1 * (9.0 * u).sin() * u * (1.0 - u)][j]
        });
        let times = (0..201).map(|t| 0.01 * f64::from(t)).collect();
        let trajectory = Trajectory::new(times, ["x_m", "y_m"].map(str::to_owned).to_vec(), values).unwrap();
        Demonstration { name: k.to_string(), trajectory, theta_m: Vec::new(), theta_f: Vec::new() }
    }

    fn dataset(power: fn(usize) -> f64) -> Dataset {
        let motion = ["x_m", "y_m"].map(str::to_owned).to_vec();
        let demonstrations = (0..7).map(|k| movement(k, power(k))).collect();
        let data = Dataset { motion, wrench: Vec::new(), parameter_source: ParameterSource::Given, demonstrations };
        data.with_parameter_source(ParameterSource::Start)
    }

    #[test]
    fn timings_of_people_are_made_one_and_what_the_parameters_explain_is_left_alone() {
        let differing = Alignment::of(&dataset(|k| [0.7, 1.4, 1.0, 0.8, 1.2, 0.9, 1.3][k])).unwrap();
        assert!(differing.warning.is_none() && differing.shifts_s.iter().any(|shift| *shift > 0.1), "{:?}", differing.shifts_s);
        let equal = dataset(|_| 1.0);
        let kept = Alignment::of(&equal).unwrap();
        assert!(kept.warning.is_some_and(|warning| warning.starts_with("not aligned")) && kept.dataset == equal);
    }

    #[test]
    fn the_error_of_what_is_left_out_is_that_of_leaving_it_out() {
        let thetas: Vec<DVector<f64>> =
            [[0.1, 2.0], [0.3, 1.0], [0.2, 4.0], [0.5, 3.0], [0.4, 0.5]].map(|t| DVector::from_row_slice(&t)).to_vec();
        let y = DVector::from_row_slice(&[1.0, -0.5, 2.0, 0.7, 0.1]);
        let hat = hat_matrix(&thetas);
        let residual = &y - &hat * &y;
        // By brute force: the normal equations of all demonstrations but one, in the same standardised parameters.
        let mean = thetas.iter().sum::<DVector<f64>>() / 5.0;
        let deviation = DVector::from_fn(2, |j, _| (thetas.iter().map(|t| (t[j] - mean[j]).powi(2)).sum::<f64>() / 5.0).sqrt());
        let row = |t: &DVector<f64>| DVector::from_row_slice(&[1.0, (t[0] - mean[0]) / deviation[0], (t[1] - mean[1]) / deviation[1]]);
        for left_out in 0..5 {
            let mut normal = DMatrix::from_diagonal(&DVector::from_row_slice(&[0.0, RIDGE, RIDGE]));
            let mut moment = DVector::zeros(3);
            for k in (0..5).filter(|k| *k != left_out) {
                normal += row(&thetas[k]) * row(&thetas[k]).transpose();
                moment += row(&thetas[k]) * y[k];
            }
            let error = y[left_out] - row(&thetas[left_out]).dot(&normal.lu().solve(&moment).unwrap());
            assert!((residual[left_out] / (1.0 - hat[(left_out, left_out)]) - error).abs() < 1e-10);
        }
    }
}
