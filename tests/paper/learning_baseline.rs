//! The baseline with the ends of the movement told to it: it starts and ends where it should, and goes there in its own way.

use cpdmp::demonstration::{Dataset, Demonstration, ParameterSource, Trajectory};
use cpdmp::learning::{EndRule, ExecutionSettings, LearningSettings, ShapingKind, generate, learn};
use cpdmp::math::minimum_jerk;
use nalgebra::DMatrix;

fn columns() -> Vec<String> {
    ["x_m", "y_m"].map(str::to_owned).to_vec()
}

/// Arcs of 60 degrees about one hinge, with the radius as parameter: the ends are linear in it, the way between them bends with it.
fn arcs(radii_m: &[f64]) -> Dataset {
    let arc = |radius: &f64| {
        let angle = |t: usize| minimum_jerk(t as f64 / 400.0).position * std::f64::consts::FRAC_PI_3;
        let values = DMatrix::from_fn(401, 2, |t, j| radius * if j == 0 { -angle(t).sin() } else { -angle(t).cos() });
        let trajectory = Trajectory::new((0..401).map(|t| t as f64 * 0.01).collect(), columns(), values).unwrap();
        Demonstration { name: format!("radius_{radius}"), trajectory, theta_m: vec![("radius_m".into(), *radius)], theta_f: Vec::new() }
    };
    Dataset {
        motion: columns(),
        wrench: Vec::new(),
        parameter_source: ParameterSource::Given,
        demonstrations: radii_m.iter().map(arc).collect(),
    }
}

#[test]
fn a_baseline_that_is_told_its_ends_still_bends_as_the_mean_of_the_lessons() {
    let dataset = arcs(&[0.20, 0.25, 0.35, 0.40]);
    let told = LearningSettings { shaping: ShapingKind::Lwr, lwr_ends: EndRule::Regression, ..Default::default() };
    let blind = LearningSettings { shaping: ShapingKind::Lwr, ..Default::default() };
    let radius_m = 0.45;
    let request = ExecutionSettings { theta_m: vec![("radius_m".to_owned(), radius_m)], ..Default::default() };
    let error_m = |settings: &LearningSettings| {
        let path = generate(&learn(&dataset, settings, 0).unwrap().skill, &request, 0.01, 1.0).unwrap();
        let off: Vec<f64> = path.values().row_iter().map(|p| (p[0].hypot(p[1]) - radius_m).abs()).collect();
        [off[0], off[off.len() - 1], off.iter().copied().fold(0.0, f64::max)]
    };
    let [own, told, blind] = [&LearningSettings::default(), &told, &blind].map(error_m);
    assert!(own[2] < 0.005 && told[0] < 1e-6 && told[1] < 0.002, "ends: own {own:?}, told {told:?}");
    assert!(told[2] > 3.0 * own[2], "way: own {own:?}, told {told:?}");
    assert!((blind[0] - 0.15).abs() < 1e-6, "the mean of the lessons starts 15 cm beside: {blind:?}");
}
