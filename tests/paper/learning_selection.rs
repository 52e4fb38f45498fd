//! What left-out demonstrations decide: errors on movements that were not seen, the ridge, the number of states, parameters that are the
//! start of the movement.

use cpdmp::demonstration::synthetic::PickAndPlace;
use cpdmp::demonstration::{Dataset, Demonstration, ParameterSource, Trajectory};
use cpdmp::learning::phmm::{PhmmSettings, Sequence, Topology, fit};
use cpdmp::learning::selection::{Choices, Selection, StatesCriterion, StatesSearch, cross_validate, free_parameters, reproduction};
use cpdmp::learning::{ExecutionSettings, FeatureMap, Features, LearningError, LearningSettings, generate, learn, learn_while};
use cpdmp::math::{standard_normal, stream};
use nalgebra::{DMatrix, DVector};
use std::sync::atomic::{AtomicUsize, Ordering};

/// A person's strokes from different places to one goal: an arc, with their own timing, bow and tremor.
fn strokes(count: usize, seed: u64) -> Dataset {
    let stroke = |k: usize| {
        let mut hand = stream(seed, "hand", k as u64);
        let mut draw = || standard_normal(&mut hand);
        let (x0, y0, bow, skew) = (-0.3 + 0.06 * draw(), 0.2 + 0.06 * draw(), 0.08 + 0.01 * draw(), 0.15 * draw());
        let samples = 120 + (20.0 * draw()).abs() as usize;
        let values = DMatrix::from_fn(samples, 2, |t, j| {
            let linear = t as f64 / (samples - 1) as f64;
            let r = linear + skew * linear * (1.0 - linear);
            let u = r * r * r * (10.0 - 15.0 * r + 6.0 * r * r);
            let arc = bow * (std::f64::consts::PI * u).sin();
            if j == 0 { x0 * (1.0 - u) + arc } else { y0 * (1.0 - u) + arc }
        });
        let tremor: Vec<f64> = (0..2 * samples).map(|_| 2e-4 * draw()).collect();
        let values = values + DMatrix::from_vec(samples, 2, tremor);
        let trajectory =
            Trajectory::new((0..samples).map(|t| t as f64 * 0.01).collect(), ["x_m", "y_m"].map(str::to_owned).to_vec(), values);
        Demonstration { name: format!("stroke_{k}"), trajectory: trajectory.unwrap(), theta_m: Vec::new(), theta_f: Vec::new() }
    };
    Dataset {
        motion: ["x_m", "y_m"].map(str::to_owned).to_vec(),
        wrench: Vec::new(),
        parameter_source: ParameterSource::Given,
        demonstrations: (0..count).map(stroke).collect(),
    }
}

fn small() -> LearningSettings {
    let mut settings = LearningSettings { rate_hz: 50.0, smoothing_window_s: 0.2, ..Default::default() };
    (settings.motion.states, settings.motion.kmeans_starts) = (6, 0);
    settings
}

#[test]
fn with_the_start_as_parameter_a_start_alone_is_asked_for_and_kept() {
    for source in [ParameterSource::Start, ParameterSource::StartRelativeToGoal] {
        let data = strokes(7, 1).with_parameter_source(source);
        let learned = learn(&data, &small(), 1).unwrap();
        assert!(learned.report.ends.is_some());
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("skill.json");
        learned.skill.write(&path).unwrap();
        let skill = cpdmp::learning::Skill::read(&path).unwrap();
        assert_eq!(skill.parameter_source, source);
        let asked = ExecutionSettings { start: Some(vec![-0.25, 0.15]), ..Default::default() };
        let request = skill.request(&asked).unwrap();
        let moved = generate(&skill, &asked, 0.01, 1.0).unwrap();
        assert_eq!(moved.values().row(0).iter().copied().collect::<Vec<_>>(), [-0.25, 0.15]);
        let end = moved.values().row(moved.samples() - 1).transpose() - &request.goal;
        assert!(end.norm() < 2e-3 && request.goal.norm() < 0.01, "ends {end}, goal {}", request.goal);
        let (x0, _) = skill.ends_at(&request.theta);
        assert!((x0 - &request.start).norm() < 1e-12, "the start belongs to its own parameters");
        assert!(skill.request(&ExecutionSettings::default()).unwrap_err().to_string().contains("give a start"));
    }
}

#[test]
fn every_demonstration_is_predicted_once_and_worse_than_it_is_repeated() {
    let data = strokes(6, 2).with_parameter_source(ParameterSource::Start);
    let cv = cross_validate(&data, &small(), 3).unwrap();
    let names: Vec<&str> = cv.held_out.iter().map(|h| h.demonstration.as_str()).collect();
    assert_eq!(names, data.demonstrations.iter().map(|d| d.name.as_str()).collect::<Vec<_>>());
    assert_eq!((cv.folds, cv.training.len()), (6, 6));
    let (out, seen) = (cv.with_ends().unwrap(), cv.training().unwrap());
    assert!(seen.path.rms < out.path.rms && out.path.rms < 0.03, "repeated {:?}, predicted {:?}", seen.path, out.path);
    assert_eq!(cv, cross_validate(&data, &small(), 3).unwrap(), "the same bits again");
    let one = Dataset { demonstrations: data.demonstrations[..1].to_vec(), ..data };
    assert!(cross_validate(&one, &small(), 3).unwrap_err().to_string().contains("at least two"));
}

#[test]
fn ridge_and_states_are_chosen_with_their_curves() {
    let data = strokes(6, 4).with_parameter_source(ParameterSource::Start);
    for criterion in [StatesCriterion::Bic, StatesCriterion::CrossValidation] {
        let search = StatesSearch { criterion, min: 2, max: 7 };
        let settings = LearningSettings { motion_selection: Selection { states: Some(search), ridge: true }, ..small() };
        let learned = learn(&data, &settings, 5).unwrap();
        let (states, ridge) = (learned.report.motion_choices.states.unwrap(), learned.report.motion_choices.ridge.unwrap());
        assert_eq!((states.curve.len(), learned.skill.motion.states()), (6, states.states));
        assert!(states.curve.iter().all(|c| c.score >= states.curve.iter().find(|b| b.states == states.states).unwrap().score));
        assert!(ridge.curve.iter().all(|c| c.error >= ridge.curve.iter().find(|b| b.ridge == ridge.ridge).unwrap().error));
        assert!(!reproduction(&data, &learned.skill).unwrap().is_empty());
    }
}

/// Short movements of two columns under these parameters, one row each.
/// Contract: learning that may not go on ends within an iteration of every model that is at work, whatever it is doing: fitting, or choosing states
/// and ridge. One that may gives the bits of one that is never asked.
#[test]
fn learning_stops_when_it_may_not_go_on() {
    let dataset = strokes(6, 1);
    let search = StatesSearch { criterion: StatesCriterion::CrossValidation, min: 3, max: 5 };
    let chosen = LearningSettings { motion_selection: Selection { states: Some(search), ridge: true }, ..small() };
    for settings in [small(), chosen] {
        let asked = AtomicUsize::new(0);
        let patient = learn_while(&dataset, &settings, 3, &|| asked.fetch_add(1, Ordering::SeqCst) < usize::MAX).expect("learned");
        assert_eq!(patient.skill.to_json().expect("text"), learn(&dataset, &settings, 3).expect("learned").skill.to_json().expect("text"));
        let questions = asked.load(Ordering::SeqCst);
        assert!(questions > 20, "asked {questions} times");
        for patience in [0, 1, questions / 3, questions - 1] {
            let asked = AtomicUsize::new(0);
            let stopped = learn_while(&dataset, &settings, 3, &|| asked.fetch_add(1, Ordering::SeqCst) < patience);
            assert!(matches!(stopped, Err(LearningError::Stopped { .. })), "after {patience} of {questions} questions");
            let after = asked.load(Ordering::SeqCst) - patience;
            // Each of the models that are at work asks once per climb, of which there are five at most.
            assert!(after <= 40, "{after} questions after the answer was no, of {questions}");
        }
    }
}

fn sequences(thetas: &[&[f64]]) -> Vec<Sequence> {
    let values = |theta: &[f64]| (0..20).flat_map(|t| [f64::from(t) / 19.0, theta[0] * f64::from(t), (0.3 * f64::from(t)).sin()]).collect();
    thetas.iter().map(|theta| Sequence { values: values(theta), dimension: 3, theta: DVector::from_row_slice(theta) }).collect()
}

#[test]
fn free_parameters_are_those_that_the_demonstrations_decide() {
    let three: [&[f64]; 4] = [&[0.1], &[0.2], &[0.2], &[0.4]];
    let two: [&[f64]; 3] = [&[0.1], &[0.1], &[0.4]];
    let plane: [&[f64]; 6] = [&[0.0, 0.0], &[1.0, 0.0], &[0.0, 1.0], &[1.0, 1.0], &[2.0, 1.0], &[1.0, 2.0]];
    let line: [&[f64]; 3] = [&[1.0, 2.0], &[2.0, 4.0], &[3.0, 6.0]];
    let same: [&[f64]; 2] = [&[0.3], &[0.3]];
    let rbf = Features::Rbf { centres: 9, width: 1.5 };
    // How many numbers a row of W has: a curve through n values has n - 1 beside its mean, whatever its features.
    let rows: [(&[&[f64]], Features, usize); 10] = [
        (&three, Features::Linear, 1),
        (&three, Features::Quadratic, 2),
        (&three, rbf, 2),
        (&two, Features::Quadratic, 1),
        (&two, rbf, 1),
        (&plane, Features::Linear, 2),
        (&plane, Features::Quadratic, 5),
        (&plane, rbf, 5),
        (&line, Features::Linear, 1),
        (&same, Features::Quadratic, 0),
    ];
    for (thetas, features, decided) in rows {
        let seen = sequences(thetas);
        let map = FeatureMap::of(features, &seen.iter().map(|s| s.theta.clone()).collect::<Vec<_>>(), 0);
        let seen: Vec<Sequence> = seen.into_iter().map(|s| s.seen_through(&map)).collect();
        for (weights_on_phase, rows) in [(false, 2), (true, 3)] {
            for (topology, ways) in [(Topology::LeftToRight, 3), (Topology::Ergodic, 3 + 4 * 3)] {
                let settings = PhmmSettings {
                    states: 4,
                    weights_on_phase,
                    topology,
                    features,
                    kmeans_starts: 0,
                    max_iterations: 1,
                    ..Default::default()
                };
                let model = fit(&seen, &settings, 0).unwrap().model;
                // 4 states of 3 means, 6 covariances and the weights, and the ways on.
                let expected = 4 * (3 + 6 + rows * decided) + ways;
                assert_eq!(free_parameters(&model, &settings, &seen), expected, "{features:?}, {thetas:?}, {topology:?}");
            }
        }
    }
}

#[test]
fn the_force_model_is_chosen_by_its_own_demonstrations() {
    let task = PickAndPlace { rate_hz: 20.0, ..PickAndPlace::default() };
    let search = StatesSearch { criterion: StatesCriterion::CrossValidation, min: 2, max: 4 };
    let mut settings = LearningSettings { rate_hz: 5.0, force_selection: Selection { states: Some(search), ridge: true }, ..small() };
    settings.force.kmeans_starts = 0;
    let learned = learn(&task.dataset(3), &settings, 3).unwrap();
    let (states, ridge) = (learned.report.force_choices.states.unwrap(), learned.report.force_choices.ridge.unwrap());
    assert_eq!(learned.report.motion_choices, Choices::default());
    assert_eq!((learned.skill.force.unwrap().phmm.states(), learned.skill.motion.phmm().unwrap().states()), (states.states, 6));
    assert!(states.curve.iter().all(|c| c.score >= states.curve.iter().find(|b| b.states == states.states).unwrap().score));
    // Nothing is told to the force model of this task, so there is no weight whose prior could be chosen.
    assert!(ridge.curve.is_empty() && ridge.ridge == settings.force.ridge);
}

/// Bows from starts that spread over 20 cm along x, and over half a millimetre along z, by chance.
fn bows() -> Dataset {
    let bow = |k: usize| {
        let mut hand = stream(5, "bow", k as u64);
        let mut draw = || standard_normal(&mut hand);
        let (x0, z0, height) = (0.1 + 0.06 * draw(), 0.1 + 5e-4 * draw(), 0.1 + 0.02 * draw());
        let values = DMatrix::from_fn(151, 2, |t, j| {
            let u = t as f64 / 150.0;
            let s = u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
            if j == 0 { x0 + (0.5 - x0) * s } else { z0 + (0.1 - z0) * s + height * (std::f64::consts::PI * u).sin().powi(2) }
        });
        let times = (0..151).map(|t| 0.02 * f64::from(t)).collect();
        let trajectory = Trajectory::new(times, ["x_m", "z_m"].map(str::to_owned).to_vec(), values).unwrap();
        Demonstration { name: k.to_string(), trajectory, theta_m: Vec::new(), theta_f: Vec::new() }
    };
    let motion = ["x_m", "z_m"].map(str::to_owned).to_vec();
    let demonstrations = (0..6).map(bow).collect();
    let data = Dataset { motion, wrench: Vec::new(), parameter_source: ParameterSource::Given, demonstrations };
    data.with_parameter_source(ParameterSource::Start)
}

/// Contract: a coordinate of the start that varied by chance alone has no say over the movement, however small its spread.
#[test]
fn a_start_that_hardly_varied_along_one_axis_moves_nothing_along_it() {
    for features in [Features::Linear, Features::Quadratic] {
        let settings = LearningSettings { motion: PhmmSettings { features, ..PhmmSettings::default() }, ..LearningSettings::default() };
        let skill = learn(&bows(), &settings, 0).unwrap().skill;
        let highest = |z0: f64| {
            let settings = ExecutionSettings { start: Some(vec![0.1, z0]), ..ExecutionSettings::default() };
            generate(&skill, &settings, 0.02, 1.0).unwrap().values().column(1).max()
        };
        let as_taught = highest(0.1);
        for above in [0.005, 0.01, 0.05] {
            let moved = highest(0.1 + above) - as_taught;
            assert!(moved.abs() < 0.6 * above, "{features:?}: {above} m higher at the start, {moved} m at the top");
        }
    }
}
