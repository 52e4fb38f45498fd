//! How far expected wrenches are from those of demonstrations that were learned from, and of those that were left out.

use cpdmp::demonstration::{Dataset, Demonstration, ParameterSource, Trajectory};
use cpdmp::learning::selection::{cross_validate, reproduction, wrench_error};
use cpdmp::learning::{LearningSettings, learn};
use nalgebra::DMatrix;

/// A push of `theta_f` newtons at its strongest along a stroke of `theta_m` metres, felt as `fx_n`, and half of it as `fy_n`.
fn push(theta_m: f64, theta_f: f64, index: usize) -> Demonstration {
    let samples = 81 + 10 * (index % 2);
    let u = |t: usize| t as f64 / (samples - 1) as f64;
    let values = DMatrix::from_fn(samples, 3, |t, j| {
        let force = theta_f * (std::f64::consts::PI * u(t)).sin().powi(2);
        let s = u(t).powi(3) * (10.0 - 15.0 * u(t) + 6.0 * u(t).powi(2));
        [theta_m * s, force, 0.5 * force][j]
    });
    let columns = ["x_m", "fx_n", "fy_n"].map(str::to_owned).to_vec();
    Demonstration {
        name: format!("push_{index}"),
        trajectory: Trajectory::new((0..samples).map(|t| 2.0 * u(t)).collect(), columns, values).unwrap(),
        theta_m: vec![("length_m".to_owned(), theta_m)],
        theta_f: vec![("strength_n".to_owned(), theta_f)],
    }
}

fn pushes(thetas: &[(f64, f64)]) -> Dataset {
    Dataset {
        motion: vec!["x_m".to_owned()],
        wrench: ["fx_n", "fy_n"].map(str::to_owned).to_vec(),
        parameter_source: ParameterSource::Given,
        demonstrations: thetas.iter().enumerate().map(|(k, (m, f))| push(*m, *f, k)).collect(),
    }
}

fn small() -> LearningSettings {
    let mut settings = LearningSettings { rate_hz: 25.0, ..Default::default() };
    for model in [&mut settings.motion, &mut settings.force] {
        (model.states, model.kmeans_starts, model.ridge) = (6, 0, 1e-3);
    }
    settings
}

/// Contract: a wrench that is off by 3 N in one column is told as 3 N, as far as the model repeats what it learned.
#[test]
fn a_wrench_that_is_off_by_three_newtons_is_told_so() {
    let data = pushes(&[(0.3, 4.0), (0.4, 6.0), (0.5, 9.0)]);
    let skill = learn(&data, &small(), 1).unwrap().skill;
    let mut off = data.clone();
    for demonstration in &mut off.demonstrations {
        let shown = &demonstration.trajectory;
        let mut values = shown.values().clone();
        values.column_mut(1).add_scalar_mut(3.0);
        demonstration.trajectory = Trajectory::new(shown.times_s().to_vec(), shown.columns().to_vec(), values).unwrap();
    }
    for (repeated, off) in reproduction(&data, &skill).unwrap().iter().zip(reproduction(&off, &skill).unwrap()) {
        let (own, moved) = (&repeated.wrench, &off.wrench);
        assert_eq!((own.len(), moved.len()), (2, 2));
        assert!(own[0].rms > 0.0 && own[0].rms < 0.5 && own[0].max < 1.0, "{own:?}");
        assert!((own[0].rms - 2.0 * own[1].rms).abs() < 0.05, "fy is half of fx: {own:?}");
        let within = |moved: f64, own: f64| (moved - 3.0).abs() < own + 1e-9;
        assert!(within(moved[0].rms, own[0].rms) && within(moved[0].max, own[0].max), "{own:?} {moved:?}");
        assert_eq!(moved[1], own[1], "the other column is as it was");
    }
    let without = Dataset { wrench: Vec::new(), ..data };
    let skill = learn(&without, &small(), 1).unwrap().skill;
    assert!(reproduction(&without, &skill).unwrap().iter().all(|one| one.wrench.is_empty()), "no force model, no error");
}

/// Contract: demonstrations that differ in `theta_f` alone are left out by it, so that generalisation of the wrench can be judged.
#[test]
fn with_one_theta_m_for_all_unseen_forces_are_predicted() {
    let data = pushes(&[(0.4, 4.0), (0.4, 6.0), (0.4, 8.0), (0.4, 4.0), (0.4, 6.0), (0.4, 8.0)]);
    let cv = cross_validate(&data, &small(), 2).unwrap();
    assert_eq!((cv.folds, cv.force_folds), (3, 3));
    let forces: Vec<_> = cv.held_out.iter().map(|held| held.force.as_ref().expect("a force model")).collect();
    assert_eq!(forces.iter().map(|force| force.fold).collect::<Vec<_>>(), [0, 1, 2, 0, 1, 2]);
    assert_eq!(cv.held_out.iter().map(|held| held.fold).collect::<Vec<_>>(), [0, 1, 2, 0, 1, 2]);
    assert_eq!(forces.iter().map(|force| force.extrapolation).collect::<Vec<_>>(), [1.0, 0.0, 1.0, 1.0, 0.0, 1.0]);
    let [fx, fy] = cv.wrench()[..] else { panic!("two columns") };
    // A model that is blind to theta_f is 3 N off for the weakest and the strongest push: 1.2 N over the profiles of all.
    assert!(fx.rms < 0.5 && fy.rms < 0.25, "{fx:?} {fy:?}");
}

/// Contract: where both parameters vary, the wrench is predicted without its `theta_f` and the movement without its `theta_m`.
#[test]
fn wrenches_are_predicted_by_a_skill_that_has_not_seen_their_theta_f() {
    let data = pushes(&[(0.3, 4.0), (0.3, 6.0), (0.3, 9.0), (0.5, 4.0), (0.5, 6.0), (0.5, 9.0)]);
    let cv = cross_validate(&data, &small(), 3).unwrap();
    assert_eq!((cv.folds, cv.force_folds), (2, 3));
    for (k, held) in cv.held_out.iter().enumerate() {
        let force = held.force.as_ref().expect("a force model");
        assert_eq!((held.fold, force.fold), (k / 3, k % 3));
        let mut rest = data.clone();
        rest.demonstrations.retain(|one| one.theta_f != data.demonstrations[k].theta_f);
        let skill = learn(&rest, &small(), 3).unwrap().skill;
        assert_eq!(force.wrench, wrench_error(&skill, &data.demonstrations[k]).unwrap());
    }
}
