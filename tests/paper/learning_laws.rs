//! Laws the learning room must obey whatever the data: expectation maximisation climbs, its steps are maxima, deviations stay within their
//! bounds, files come back bit for bit, and threads change nothing.

use cpdmp::learning::phmm::{CovarianceMode, FitStatus, Group, Penalty, PhmmSettings, Sequence, Topology, fit, maximise_state, refine};
use cpdmp::learning::{FeatureMap, Features};
use cpdmp::math::{standard_normal, stream, uniform};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

/// Ragged sequences over `1 + columns` variables with `parameters` parameters, some of which are constant or collinear.
fn random_problem(seed: u64, columns: usize, parameters: usize, degenerate: bool, scale: f64) -> Vec<Sequence> {
    let mut random = stream(seed, "problems", 0);
    let demonstrations = 2 + seed as usize % 4;
    let sequence = |k: usize, random: &mut _| {
        let samples = 12 + (7 * k + seed as usize) % 20;
        let theta = DVector::from_fn(parameters, |j, _| match (degenerate, j) {
            (true, 0) => 0.3,
            (true, _) => 2.0 * k as f64 + j as f64,
            (false, _) => uniform(random, 0.1, 0.3),
        });
        let lift = theta.sum();
        let mut values = Vec::new();
        for t in 0..samples {
            let u = t as f64 / (samples - 1) as f64;
            values.push(u);
            values.extend((0..columns).map(|c| scale * ((6.0 * u + c as f64).sin() * (1.0 + lift) + 0.05 * standard_normal(random))));
        }
        Sequence { values, dimension: 1 + columns, theta }
    };
    (0..demonstrations).map(|k| sequence(k, &mut random)).collect()
}

const FEATURES: [Features; 3] = [Features::Linear, Features::Quadratic, Features::Rbf { centres: 3, width: 1.0 }];

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, ..ProptestConfig::default() })]

    #[test]
    fn the_objective_never_falls(
        seed in 0u64..1_000_000,
        (states, columns, parameters) in (1usize..6, 1usize..4, 0usize..3),
        (ergodic, on_phase, degenerate) in (any::<bool>(), any::<bool>(), any::<bool>()),
        (features, fixed, factor) in (0usize..3, any::<bool>(), prop_oneof![Just(1.0), Just(30.0)]),
        ridge in prop_oneof![Just(0.0), Just(0.1), Just(10.0)],
        floor in prop_oneof![Just(2e-6), Just(1e-5), Just(1e-2), Just(0.1)],
        scale in prop_oneof![Just(1e-3), Just(1.0), Just(1e3)],
    ) {
        let sequences = random_problem(seed, columns, parameters, degenerate, scale);
        let thetas: Vec<DVector<f64>> = sequences.iter().map(|s| s.theta.clone()).collect();
        let map = FeatureMap::of(FEATURES[features], &thetas, seed);
        let sequences: Vec<Sequence> = sequences.into_iter().map(|s| s.seen_through(&map)).collect();
        let settings = PhmmSettings {
            states,
            topology: if ergodic { Topology::Ergodic } else { Topology::LeftToRight },
            weights_on_phase: on_phase,
            features: FEATURES[features],
            covariance: if fixed { CovarianceMode::Fixed } else { CovarianceMode::Estimated },
            ridge,
            scale_factors: map.factors(&vec![factor; parameters]),
            covariance_floor: floor,
            kmeans_starts: 1,
            max_iterations: 60,
            tolerance: 1e-9,
        };
        let fit = fit(&sequences, &settings, seed).unwrap();
        prop_assert!(fit.starts.iter().all(|s| matches!(s.status, FitStatus::Converged | FitStatus::IterationLimit)), "{:?}", fit.starts);
        let samples: usize = sequences.iter().map(Sequence::samples).sum();
        for pair in fit.history.windows(2) {
            // Rounding is relative to the sum of the terms, which are larger than their sum when log-likelihoods cancel.
            let size = pair[0].abs() + (samples * (1 + columns)) as f64 * 8.0;
            prop_assert!(pair[1] >= pair[0] - 1e-9 * size, "fell from {} to {}", pair[0], pair[1]);
        }
        prop_assert!(fit.model.check().is_ok());
        prop_assert!(on_phase || fit.model.weights.iter().all(|w| w.row(0).amax() == 0.0), "weights on the phase row");
    }
}

/// Random groups of one state over four demonstrations, and what the model sees of their two parameters.
fn random_groups(seed: u64, features: Features) -> (Vec<Group>, Vec<DVector<f64>>) {
    let mut random = stream(seed, "groups", 0);
    let mut draw = |r, c| DMatrix::from_fn(r, c, |_, _| standard_normal(&mut random));
    let thetas: Vec<DVector<f64>> = (0..4).map(|_| draw(2, 1).column(0).into_owned()).collect();
    let groups = (0..4).map(|k| {
        let spread = draw(3, 3);
        let scatter = &spread * spread.transpose() + DMatrix::identity(3, 3);
        Group { count: 3.0 + k as f64, mean: draw(3, 1).column(0).into_owned(), scatter }
    });
    let groups = groups.collect();
    let map = FeatureMap::of(features, &thetas, seed);
    (groups, thetas.iter().map(|theta| map.at(theta)).collect())
}

/// `Q` of one state, straight from its definition in `phmm::maximisation`.
fn objective(groups: &[Group], thetas: &[DVector<f64>], penalty: &Penalty, w: &DMatrix<f64>, mean: &DVector<f64>, c: &DMatrix<f64>) -> f64 {
    let (inverse, log_determinant) = (c.clone().try_inverse().unwrap(), (c * std::f64::consts::TAU).determinant().ln());
    let mut q = penalty.log_prior(w, c).unwrap();
    for (group, theta) in groups.iter().zip(thetas) {
        let e = &group.mean - w * theta - mean;
        let scatter = &group.scatter + group.count * &e * e.transpose();
        q -= 0.5 * (group.count * log_determinant + (&inverse * scatter).trace());
    }
    q
}

#[test]
fn the_maximisation_step_is_a_stationary_point_of_its_objective() {
    let options = [(true, 0.0), (true, 2.0), (false, 0.0), (false, 2.0)];
    for (seed, features) in (0..20).flat_map(|seed| FEATURES.map(|features| (seed, features))) {
        for (weights_on_phase, ridge) in options {
            let (groups, thetas) = random_groups(seed, features);
            let features_seen = thetas[0].len();
            let penalty = Penalty { ridge, floor: 1e-9, weights_on_phase, parametric: true, fixed_covariance: false };
            let present = (DMatrix::zeros(3, features_seen), DMatrix::identity(3, 3));
            let (w, mean, c) =
                maximise_state(&groups.iter().collect::<Vec<_>>(), &thetas.iter().collect::<Vec<_>>(), (&present.0, &present.1), &penalty)
                    .unwrap();
            let q = |w: &DMatrix<f64>, mean: &DVector<f64>, c: &DMatrix<f64>| objective(&groups, &thetas, &penalty, w, mean, c);
            let h = 1e-5;
            let slope = |plus: f64, minus: f64| ((plus - minus) / (2.0 * h)).abs();
            for i in 0..3 {
                let step = DVector::from_fn(3, |r, _| if r == i { h } else { 0.0 });
                assert!(slope(q(&w, &(&mean + &step), &c), q(&w, &(&mean - &step), &c)) < 1e-6, "mean {i}, seed {seed}");
                for j in 0..3 {
                    let step = DMatrix::from_fn(3, 3, |r, s| if (r, s) == (i, j) || (r, s) == (j, i) { h } else { 0.0 });
                    assert!(slope(q(&w, &mean, &(&c + &step)), q(&w, &mean, &(&c - &step))) < 1e-5, "covariance {i} {j}, seed {seed}");
                }
                for j in (0..features_seen).filter(|_| i > 0 || weights_on_phase) {
                    let step = DMatrix::from_fn(3, features_seen, |r, s| if (r, s) == (i, j) { h } else { 0.0 });
                    let slope = slope(q(&(&w + &step), &mean, &c), q(&(&w - &step), &mean, &c));
                    assert!(slope < 1e-6, "weight {i} {j}, seed {seed}, {features:?}: {slope}");
                }
            }
        }
    }
}

#[test]
fn a_floored_step_still_raises_the_objective_above_any_feasible_present() {
    for seed in 0..200 {
        let (groups, thetas) = random_groups(seed, Features::Linear);
        let (references, parameters): (Vec<_>, Vec<_>) = (groups.iter().collect(), thetas.iter().collect());
        let penalty = Penalty { ridge: 0.5, floor: 1.5, weights_on_phase: false, parametric: true, fixed_covariance: false };
        let mut present = (DMatrix::zeros(3, 2), DVector::zeros(3), DMatrix::identity(3, 3) * 2.0);
        let mut before = objective(&groups, &thetas, &penalty, &present.0, &present.1, &present.2);
        for _ in 0..10 {
            present = maximise_state(&references, &parameters, (&present.0, &present.2), &penalty).unwrap();
            let after = objective(&groups, &thetas, &penalty, &present.0, &present.1, &present.2);
            assert!(after >= before - 1e-10 * before.abs(), "seed {seed}: fell from {before} to {after}");
            assert!(present.2.symmetric_eigenvalues().min() > 1.5 - 1e-12);
            before = after;
        }
    }
}

#[test]
fn the_unit_of_the_data_changes_the_result_only_as_it_must() {
    let settings = PhmmSettings { states: 4, kmeans_starts: 1, ..Default::default() };
    let reference = fit(&random_problem(3, 2, 1, false, 1.0), &settings, 0).unwrap().model;
    for scale in [1e-3, 1e3] {
        let scaled = fit(&random_problem(3, 2, 1, false, scale), &settings, 0).unwrap().model;
        for i in 0..4 {
            let back = |x: f64, row: usize| if row == 0 { x } else { x / scale };
            for row in 0..3 {
                assert!((back(scaled.means[i][row], row) - reference.means[i][row]).abs() < 1e-7);
                assert!((back(scaled.weights[i][(row, 0)], row) - reference.weights[i][(row, 0)]).abs() < 1e-6);
            }
        }
    }
}

#[test]
fn refining_with_no_tolerance_makes_exactly_the_iterations_asked_for() {
    let sequences = random_problem(5, 2, 1, false, 1.0);
    let first = fit(&sequences, &PhmmSettings { states: 3, max_iterations: 1, ..Default::default() }, 0).unwrap().model;
    let settings = PhmmSettings { states: 3, max_iterations: 20, tolerance: 0.0, ..Default::default() };
    let refined = refine(&first, &sequences, &settings).unwrap();
    assert_eq!((refined.history.len(), refined.status, refined.starts.len()), (21, FitStatus::IterationLimit, 1));
    let wrong = PhmmSettings { states: 3, ..Default::default() };
    assert!(refine(&first, &random_problem(5, 3, 1, false, 1.0), &wrong).is_err());
}

#[test]
fn one_theta_for_all_and_collinear_parameters_leave_the_means_finite() {
    let settings = PhmmSettings { states: 3, ridge: 0.0, ..Default::default() };
    let fit = fit(&random_problem(2, 2, 2, true, 1.0), &settings, 0).unwrap();
    for (i, w) in fit.model.weights.iter().enumerate() {
        assert!(w.column(0).amax() == 0.0, "state {i}: the parameter that never varied has weights {w}");
        let away = fit.model.mean_at(i, &DVector::from_vec(vec![1e3, 5.0]));
        assert!(away.iter().all(|x| x.is_finite() && x.abs() < 1e3), "state {i}: {away}");
    }
}
