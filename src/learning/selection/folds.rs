//! Which demonstrations are left out together.

use nalgebra::DVector;

use super::super::LearningError;
use crate::demonstration::Dataset;

/// Groups of demonstrations (by index) that share their parameters, in the order of their first member. Without parameters, or when all
/// demonstrations share one value, every demonstration is a group of its own.
#[must_use]
pub fn folds(thetas: &[DVector<f64>]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (k, theta) in thetas.iter().enumerate() {
        match groups.iter_mut().find(|group| thetas[group[0]] == *theta) {
            Some(group) => group.push(k),
            None => groups.push(vec![k]),
        }
    }
    if groups.len() > 1 { groups } else { (0..thetas.len()).map(|k| vec![k]).collect() }
}

/// The groups of a dataset by `theta_m`.
pub(super) fn folds_of(dataset: &Dataset) -> Result<Vec<Vec<usize>>, LearningError> {
    let theta = |theta: &[(String, f64)]| DVector::from_iterator(theta.len(), theta.iter().map(|(_, value)| *value));
    let thetas: Vec<DVector<f64>> = dataset.demonstrations.iter().map(|d| theta(&d.theta_m)).collect();
    let groups = folds(&thetas);
    if groups.len() < 2 {
        return Err(LearningError::Data("leaving demonstrations out needs at least two of them".to_owned()));
    }
    Ok(groups)
}

/// The dataset without a group, and that group's demonstrations alone.
pub(super) fn split(dataset: &Dataset, group: &[usize]) -> (Dataset, Dataset) {
    let part = |left_out: bool| {
        let chosen = dataset.demonstrations.iter().enumerate().filter(|(k, _)| group.contains(k) == left_out);
        Dataset { demonstrations: chosen.map(|(_, d)| d.clone()).collect(), ..dataset.clone() }
    };
    (part(false), part(true))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_parameters_are_left_out_together() {
        let thetas = [1.0, 2.0, 1.0, 3.0].map(|x| DVector::from_element(1, x));
        assert_eq!(folds(&thetas), [vec![0, 2], vec![1], vec![3]]);
        assert_eq!(folds(&thetas[..1]), [vec![0]]);
        assert_eq!(folds(&[DVector::zeros(0), DVector::zeros(0)]), [vec![0], vec![1]]);
    }
}
