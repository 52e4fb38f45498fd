//! Start and goal of a movement as functions of its parameters.

use nalgebra::DVector;

use super::prepare::Prepared;
use super::{FeatureMap, LearningError, LinearMap, ParameterSpace, parameter_selection};
use crate::demonstration::{Dataset, ParameterSource};

/// How the end that the parameters do not fix is predicted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EndRule {
    /// By least squares from the parameters.
    Regression,
    /// As the mean over the demonstrations.
    Mean,
}

/// How the end of the movement that its parameters do not fix was chosen, and how well both rules predict it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EndsReport {
    /// The rule that was taken: the one with the smaller error on demonstrations left out.
    pub rule: EndRule,
    /// Root mean square error of the regression on demonstrations left out (unit of the motion columns); infinite when there are too few.
    pub regression_error: f64,
    /// The same of the mean.
    pub mean_error: f64,
}

/// Maps from the parameters to start and goal.
pub(super) struct Ends {
    pub(super) start: LinearMap,
    pub(super) goal: LinearMap,
    /// `None` when there was nothing to choose: parameters are given, or are seen through bumps (RBF).
    pub(super) report: Option<EndsReport>,
}

/// The maps for the parameters' source. Given parameters: both ends by the rule `given`. Parameters that *are* the start,
/// the goal or their difference: that identity holds exactly, and the end they leave open is the mean or a regression, whichever predicts
/// the demonstrations better when they are left out.
pub(super) fn ends(dataset: &Dataset, prepared: &[Prepared], parameters: &ParameterSpace, given: EndRule) -> Result<Ends, LearningError> {
    let thetas: Vec<DVector<f64>> = prepared.iter().map(|p| parameters.features.at(&p.theta_m)).collect();
    let starts: Vec<DVector<f64>> = prepared.iter().map(|p| p.start.clone()).collect();
    let goals: Vec<DVector<f64>> = prepared.iter().map(|p| p.goal.clone()).collect();
    if dataset.parameter_source == ParameterSource::Given {
        let map = |values: &[DVector<f64>]| match given {
            EndRule::Mean => Ok(constant(values, thetas[0].len())),
            EndRule::Regression => LinearMap::fit(&thetas, values),
        };
        return Ok(Ends { start: map(&starts)?, goal: map(&goals)?, report: None });
    }
    if matches!(parameters.features, FeatureMap::Rbf { .. }) {
        // Bumps do not hold the parameters themselves, so no map through them is the identity; the end that is asked for replaces it.
        return Ok(Ends { start: LinearMap::fit(&thetas, &starts)?, goal: LinearMap::fit(&thetas, &goals)?, report: None });
    }
    let fixed = parameter_selection(dataset.parameter_source, &parameters.names, &dataset.motion)?.transpose();
    // The first features are the parameters themselves; further ones do not move this end.
    let fixed = fixed.resize_horizontally(parameters.feature_count(), 0.0);
    let identity = LinearMap { mean: DVector::zeros(fixed.nrows()), weights: fixed };
    let open = if dataset.parameter_source == ParameterSource::Goal { &starts } else { &goals };
    let report = compare(&thetas, open)?;
    let other = match report.rule {
        EndRule::Mean => constant(open, thetas[0].len()),
        EndRule::Regression => LinearMap::fit(&thetas, open)?,
    };
    let (start, goal) = match dataset.parameter_source {
        ParameterSource::Goal => (other, identity),
        ParameterSource::StartRelativeToGoal => {
            (LinearMap { weights: &identity.weights + &other.weights, mean: other.mean.clone() }, other)
        }
        ParameterSource::Start | ParameterSource::Given => (identity, other),
    };
    Ok(Ends { start, goal, report: Some(report) })
}

fn constant(values: &[DVector<f64>], parameters: usize) -> LinearMap {
    LinearMap::constant(values.iter().sum::<DVector<f64>>() / values.len() as f64, parameters)
}

/// Errors of both rules with each demonstration left out in turn. A regression needs more demonstrations than unknowns.
fn compare(thetas: &[DVector<f64>], values: &[DVector<f64>]) -> Result<EndsReport, LearningError> {
    let (k, p) = (thetas.len(), thetas[0].len());
    let mut squares = [0.0, 0.0];
    for out in 0..k {
        let rest = |list: &[DVector<f64>]| -> Vec<DVector<f64>> {
            list.iter().enumerate().filter(|(i, _)| *i != out).map(|(_, v)| v.clone()).collect()
        };
        if k < 2 {
            break;
        }
        let maps = [LinearMap::fit(&rest(thetas), &rest(values))?, constant(&rest(values), p)];
        for (sum, map) in squares.iter_mut().zip(&maps) {
            *sum += (map.at(&thetas[out]) - &values[out]).norm_squared();
        }
    }
    let [mut regression_error, mean_error] = squares.map(|s| (s / k as f64).sqrt());
    if k < p + 3 {
        regression_error = f64::INFINITY;
    }
    let rule = if regression_error < mean_error { EndRule::Regression } else { EndRule::Mean };
    Ok(EndsReport { rule, regression_error, mean_error })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_goal_that_follows_the_parameters_is_regressed_and_one_that_does_not_is_averaged() {
        let thetas: Vec<DVector<f64>> = (0..8).map(|k| DVector::from_element(1, f64::from(k))).collect();
        let follows: Vec<DVector<f64>> = thetas.iter().map(|t| t * 2.0).collect();
        assert_eq!(compare(&thetas, &follows).unwrap().rule, EndRule::Regression);
        let scatter: Vec<DVector<f64>> = (0..8).map(|k| DVector::from_element(1, [1.0, -1.0][k % 2])).collect();
        assert_eq!(compare(&thetas, &scatter).unwrap().rule, EndRule::Mean);
        assert_eq!(compare(&thetas[..1], &follows[..1]).unwrap().rule, EndRule::Mean);
    }
}
