//! Sensor noise in the forcing term: as much as is predicted, and never taken for a disagreement between demonstrations.

use cpdmp::demonstration::{Dataset, Demonstration, ParameterSource, Trajectory};
use cpdmp::learning::cpdmp::{ComplianceSettings, Statistic, Threshold};
use cpdmp::learning::{LearningSettings, learn, motion_sequences};
use cpdmp::math::{SmoothingDerivative, minimum_jerk, standard_normal, stream};
use nalgebra::DMatrix;

/// `count` demonstrations of one movement of 30 s at 100 Hz: two strokes, one after the other, under white noise of this size (m).
fn repeated(count: usize, noise_m: f64, seed: u64) -> Dataset {
    let columns = ["x_m", "y_m"].map(str::to_owned).to_vec();
    let one = |k: usize| {
        let mut random = stream(seed, "sensor", k as u64);
        let values = DMatrix::from_fn(3001, 2, |t, j| {
            let u = t as f64 / 3000.0;
            let stroke = |from: f64, to: f64| minimum_jerk((u - from) / (to - from)).position;
            let place = if j == 0 { 0.4 * stroke(0.05, 0.6) } else { 0.2 * stroke(0.3, 0.6) - 0.3 * stroke(0.6, 0.95) };
            place + noise_m * standard_normal(&mut random)
        });
        let trajectory = Trajectory::new((0..3001).map(|t| f64::from(t) * 0.01).collect(), columns.clone(), values).unwrap();
        Demonstration { name: format!("repetition_{k}"), trajectory, theta_m: Vec::new(), theta_f: Vec::new() }
    };
    let demonstrations = (0..count).map(one).collect();
    Dataset { motion: columns.clone(), wrench: Vec::new(), parameter_source: ParameterSource::Given, demonstrations }
}

/// The variance of `f` over many noisy repetitions of one movement, moment by moment, against the gain of the filter: 0.1 mm at K = 5000,
/// 30 s, 100 Hz. Differences from sample to sample would make it 0.2 m^2.
#[test]
fn the_variance_of_the_forcing_term_is_the_noise_times_the_gain_that_is_predicted() {
    let (noise, count) = (1e-4, 60);
    let settings = LearningSettings { rate_hz: 100.0, ..LearningSettings::default() };
    let data = repeated(count, noise, 5);
    let clean = &motion_sequences(&repeated(1, 0.0, 0), &settings).unwrap()[0];
    let noisy = motion_sequences(&data, &settings).unwrap();
    let omega = 5000f64.sqrt() / 30.0;
    let filter = SmoothingDerivative::new(0.01, 51, 4).unwrap();
    let predicted = noise * noise * filter.noise_gain_of([1.0, 2.0 / omega, 1.0 / (omega * omega)]);
    // Away from the ends, where the window is a whole one.
    let off = |t: usize, j: usize| noisy.iter().map(move |s| s.sample(t)[j] - clean.sample(t)[j]);
    for j in 1..=2 {
        let variance = (30..2971).map(|t| off(t, j).map(|e| e * e).sum::<f64>()).sum::<f64>() / (2941 * count) as f64;
        println!("column {j}: variance {variance:.3e} m^2, predicted {predicted:.3e} m^2");
        assert!((variance / predicted - 1.0).abs() < 0.05, "column {j}: {variance} m^2, predicted {predicted} m^2");
    }
    // What learning reports knows the noise from the data alone.
    let mut quick = LearningSettings { rate_hz: 5.0, ..LearningSettings::default() };
    (quick.motion.states, quick.motion.kmeans_starts, quick.motion.max_iterations) = (4, 0, 5);
    for reported in learn(&data, &quick, 0).unwrap().report.forcing_noise {
        assert!((reported / predicted - 1.0).abs() < 0.05, "reported {reported} m^2, predicted {predicted} m^2");
    }
}

/// Contract: demonstrations that differ by sensor noise alone leave no room, whatever the noise: nothing complies.
#[test]
fn noise_alone_never_switches_a_state_to_compliance() {
    for (noise, seed) in [1e-4, 3e-4, 1e-3].into_iter().flat_map(|noise| (0..5).map(move |seed| (noise, seed))) {
        let compliance = ComplianceSettings { statistic: Statistic::BetweenDemonstration, threshold: Threshold::Automatic };
        let mut settings = LearningSettings { compliance, ..LearningSettings::default() };
        settings.motion.kmeans_starts = 0;
        let compliance = learn(&repeated(6, noise, seed), &settings, seed).unwrap().skill.compliance;
        assert!(compliance.beta.iter().all(|beta| *beta == 0.0), "noise {noise} m, seed {seed}: {compliance:?}");
    }
}
