//! The parametric hidden Markov model against independent truth: the textbook's iterations in user units, sums over all paths, finite
//! differences, planted models, and changes of unit.

use cpdmp::demonstration::synthetic::PickAndPlace;
use cpdmp::learning::phmm::{CovarianceMode, FitStatus, Phmm, PhmmSettings, Sequence, Topology, expect, fit, refine};
use cpdmp::learning::{FeatureMap, Features, LearningSettings, Skill, learn};
use cpdmp::math::{Gaussian, log_sum_exp, standard_normal, stream, uniform};
use nalgebra::{DMatrix, DVector};

const ALL_FEATURES: [Features; 3] = [Features::Linear, Features::Quadratic, Features::Rbf { centres: 4, width: 1.5 }];

/// A random model over two variables and `p` parameters; left to right when asked.
fn random_model(seed: u64, n: usize, p: usize, left_to_right: bool) -> Phmm {
    let mut random = stream(seed, "models", 0);
    let mut draw = |r, c| DMatrix::from_fn(r, c, |_, _| standard_normal(&mut random));
    let mut row = |from: usize| {
        let open = |j: usize| !left_to_right || j == from || j == from + 1;
        let row = DVector::from_fn(n, |j, _| if open(j) { 0.2 + draw(1, 1)[0].abs() } else { 0.0 });
        let sum = row.sum();
        row / sum
    };
    let rows: Vec<_> = (0..n).map(|i| row(i).transpose()).collect();
    let initial = if left_to_right { DVector::from_fn(n, |i, _| if i == 0 { 1.0 } else { 0.0 }) } else { row(0) };
    let covariance = |spread: DMatrix<f64>| &spread * spread.transpose() * 0.05 + DMatrix::identity(2, 2) * 0.05;
    Phmm {
        initial,
        transition: DMatrix::from_rows(&rows),
        weights: (0..n).map(|_| draw(2, p)).collect(),
        means: (0..n).map(|i| DVector::from_vec(vec![i as f64, 0.0]) + draw(2, 1).column(0) * 0.3).collect(),
        covariances: (0..n).map(|_| covariance(draw(2, 2))).collect(),
    }
}

/// Ragged sequences drawn from a model, under random parameters.
fn drawn(model: &Phmm, sequences: usize, samples: usize, seed: u64) -> Vec<Sequence> {
    let mut random = stream(seed, "draws", 0);
    let pick = |row: &DVector<f64>, mut left: f64| {
        let last = row.iter().rposition(|a| *a > 0.0).unwrap();
        row.iter()
            .position(|a| {
                left -= a;
                left < 0.0
            })
            .unwrap_or(last)
    };
    let sequence = |k: usize| {
        let theta = DVector::from_fn(model.parameters(), |_, _| standard_normal(&mut random));
        let mut state = pick(&model.initial, uniform(&mut random, 0.0, 1.0));
        let mut values = Vec::new();
        for _ in 0..samples + k {
            let noise = DVector::from_fn(2, |_, _| standard_normal(&mut random));
            let factor = model.covariances[state].clone().cholesky().unwrap().l();
            values.extend((model.mean_at(state, &theta) + factor * noise).iter());
            state = pick(&model.transition.row(state).transpose(), uniform(&mut random, 0.0, 1.0));
        }
        Sequence { values, dimension: 2, theta }
    };
    (0..sequences).map(sequence).collect()
}

fn log_likelihood(model: &Phmm, sequences: &[Sequence]) -> f64 {
    sequences.iter().map(|s| expect(model, s).unwrap().log_likelihood).sum()
}

#[test]
fn the_likelihood_of_several_sequences_is_the_sum_over_all_paths() {
    for seed in 0..20 {
        let model = random_model(seed, 3, seed as usize % 3, seed % 2 == 0);
        let sequences = drawn(&model, 3, 4, seed);
        let brute = |s: &Sequence| {
            let density = |i: usize, t: usize| {
                let gaussian = Gaussian::new(model.mean_at(i, &s.theta), model.covariances[i].clone()).unwrap();
                gaussian.log_density(&DVector::from_column_slice(s.sample(t)))
            };
            let path = |number: usize| {
                let states: Vec<usize> = (0..s.samples()).map(|t| number / 3usize.pow(t as u32) % 3).collect();
                let moves: f64 = states.windows(2).map(|ij| model.transition[(ij[0], ij[1])].ln()).sum();
                model.initial[states[0]].ln() + moves + states.iter().enumerate().map(|(t, i)| density(*i, t)).sum::<f64>()
            };
            log_sum_exp(&(0..3usize.pow(s.samples() as u32)).map(path).collect::<Vec<_>>())
        };
        let truth: f64 = sequences.iter().map(brute).sum();
        assert!((log_likelihood(&model, &sequences) - truth).abs() < 1e-12 * truth.abs().max(1.0), "seed {seed}");
    }
}

#[test]
fn the_gradient_of_the_likelihood_is_that_of_the_expected_statistics() {
    for seed in 0..6 {
        let model = random_model(seed, 3, 2, seed % 2 == 0);
        let sequences = drawn(&model, 3, 12, seed);
        let slope = |change: &dyn Fn(&mut Phmm, f64)| {
            let at = |h: f64| {
                let mut moved = model.clone();
                change(&mut moved, h);
                log_likelihood(&moved, &sequences)
            };
            (8.0 * (at(1e-4) - at(-1e-4)) - (at(2e-4) - at(-2e-4))) / 12e-4
        };
        let expectations: Vec<_> = sequences.iter().map(|s| expect(&model, s).unwrap()).collect();
        let close = |a: f64, b: f64, what: &str| assert!((a - b).abs() < 1e-6 * b.abs().max(10.0), "seed {seed}, {what}: {a} and {b}");
        for i in 0..3 {
            let inverse = model.covariances[i].clone().try_inverse().unwrap();
            let (mut by_mean, mut by_weight, mut by_covariance) = (DVector::zeros(2), DMatrix::zeros(2, 2), DMatrix::zeros(2, 2));
            for (s, e) in sequences.iter().zip(&expectations) {
                for t in 0..s.samples() {
                    let gamma = e.responsibilities()[t * 3 + i];
                    let pull = &inverse * (DVector::from_column_slice(s.sample(t)) - model.mean_at(i, &s.theta));
                    by_mean += gamma * &pull;
                    by_weight += gamma * &pull * s.theta.transpose();
                    by_covariance += 0.5 * gamma * (&pull * pull.transpose() - &inverse);
                }
            }
            for a in 0..2 {
                close(slope(&|m, h| m.means[i][a] += h), by_mean[a], "mean");
                for b in 0..2 {
                    close(slope(&|m, h| m.weights[i][(a, b)] += h), by_weight[(a, b)], "weight");
                    let both = |m: &mut Phmm, h: f64| {
                        m.covariances[i][(a, b)] += 0.5 * h;
                        m.covariances[i][(b, a)] += 0.5 * h;
                    };
                    close(slope(&both), by_covariance[(a, b)], "covariance");
                }
            }
            for j in (0..3).filter(|j| model.transition[(i, *j)] > 0.0) {
                let count: f64 = expectations.iter().map(|e| e.transitions[(i, j)]).sum();
                close(slope(&|m, h| m.transition[(i, j)] += h), count / model.transition[(i, j)], "transition");
            }
        }
    }
}

/// One iteration as the paper writes it, in user units, with plain inverses.
fn textbook_iteration(model: &Phmm, sequences: &[Sequence]) -> Phmm {
    let (n, p) = (model.states(), model.parameters());
    let mut next = model.clone();
    let all: Vec<_> = sequences.iter().map(|s| (s, expect(model, s).unwrap())).collect();
    next.initial = DVector::from_fn(n, |i, _| all.iter().map(|(_, e)| e.responsibilities()[i]).sum::<f64>() / all.len() as f64);
    let moves = all.iter().fold(DMatrix::zeros(n, n), |sum, (_, e)| sum + &e.transitions);
    next.transition = DMatrix::from_fn(n, n, |i, j| moves[(i, j)] / moves.row(i).sum());
    for i in 0..n {
        let (mut x_omega, mut omega_omega) = (DMatrix::zeros(2, p + 1), DMatrix::zeros(p + 1, p + 1));
        let samples: Vec<_> = all
            .iter()
            .flat_map(|(s, e)| {
                (0..s.samples()).map(move |t| (e.responsibilities()[t * n + i], DVector::from_column_slice(s.sample(t)), s.theta.push(1.0)))
            })
            .collect();
        for (gamma, x, omega) in &samples {
            x_omega += *gamma * x * omega.transpose();
            omega_omega += *gamma * omega * omega.transpose();
        }
        let z = x_omega * omega_omega.try_inverse().unwrap();
        let count: f64 = samples.iter().map(|(gamma, _, _)| gamma).sum();
        let scatter = |(gamma, x, omega): &(f64, DVector<f64>, DVector<f64>)| {
            let e = x - &z * omega;
            *gamma * &e * e.transpose()
        };
        next.covariances[i] = samples.iter().map(scatter).fold(DMatrix::zeros(2, 2), |sum, part| sum + part) / count;
        (next.weights[i], next.means[i]) = (z.columns(0, p).into_owned(), z.column(p).into_owned());
    }
    next
}

#[test]
fn without_prior_and_floor_twenty_iterations_are_the_textbooks() {
    for (seed, p) in [(1, 0), (2, 1), (3, 2), (4, 1)] {
        let truth = random_model(seed, 3, p, false);
        let sequences = drawn(&truth, 8, 60, seed);
        let mut book = random_model(seed, 3, p, false);
        book.means.iter_mut().for_each(|m| *m *= 1.3);
        let settings = PhmmSettings {
            states: 3,
            topology: Topology::Ergodic,
            weights_on_phase: true,
            ridge: 0.0,
            covariance_floor: 0.0,
            max_iterations: 20,
            tolerance: 0.0,
            ..PhmmSettings::default()
        };
        let ours = refine(&book, &sequences, &settings).unwrap();
        for k in 0..=20 {
            let truth = log_likelihood(&book, &sequences);
            assert!((ours.history[k] - truth).abs() < 1e-10 * truth.abs(), "seed {seed}, iteration {k}: {} and {truth}", ours.history[k]);
            if k < 20 {
                book = textbook_iteration(&book, &sequences);
            }
        }
        let mut off = (&ours.model.initial - &book.initial).amax().max((&ours.model.transition - &book.transition).amax());
        for i in 0..3 {
            off = off.max((&ours.model.means[i] - &book.means[i]).amax()).max((&ours.model.covariances[i] - &book.covariances[i]).amax());
            off = off.max((&ours.model.weights[i] - &book.weights[i]).abs().iter().fold(0.0, |m: f64, x| m.max(*x)));
        }
        assert!(off < 1e-9, "seed {seed}: parameters differ by {off}");
    }
}

#[test]
fn a_planted_model_is_found() {
    let mut planted = random_model(7, 3, 1, true);
    planted.transition = DMatrix::from_row_slice(3, 3, &[0.95, 0.05, 0.0, 0.0, 0.95, 0.05, 0.0, 0.0, 1.0]);
    for i in 0..3 {
        planted.means[i] = DVector::from_vec(vec![2.0 * i as f64, [1.0, -1.0, 2.0][i]]);
        planted.weights[i] = DMatrix::from_row_slice(2, 1, &[0.0, [0.5, -1.0, 2.0][i]]);
        planted.covariances[i] = DMatrix::from_row_slice(2, 2, &[0.04, 0.01, 0.01, 0.02]);
    }
    let sequences = drawn(&planted, 60, 80, 7);
    let found = fit(&sequences, &PhmmSettings { states: 3, ridge: 0.0, ..PhmmSettings::default() }, 0).unwrap().model;
    for i in 0..3 {
        assert!((&found.means[i] - &planted.means[i]).amax() < 0.03, "mean {i}: {}", found.means[i]);
        assert!((&found.weights[i] - &planted.weights[i]).amax() < 0.03, "weights {i}: {}", found.weights[i]);
        assert!((&found.covariances[i] - &planted.covariances[i]).amax() < 0.01, "covariance {i}: {}", found.covariances[i]);
    }
}

/// Bent movements under two parameters.
fn movements(seed: u64, scale: &[f64; 2], theta_scale: f64) -> (Vec<Sequence>, Vec<DVector<f64>>) {
    let mut random = stream(seed, "movements", 0);
    let mut thetas = Vec::new();
    let sequence = |k: usize| {
        let theta = DVector::from_vec(vec![0.1 + 0.05 * k as f64, (1.3 * k as f64).sin()]);
        let mut values = Vec::new();
        for t in 0..40 {
            let u = t as f64 / 39.0;
            let noise = [standard_normal(&mut random), standard_normal(&mut random)];
            values.push(u);
            values.push(scale[0] * ((6.0 * u).sin() * (1.0 + 10.0 * theta[0] * theta[0]) + 0.03 * noise[0]));
            values.push(scale[1] * ((4.0 * u).cos() + theta[1] * u + 0.03 * noise[1]));
        }
        thetas.push(&theta * theta_scale);
        Sequence { values, dimension: 3, theta: theta * theta_scale }
    };
    ((0..7).map(sequence).collect(), thetas)
}

#[test]
fn units_of_columns_and_parameters_change_the_result_only_as_they_must() {
    for features in ALL_FEATURES {
        for covariance in [CovarianceMode::Estimated, CovarianceMode::Fixed] {
            let settings = PhmmSettings {
                states: 4,
                kmeans_starts: 1,
                max_iterations: 30,
                tolerance: 0.0,
                features,
                covariance,
                ..Default::default()
            };
            let learned = |scale: [f64; 2], theta_scale: f64| {
                let (sequences, thetas) = movements(3, &scale, theta_scale);
                let map = FeatureMap::of(features, &thetas, 0);
                let fit = fit(&sequences.into_iter().map(|s| s.seen_through(&map)).collect::<Vec<_>>(), &settings, 0).unwrap();
                (fit, map.at(&(DVector::from_vec(vec![0.33, 0.4]) * theta_scale)))
            };
            let (reference, phi) = learned([1.0, 1.0], 1.0);
            for (scale, theta_scale) in [([1e-3, 1e3], 1.0), ([1.0, 1.0], 1e3), ([1e3, 1e3], 1e-3)] {
                let (scaled, phi_scaled) = learned(scale, theta_scale);
                let units = DVector::from_vec(vec![1.0, scale[0], scale[1]]);
                for i in 0..4 {
                    let off = scaled.model.mean_at(i, &phi_scaled).component_div(&units) - reference.model.mean_at(i, &phi);
                    assert!(off.amax() < 1e-6, "{features:?}, {covariance:?}, {scale:?}, {theta_scale}: mean {i} off by {}", off.amax());
                    assert!((scaled.evidence[i].ratio(&phi_scaled) / reference.evidence[i].ratio(&phi) - 1.0).abs() < 1e-5);
                }
                let jacobian = 7.0 * 40.0 * (scale[0].ln() + scale[1].ln());
                for (a, b) in scaled.history.iter().zip(&reference.history) {
                    assert!((a + jacobian - b).abs() < 1e-7 * b.abs().max(1.0), "{features:?}: likelihood {a} + {jacobian} and {b}");
                }
            }
        }
    }
}

#[test]
fn fixed_covariances_stay_those_of_the_plain_model_and_are_wider() {
    let (sequences, _) = movements(5, &[1.0, 1.0], 1.0);
    let of = |covariance| fit(&sequences, &PhmmSettings { states: 4, kmeans_starts: 0, covariance, ..Default::default() }, 0).unwrap();
    let (estimated, fixed) = (of(CovarianceMode::Estimated), of(CovarianceMode::Fixed));
    let volume = |m: &Phmm| m.covariances.iter().map(|c| c.determinant().ln()).sum::<f64>();
    assert!(volume(&fixed.model) > volume(&estimated.model) && fixed.starts.len() == 1);
    let again =
        refine(&fixed.model, &sequences, &PhmmSettings { states: 4, covariance: CovarianceMode::Fixed, ..Default::default() }).unwrap();
    let off = |i: usize| (&again.model.covariances[i] - &fixed.model.covariances[i]).amax();
    assert!((0..4).all(|i| off(i) < 1e-14) && again.history.windows(2).all(|h| h[1] >= h[0] - 1e-9 * h[0].abs()));
}

#[test]
fn what_cannot_be_learned_is_said_with_numbers() {
    let (sequences, _) = movements(1, &[1.0, 1.0], 1.0);
    let message = |sequences: &[Sequence], settings: &PhmmSettings| fit(sequences, settings, 0).unwrap_err().to_string();
    let many = PhmmSettings { states: 100, ..Default::default() };
    assert!(message(&sequences[..1], &many).contains("1 demonstration with 40 samples cannot support 100 states; use fewer"));
    let mut broken = sequences.clone();
    broken[2].values[3 * 5 + 1] = f64::NAN;
    assert!(message(&broken, &PhmmSettings::default()).contains("sequence 2, sample 5, variable 1: not a finite number"));
    let still =
        Sequence { values: vec![0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 1.0, 2.0, 1.0, 2.0, 1.0, 2.0], dimension: 2, theta: DVector::zeros(0) };
    let none = PhmmSettings { states: 3, covariance_floor: 0.0, ..Default::default() };
    assert!(message(&[still], &none).contains("raise covariance_floor"), "a collapse without a floor");
    // From left to right, three samples reach the third state and no further.
    let short = |s: &Sequence| Sequence { values: s.values[..9].to_vec(), dimension: 3, theta: DVector::zeros(0) };
    let short: Vec<Sequence> = sequences[..4].iter().map(short).collect();
    let crowded = message(&short, &PhmmSettings { states: 6, ..Default::default() });
    assert!(
        crowded.starts_with("state 3 of 6") && crowded.contains("4 demonstrations with 12 samples cannot support 6 states"),
        "{crowded}"
    );
    let one = fit(&sequences[..1], &PhmmSettings { states: 4, ..Default::default() }, 0).unwrap();
    assert!(
        one.starts.iter().all(|s| s.history.len() == s.iterations + 1 && s.status != FitStatus::Degenerate) && one.model.check().is_ok()
    );
}

fn skill(features: Features) -> Skill {
    let mut settings = LearningSettings::default();
    for model in [&mut settings.motion, &mut settings.force] {
        (model.features, model.kmeans_starts, model.max_iterations) = (features, 0, 30);
    }
    let task = PickAndPlace { block_heights_m: vec![0.17, 0.19, 0.22, 0.26], rate_hz: 50.0, ..PickAndPlace::default() };
    learn(&task.dataset(2), &settings, 2).unwrap().skill
}

#[test]
fn a_skill_knows_less_the_farther_it_is_asked_and_its_file_says_the_same() {
    for features in ALL_FEATURES {
        let skill = skill(features);
        let back = Skill::from_json(&skill.to_json().unwrap()).unwrap();
        assert_eq!(back, skill, "{features:?}");
        let height = |h: f64| vec![("block_height_m".to_owned(), h)];
        let ratio = |h: f64| back.extrapolation_ratio(&height(h)).unwrap().unwrap();
        assert!((0..10).all(|k| ratio(0.17 + 0.01 * f64::from(k)) < 0.6), "{features:?}: inside {}", ratio(0.2));
        for k in 0..30 {
            let (near, far) = (0.27 + 0.01 * f64::from(k), 0.28 + 0.01 * f64::from(k));
            assert!(ratio(far) > ratio(near) * (1.0 - 1e-12), "{features:?}: {} at {near}, {} at {far}", ratio(near), ratio(far));
        }
        let (inside, outside) =
            (back.predictive(&height(0.2), 0.2).unwrap().unwrap(), back.predictive(&height(0.5), 0.2).unwrap().unwrap());
        assert!(outside.epistemic.trace() > 2.0 * inside.epistemic.trace());
        assert!(inside.covariance().symmetric_eigenvalues().min() > 0.0);
        assert!(inside.epistemic.trace() < 0.6 * inside.aleatoric.trace());
        // Far away what is not known grows with the distance at least, whatever becomes of the features.
        let away = |ranges: f64| back.predictive(&height(0.17 + 0.09 * ranges), 0.2).unwrap().unwrap().epistemic.trace().sqrt();
        assert!(away(40.0) > 1.9 * away(20.0), "{features:?}: {} after {}", away(40.0), away(20.0));
        let asked = |ranges: f64| back.deviation(&DVector::from_element(1, 0.17 + 0.09 * ranges), &[0.2]).unwrap()[(0, 0)];
        let expected = back.predictive(&height(0.17 + 0.09 * 20.0), 0.2).unwrap().unwrap().covariance()[(0, 0)].sqrt();
        assert!((asked(20.0) - expected).abs() < 1e-12 * expected);
    }
}

#[test]
fn bent_features_follow_what_linear_ones_cannot() {
    let (sequences, thetas) = movements(11, &[1.0, 1.0], 1.0);
    let error = |features| {
        let map = FeatureMap::of(features, &thetas, 0);
        let seen: Vec<Sequence> = sequences.iter().cloned().map(|s| s.seen_through(&map)).collect();
        let fit = fit(&seen, &PhmmSettings { states: 8, ridge: 0.0, features, ..Default::default() }, 0).unwrap();
        fit.history.last().copied().unwrap()
    };
    assert!(error(Features::Quadratic) > error(Features::Linear) + 10.0);
}
