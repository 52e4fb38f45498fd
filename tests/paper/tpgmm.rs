//! Laws of task-parameterised mixtures: expectation maximisation climbs, products are products, and motion moves with its frames.

use cpdmp::learning::Gmr;
use cpdmp::learning::phmm::FitStatus;
use cpdmp::learning::tpgmm::{Frame, FramedSequence, TpGmmFit, TpGmmSettings, fit};
use cpdmp::math::{Gaussian, minimum_jerk, standard_normal, stream, uniform};
use nalgebra::{DMatrix, DVector, Rotation2};
use proptest::prelude::*;

fn turned(angle: f64, origin: [f64; 2]) -> Frame {
    let r = Rotation2::new(angle);
    let axes = DMatrix::from_row_slice(2, 2, &[r[(0, 0)], r[(0, 1)], r[(1, 0)], r[(1, 1)]]);
    Frame::new(axes, DVector::from_column_slice(&origin)).unwrap()
}

/// From `start`, leaving along its first axis, to `goal`, arriving along its first axis: a cubic Bezier curve at minimum-jerk pace.
fn curve(start: &Frame, goal: &Frame, u: f64) -> [f64; 2] {
    let point = |frame: &Frame, x: f64| {
        let (p, _) = frame.global(&DVector::from_vec(vec![0.0, x, 0.0]), &DMatrix::identity(3, 3));
        [p[1], p[2]]
    };
    let s = minimum_jerk(u).position;
    let share = [(1.0 - s).powi(3), 3.0 * s * (1.0 - s).powi(2), 3.0 * s * s * (1.0 - s), s.powi(3)];
    let points = [point(start, 0.0), point(start, 1.0), point(goal, -1.0), point(goal, 0.0)];
    [0, 1].map(|i| share.iter().zip(&points).map(|(b, p)| b * p[i]).sum())
}

fn demonstration(frames: [Frame; 2], noise: f64, random: &mut rand_chacha::ChaCha8Rng) -> FramedSequence {
    let mut values = Vec::new();
    for t in 0..60 {
        let u = f64::from(t) / 59.0;
        values.push(u);
        values.extend(curve(&frames[0], &frames[1], u).map(|x| x + noise * standard_normal(random)));
    }
    FramedSequence { values, frames: frames.to_vec() }
}

fn random_frames(random: &mut rand_chacha::ChaCha8Rng, spread: f64) -> [Frame; 2] {
    let mut draw = |centre: f64, width: f64| centre + spread * width * uniform(random, -1.0, 1.0);
    [turned(draw(0.0, 0.8), [draw(0.0, 1.0), draw(0.0, 1.0)]), turned(draw(0.0, 0.8), [draw(5.0, 1.0), draw(2.0, 1.0)])]
}

fn planted(seed: u64, demonstrations: usize) -> Vec<FramedSequence> {
    let mut random = stream(seed, "planted", 0);
    (0..demonstrations)
        .map(|_| {
            let frames = random_frames(&mut random, 1.0);
            demonstration(frames, 0.002, &mut random)
        })
        .collect()
}

fn inputs() -> Vec<f64> {
    (0..=100).map(|t| f64::from(t) / 100.0).collect()
}

/// Distances from the planted motion between `frames`: root mean square over the movement, and at its two ends.
fn errors(fitted: &TpGmmFit, given: &[Frame], frames: &[Frame; 2]) -> [f64; 3] {
    let path = fitted.model.reproduce(given, &inputs()).unwrap();
    let error = |(row, u): (usize, &f64)| {
        let truth = curve(&frames[0], &frames[1], *u);
        (path[(row, 0)] - truth[0]).hypot(path[(row, 1)] - truth[1])
    };
    let all: Vec<f64> = inputs().iter().enumerate().map(error).collect();
    let mean_square = all.iter().map(|e| e * e).sum::<f64>() / all.len() as f64;
    [mean_square.sqrt(), all[0], all[all.len() - 1]]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, ..ProptestConfig::default() })]

    #[test]
    fn the_objective_never_falls(
        seed in 0u64..1_000_000,
        (components, frames, columns) in (1usize..7, 1usize..4, 1usize..4),
        floor in prop_oneof![Just(2e-6), Just(1e-5), Just(1e-2), Just(0.1)],
        scale in prop_oneof![Just(1e-3), Just(1.0), Just(1e3)],
        (constant, still) in (any::<bool>(), any::<bool>()),
    ) {
        let mut random = stream(seed, "problems", 0);
        let sequences: Vec<FramedSequence> = (0..3 + seed as usize % 3).map(|k| {
            let samples = 10 + (7 * k + seed as usize) % 20;
            let frames = (0..frames).map(|_| {
                let mut draw = |r, c| DMatrix::from_fn(r, c, |_, _| standard_normal(&mut random));
                let axes = draw(columns, columns) * 0.2 + DMatrix::identity(columns, columns);
                let origin = if still { DVector::zeros(columns) } else { draw(columns, 1).column(0) * scale };
                Frame::new(axes, origin).unwrap()
            }).collect();
            let values = (0..samples).flat_map(|t| {
                let u = t as f64 / (samples - 1) as f64;
                let mut row = vec![u];
                row.extend((0..columns).map(|c| match (constant, c) {
                    (true, 0) => 0.3 * scale,
                    _ => scale * ((6.0 * u + c as f64).sin() + 0.05 * standard_normal(&mut random)),
                }));
                row
            }).collect();
            FramedSequence { values, frames }
        }).collect();
        let settings = TpGmmSettings { components, covariance_floor: floor, kmeans_starts: 2, max_iterations: 60, tolerance: 1e-9 };
        let fitted = fit(&sequences, &settings, seed).unwrap();
        let ended = |s: FitStatus| matches!(s, FitStatus::Converged | FitStatus::IterationLimit);
        prop_assert!(fitted.starts.iter().all(|s| ended(s.status)), "{:?}", fitted.starts);
        let samples: usize = sequences.iter().map(FramedSequence::samples).sum();
        for pair in fitted.history.windows(2) {
            let size = pair[0].abs() + (samples * frames * (1 + columns)) as f64 * 8.0;
            prop_assert!(pair[1] >= pair[0] - 1e-9 * size, "fell from {} to {}", pair[0], pair[1]);
        }
        prop_assert!((fitted.model.priors.sum() - 1.0).abs() < 1e-9);
        let path = fitted.model.reproduce(&sequences[0].frames, &[-1e3, 0.0, 0.5, 1.0, 1e3]).unwrap();
        prop_assert!(path.iter().all(|x| x.is_finite()));
    }
}

/// Log-likelihood of a plain mixture at the samples, term by term.
#[test]
fn one_frame_that_stays_is_a_plain_mixture() {
    let mut sequences = planted(1, 4);
    for sequence in &mut sequences {
        sequence.frames = vec![Frame::at(&[0.0, 0.0]).unwrap()];
    }
    let settings = TpGmmSettings { components: 6, ..TpGmmSettings::default() };
    let fitted = fit(&sequences, &settings, 0).unwrap();
    let (means, covariances) = (&fitted.model.means[0], &fitted.model.covariances[0]);
    let parts: Vec<Gaussian> = (0..6).map(|i| Gaussian::new(means[i].clone(), covariances[i].clone()).unwrap()).collect();
    let rows = sequences.iter().flat_map(|s| s.values.chunks_exact(3));
    let likelihood = |row: &[f64]| -> f64 {
        let x = DVector::from_column_slice(row);
        (0..6).map(|i| fitted.model.priors[i] * parts[i].log_density(&x).exp()).sum::<f64>().ln()
    };
    let direct: f64 = rows.map(likelihood).sum();
    let reported = fitted.history.last().unwrap();
    assert!((direct - reported).abs() < 1e-8 * direct.abs(), "{direct} {reported}");
    let gmr = Gmr::new(means, covariances, 1).unwrap();
    let path = fitted.model.reproduce(&sequences[0].frames, &inputs()).unwrap();
    for (t, u) in inputs().iter().enumerate() {
        assert!((path.row(t).transpose() - gmr.mean(&[*u])).norm() < 1e-9);
    }
    // A fixed point: means are averages weighted by their own responsibilities, to the tolerance of the iterations.
    let exact = fit(&sequences, &TpGmmSettings { tolerance: 1e-12, max_iterations: 5000, ..settings }, 0).unwrap();
    assert!(exact.history.last().unwrap() >= reported);
}

#[test]
fn the_product_is_proportional_to_the_product_of_the_densities() {
    let fitted = fit(&planted(2, 5), &TpGmmSettings { components: 4, ..TpGmmSettings::default() }, 0).unwrap();
    let frames = [turned(0.4, [0.5, -0.2]), turned(-0.3, [4.8, 2.5])];
    let products = fitted.model.product(&frames).unwrap();
    for (i, product) in products.iter().enumerate() {
        let factors: Vec<Gaussian> = (0..2)
            .map(|j| {
                let (mean, covariance) = frames[j].global(&fitted.model.means[j][i], &fitted.model.covariances[j][i]);
                Gaussian::new(mean, covariance).unwrap()
            })
            .collect();
        // ln prod_j N_j(x) - ln N(x) is the same for every x.
        let constant = |x: &DVector<f64>| factors.iter().map(|g| g.log_density(x)).sum::<f64>() - product.log_density(x);
        let reference = constant(product.mean());
        for axis in 0..3 {
            let mut x = product.mean().clone();
            x[axis] += 2.0 * product.covariance()[(axis, axis)].sqrt();
            assert!((constant(&x) - reference).abs() < 1e-7 * reference.abs().max(1.0), "{} {reference}", constant(&x));
        }
    }
}

#[test]
fn a_motion_turns_and_moves_with_its_frames() {
    let fitted = fit(&planted(3, 6), &TpGmmSettings::default(), 0).unwrap();
    let (r, shift) = (Rotation2::new(1.1), [7.0, -3.0]);
    let places = [(0.3, [0.4, 0.1]), (-0.5, [5.2, 1.7])];
    let moved = |(angle, p): (f64, [f64; 2])| {
        let q = r * nalgebra::Vector2::from(p);
        turned(angle + 1.1, [q.x + shift[0], q.y + shift[1]])
    };
    let here = fitted.model.reproduce(&places.map(|(angle, p)| turned(angle, p)), &inputs()).unwrap();
    let there = fitted.model.reproduce(&places.map(moved), &inputs()).unwrap();
    for (a, b) in here.row_iter().zip(there.row_iter()) {
        let expected = r * nalgebra::Vector2::new(a[0], a[1]);
        assert!((expected.x + shift[0] - b[0]).hypot(expected.y + shift[1] - b[1]) < 1e-9);
    }
    // So is what is learned: the same demonstrations somewhere else give the same mixture in the frames.
    let whole = planted(3, 6).into_iter().map(|sequence| {
        let values = sequence.values.chunks_exact(3).flat_map(|row| {
            let q = r * nalgebra::Vector2::new(row[1], row[2]);
            [row[0], q.x + shift[0], q.y + shift[1]]
        });
        let frames = sequence.frames.iter().map(|frame| {
            let (p, c) = (
                frame.global(&DVector::zeros(3), &DMatrix::identity(3, 3)).0,
                frame.global(&DVector::from_vec(vec![0.0, 1.0, 0.0]), &DMatrix::identity(3, 3)).0,
            );
            moved(((c[2] - p[2]).atan2(c[1] - p[1]), [p[1], p[2]]))
        });
        FramedSequence { frames: frames.collect(), values: values.collect() }
    });
    let elsewhere = fit(&whole.collect::<Vec<_>>(), &TpGmmSettings::default(), 0).unwrap();
    assert!((elsewhere.history.last().unwrap() - fitted.history.last().unwrap()).abs() < 1e-6 * fitted.history[0].abs());
}

#[test]
fn a_planted_motion_is_recovered_for_new_frames() {
    let blind = |sequence: &FramedSequence| FramedSequence { frames: vec![Frame::at(&[0.0, 0.0]).unwrap()], ..sequence.clone() };
    let mut total = [0.0; 2];
    for seed in 0..10 {
        let sequences = planted(seed, 12);
        let fitted = fit(&sequences, &TpGmmSettings::default(), seed).unwrap();
        let frameless = fit(&sequences.iter().map(blind).collect::<Vec<_>>(), &TpGmmSettings::default(), seed).unwrap();
        let mut random = stream(seed, "new frames", 0);
        for _ in 0..5 {
            let frames = random_frames(&mut random, 0.8);
            let near = errors(&fitted, &frames, &frames);
            let far = errors(&frameless, &[Frame::at(&[0.0, 0.0]).unwrap()], &frames);
            // What the frames pin down is as exact as the sensor (2 mm); in between, frames that turn must blend.
            assert!(near[1] < 5e-3 && near[2] < 5e-3, "seed {seed}: ends off by {near:?} m");
            assert!(near[0] < far[0], "seed {seed}: {near:?} with frames, {far:?} without");
            total = [total[0] + near[0], total[1] + far[0]];
        }
    }
    assert!(total[0] < 0.4 * total[1], "{total:?}");
}

#[test]
fn frames_and_sequences_that_do_not_fit_are_refused() {
    let flat = Frame::new(DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 4.0]), DVector::zeros(2));
    assert!(flat.unwrap_err().to_string().contains("do not span 2 directions"));
    assert!(Frame::new(DMatrix::identity(3, 3), DVector::zeros(2)).is_err() && Frame::at(&[]).is_err() && Frame::at(&[f64::NAN]).is_err());
    let (sequences, settings) = (planted(0, 3), TpGmmSettings::default());
    assert!(fit(&[], &settings, 0).is_err());
    let mut fewer = sequences.clone();
    fewer[1].frames.pop();
    assert!(fit(&fewer, &settings, 0).unwrap_err().to_string().contains("sequence 1"));
    let mut broken = sequences.clone();
    broken[2].values[4] = f64::NAN;
    assert!(fit(&broken, &settings, 0).unwrap_err().to_string().contains("sequence 2"));
    assert!(
        fit(&sequences, &TpGmmSettings { components: 0, ..settings.clone() }, 0).unwrap_err().to_string().contains("tpgmm.components is 0")
    );
    let fitted = fit(&sequences, &settings, 0).unwrap();
    assert!(fitted.model.reproduce(&sequences[0].frames[..1], &[0.5]).is_err());
    assert_eq!(fitted.model.reproduce(&sequences[0].frames, &[]).unwrap().shape(), (0, 2));
}
