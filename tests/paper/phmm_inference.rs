//! Parameters are recovered from the first part of a movement, and the reported uncertainty is what it claims to be.

use cpdmp::demonstration::Trajectory;
use cpdmp::demonstration::synthetic::PickAndPlace;
use cpdmp::learning::{Features, InferenceSettings, InferenceStatus, LearningSettings, ShapingKind, Skill, infer, learn};
use cpdmp::math::{stream, uniform};

fn taught(features: Features, heights: &[f64], seed: u64) -> Skill {
    let mut settings = LearningSettings::default();
    (settings.motion.features, settings.motion.kmeans_starts) = (features, 0);
    let task = PickAndPlace { block_heights_m: heights.to_vec(), ..PickAndPlace::default() };
    learn(&task.dataset(seed), &settings, seed).unwrap().skill
}

/// The first part of a movement that was not shown.
fn first_part(height: f64, toy: f64, fraction: f64, seed: u64) -> Trajectory {
    let task = PickAndPlace { block_heights_m: vec![height], toy_offsets_m: vec![toy], ..PickAndPlace::default() };
    let whole = task.dataset(1000 + seed).demonstrations.remove(0).trajectory;
    let n = ((whole.samples() - 1) as f64 * fraction) as usize + 1;
    Trajectory::new(whole.times_s()[..n].to_vec(), whole.columns().to_vec(), whole.values().rows(0, n).into_owned()).unwrap()
}

#[test]
fn the_block_height_shows_in_the_first_thirty_percent() {
    let (mut squares, mut scores, mut count) = (0.0, 0.0, 0.0);
    for seed in 0..3 {
        let skill = taught(Features::Linear, &[0.17, 0.20, 0.26], seed);
        for k in 0..12 {
            let height = 0.17 + 0.09 * f64::from(k) / 11.0;
            let part = first_part(height, 0.06 * (f64::from(k) * 1.7).sin(), 0.3, 100 * seed + k as u64);
            let found = infer(&skill, &part, &InferenceSettings::default()).unwrap();
            assert_eq!(found.status, InferenceStatus::Converged);
            let (error, sd) = (found.theta[0].1 - height, found.covariance[(0, 0)].sqrt());
            assert!(error.abs() < 0.01, "height {height} m: {} m", found.theta[0].1);
            squares += error * error;
            scores += (error / sd).powi(2);
            count += 1.0;
        }
    }
    let (rms, score) = ((squares / count).sqrt(), (scores / count).sqrt());
    assert!(rms < 0.0035, "rms error {rms} m");
    assert!((0.6..1.6).contains(&score), "errors are {score} times the reported standard deviation");
}

/// Contract: the reported standard deviation is that of the errors. Skills, teachers and movements of seeds that nothing was tuned on.
#[test]
fn ninety_five_percent_intervals_hold_the_truth_as_often_as_they_say_and_are_not_vacuous() {
    let (mut inside, mut count, mut scores, mut widest) = (0u32, 0u32, 0.0, 0.0f64);
    for seed in 50..56 {
        let skill = taught(Features::Linear, &[0.17, 0.20, 0.26], seed);
        let mut random = stream(seed, "heights", 0);
        for k in 0..20 {
            let (height, toy) = (uniform(&mut random, 0.17, 0.26), uniform(&mut random, -0.06, 0.06));
            let found = infer(&skill, &first_part(height, toy, 0.3, 10_000 + 100 * seed + k), &InferenceSettings::default()).unwrap();
            let (error, sd) = (found.theta[0].1 - height, found.covariance[(0, 0)].sqrt());
            inside += u32::from(error.abs() < 1.96 * sd);
            scores += (error / sd).powi(2);
            widest = widest.max(sd);
            count += 1;
        }
    }
    let (share, score) = (f64::from(inside) / f64::from(count), (scores / f64::from(count)).sqrt());
    println!("{inside} of {count} inside ({share:.3}), rms z-score {score:.2}, widest sd {:.2} mm", widest * 1e3);
    // Three standard deviations of a binomial count of 120 at 0.95.
    let slack = 3.0 * (0.95 * 0.05 / f64::from(count)).sqrt();
    assert!((0.95 - slack..=1.0).contains(&share), "{inside} of {count} inside");
    assert!((0.5..1.4).contains(&score), "errors are {score} times the reported standard deviation");
    // The prior alone, uniform over the 9 cm that were shown, has 26 mm.
    assert!(widest < 0.25 * 0.09 / 12f64.sqrt(), "a standard deviation of {widest} m says nothing");
}

#[test]
fn bent_features_find_the_height_too() {
    for features in [Features::Quadratic, Features::Rbf { centres: 5, width: 1.5 }] {
        let skill = taught(features, &[0.17, 0.19, 0.21, 0.23, 0.26], 1);
        for (k, height) in [0.18, 0.22, 0.25].into_iter().enumerate() {
            let found = infer(&skill, &first_part(height, 0.0, 0.3, k as u64), &InferenceSettings::default()).unwrap();
            let error = found.theta[0].1 - height;
            assert!(error.abs() < 0.01, "{features:?}: {} m for {height} m", found.theta[0].1);
        }
    }
}

#[test]
fn the_first_instants_say_nothing_and_the_prior_answers() {
    let skill = taught(Features::Linear, &[0.17, 0.20, 0.26], 0);
    let found = infer(&skill, &first_part(0.26, 0.0, 0.03, 0), &InferenceSettings::default()).unwrap();
    let sd = found.covariance[(0, 0)].sqrt();
    assert!(sd > 0.01 && (found.theta[0].1 - 0.26).abs() < 3.0 * sd, "{:?} with a standard deviation of {sd} m", found.theta);
}

#[test]
fn skills_without_parameters_and_unusable_parts_are_answered_in_words() {
    let skill = taught(Features::Linear, &[0.20], 0);
    let found = infer(&skill, &first_part(0.20, 0.0, 0.3, 0), &InferenceSettings::default()).unwrap();
    assert_eq!((found.status, found.theta[0].1, found.covariance[(0, 0)]), (InferenceStatus::NothingToInfer, 0.20, 0.0));
    let message = |part: &Trajectory, settings: &InferenceSettings| infer(&skill, part, settings).unwrap_err().to_string();
    let short = first_part(0.20, 0.0, 0.005, 0);
    assert!(message(&short, &InferenceSettings::default()).contains("needs at least"), "too short");
    let settings = InferenceSettings { duration_s: Some(2.0), ..InferenceSettings::default() };
    assert!(message(&first_part(0.20, 0.0, 0.3, 0), &settings).contains("the movement lasts 2.000 s"), "too long");
    let settings = InferenceSettings { rate_hz: f64::NAN, ..InferenceSettings::default() };
    assert!(message(&first_part(0.20, 0.0, 0.3, 0), &settings).contains("rate_hz"), "a setting that is no number");
    let blind = LearningSettings { shaping: ShapingKind::Lwr, ..LearningSettings::default() };
    let blind = learn(&PickAndPlace::default().dataset(0), &blind, 0).unwrap().skill;
    assert!(infer(&blind, &first_part(0.20, 0.0, 0.3, 0), &InferenceSettings::default()).unwrap_err().to_string().contains("blind"));
}
