//! Which demonstrations are left out together.

use nalgebra::DVector;

use super::super::LearningError;
use crate::demonstration::{Dataset, Demonstration, Parameters};

/// Groups of demonstrations (by index) that share their parameters, in the order of their first member. Without parameters, or when all
/// demonstrations share one value, every demonstration is a group of its own.
#[must_use]
pub fn folds(thetas: &[DVector<f64>]) -> Vec<Vec<usize>> {
    let groups = sharing(thetas);
    if groups.len() > 1 { groups } else { (0..thetas.len()).map(|k| vec![k]).collect() }
}

/// Groups of demonstrations that share their parameters, in the order of their first member.
fn sharing(thetas: &[DVector<f64>]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (k, theta) in thetas.iter().enumerate() {
        match groups.iter_mut().find(|group| thetas[group[0]] == *theta) {
            Some(group) => group.push(k),
            None => groups.push(vec![k]),
        }
    }
    groups
}

/// Which demonstrations of a dataset are left out together.
pub(super) struct Folds {
    /// When movements are predicted: those of one `theta_m`. When all share it, those of one `theta_f`; when they share that too, each
    /// alone.
    pub motion: Vec<Vec<usize>>,
    /// When wrenches are predicted: those of one `theta_f`, and as for movements when all share it.
    pub force: Vec<Vec<usize>>,
}

impl Folds {
    pub fn of(dataset: &Dataset) -> Result<Self, LearningError> {
        let thetas = |of: fn(&Demonstration) -> &Parameters| -> Vec<DVector<f64>> {
            let theta = |theta: &Parameters| DVector::from_iterator(theta.len(), theta.iter().map(|(_, value)| *value));
            dataset.demonstrations.iter().map(|d| theta(of(d))).collect()
        };
        let theta_m = thetas(|d| &d.theta_m);
        // Without wrenches nothing is learned about theta_f.
        let theta_f = if dataset.wrench.is_empty() { vec![DVector::zeros(0); theta_m.len()] } else { thetas(|d| &d.theta_f) };
        let (by_motion, by_force) = (sharing(&theta_m), sharing(&theta_f));
        let motion = if by_motion.len() > 1 { by_motion } else { folds(&theta_f) };
        if motion.len() < 2 {
            return Err(LearningError::Data("leaving demonstrations out needs at least two of them".to_owned()));
        }
        let force = if by_force.len() > 1 { by_force } else { motion.clone() };
        Ok(Self { motion, force })
    }
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
    use nalgebra::DMatrix;

    use super::*;
    use crate::demonstration::{ParameterSource, Trajectory};

    #[test]
    fn equal_parameters_are_left_out_together() {
        let thetas = [1.0, 2.0, 1.0, 3.0].map(|x| DVector::from_element(1, x));
        assert_eq!(folds(&thetas), [vec![0, 2], vec![1], vec![3]]);
        assert_eq!(folds(&thetas[..1]), [vec![0]]);
        assert_eq!(folds(&[DVector::zeros(0), DVector::zeros(0)]), [vec![0], vec![1]]);
    }

    /// One demonstration for each `(theta_m, theta_f)`.
    fn dataset(thetas: &[(f64, f64)], wrench: &[&str]) -> Dataset {
        let columns = ["x_m", "fx_n"].map(str::to_owned).to_vec();
        let trajectory = Trajectory::new(vec![0.0, 1.0], columns, DMatrix::zeros(2, 2)).unwrap();
        let one = |(theta_m, theta_f): &(f64, f64)| Demonstration {
            name: String::new(),
            trajectory: trajectory.clone(),
            theta_m: vec![("a".to_owned(), *theta_m)],
            theta_f: vec![("b".to_owned(), *theta_f)],
        };
        Dataset {
            motion: vec!["x_m".to_owned()],
            wrench: wrench.iter().map(|name| (*name).to_owned()).collect(),
            parameter_source: ParameterSource::Given,
            demonstrations: thetas.iter().map(one).collect(),
        }
    }

    /// Contract: nothing is predicted from another demonstration of its own parameters, of the motion or of the force.
    #[test]
    fn movements_are_left_out_by_theta_m_and_wrenches_by_theta_f() {
        let of = |thetas: &[(f64, f64)], wrench: &[&str]| {
            let folds = Folds::of(&dataset(thetas, wrench)).unwrap();
            (folds.motion, folds.force)
        };
        let (by_m, by_f) = (vec![vec![0, 1], vec![2, 3]], vec![vec![0, 2], vec![1, 3]]);
        let alone: Vec<Vec<usize>> = (0..4).map(|k| vec![k]).collect();
        let grid = [(1.0, 5.0), (1.0, 6.0), (2.0, 5.0), (2.0, 6.0)];
        assert_eq!(of(&grid, &["fx_n"]), (by_m.clone(), by_f.clone()));
        assert_eq!(of(&grid, &[]), (by_m.clone(), by_m.clone()), "without wrenches theta_f means nothing");
        assert_eq!(of(&grid.map(|(_, f)| (1.0, f)), &["fx_n"]), (by_f.clone(), by_f), "one theta_m for all");
        assert_eq!(of(&grid.map(|(m, _)| (m, 5.0)), &["fx_n"]), (by_m.clone(), by_m), "one theta_f for all");
        assert_eq!(of(&[(1.0, 5.0); 4], &["fx_n"]), (alone.clone(), alone));
        assert!(Folds::of(&dataset(&grid[..1], &["fx_n"])).is_err());
    }
}
