//! Contract: where obstacles differ in width, figures say which width everything in them is about.

use std::sync::LazyLock;

use cpdmp::figure::{Mark, Shape, planar_forcing, planar_paths};
use cpdmp::planar::{Guidance, Method, PlanarOutcome, TwoSidedObstacleSettings, obstacles, two_sided_obstacle};

/// The experiment with small models.
static OUTCOME: LazyLock<PlanarOutcome> = LazyLock::new(|| {
    let mut settings = TwoSidedObstacleSettings::default();
    (settings.learning.motion.states, settings.learning.motion.max_iterations) = (4, 20);
    settings.tpgmm.components = 4;
    two_sided_obstacle(&settings, 0, &|| true).expect("it can be learned")
});

fn points(mark: &Mark) -> &[[f64; 2]] {
    match &mark.shape {
        Shape::Line { points, .. } => points,
        _ => &[],
    }
}

#[test]
fn a_path_has_the_colour_of_the_obstacle_that_it_passes() {
    let figure = planar_paths("", &OUTCOME, Guidance::WithSide);
    let obstacles = obstacles(OUTCOME.cases_with(Guidance::WithSide));
    assert!(obstacles.len() > 2 && obstacles.is_sorted_by_key(|one| one.ellipse.half_axes_m[0].to_bits()));
    for (panel, method) in figure.panels.iter().zip(OUTCOME.methods_with(Guidance::WithSide)) {
        for case in OUTCOME.cases_with(Guidance::WithSide) {
            let passed = obstacles.iter().find(|one| one.ellipse == case.obstacle).expect("known");
            for movement in case.of(method) {
                let drawn: Vec<&Mark> = panel.marks.iter().filter(|mark| points(mark) == movement.path_m).collect();
                assert!(!drawn.is_empty());
                assert!(drawn.iter().all(|mark| Some(mark.color) == passed.color() && mark.legend == passed.name()));
            }
        }
    }
}

#[test]
fn every_width_has_panels_of_its_own_with_its_forcing_terms_alone() {
    let figure = planar_forcing("", &OUTCOME, Guidance::WithSide, Method::Cpdmp);
    let obstacles = obstacles(OUTCOME.cases_with(Guidance::WithSide));
    assert_eq!(figure.panels.len(), 2 * obstacles.len());
    for (index, panel) in figure.panels.iter().enumerate() {
        let (obstacle, axis) = (obstacles[index / 2], index % 2);
        assert_eq!(panel.title, obstacle.name());
        let of_width = OUTCOME.forcing_with(Guidance::WithSide).filter(|curve| curve.method.is_none_or(|method| method == Method::Cpdmp));
        let expected = of_width.filter(|curve| curve.half_width_m() == Some(obstacle.ellipse.half_axes_m[0]));
        let mut expected: Vec<Vec<[f64; 2]>> =
            expected.map(|curve| curve.phase.iter().zip(&curve.forcing_m).map(|(u, f)| [*u, f[axis]]).collect()).collect();
        let mut drawn: Vec<Vec<[f64; 2]>> = panel.marks.iter().map(|mark| points(mark).to_vec()).filter(|line| !line.is_empty()).collect();
        let order = |a: &Vec<[f64; 2]>, b: &Vec<[f64; 2]>| a.partial_cmp(b).expect("finite");
        expected.sort_by(order);
        drawn.sort_by(order);
        assert_eq!(drawn, expected, "{}", panel.title);
    }
}

/// Contract: the legend tells what the ellipses in the plane are, also where several obstacles have a colour each.
#[test]
fn the_obstacle_is_in_the_legend() {
    for panel in planar_paths("", &OUTCOME, Guidance::WithSide).panels {
        assert_eq!(panel.marks.iter().filter(|mark| mark.legend.contains("obstacle")).count(), 1, "{}", panel.title);
    }
}

/// Contract: of paths of one kind that lie on each other every one is seen: what lies on top is thinner.
#[test]
fn paths_that_lie_on_each_other_are_all_seen() {
    for panel in planar_paths("", &OUTCOME, Guidance::WithoutSide).panels {
        for kinds in [&[", taught"][..], &[", new", ", beyond", ", not taught"]] {
            let of_kind = |mark: &Mark| kinds.iter().any(|kind| mark.legend.ends_with(kind));
            let widths = panel.marks.iter().filter_map(|mark| match &mark.shape {
                Shape::Line { width_pt, points, .. } if of_kind(mark) && !points.is_empty() => Some((mark.color, *width_pt)),
                _ => None,
            });
            let widths: Vec<_> = widths.collect();
            assert!(widths.windows(2).all(|pair| pair[1].1 < pair[0].1 || pair[1] == pair[0]), "{}: {widths:?}", panel.title);
            assert!(widths.first().map(|one| one.0) != widths.last().map(|one| one.0), "several colours");
        }
    }
}

/// Contract: the model's line is told from its states: it is far wider than their borders, and where a method has one colour they have another;
/// the legend names both.
#[test]
fn the_model_is_told_from_its_states() {
    for (guidance, method) in [(Guidance::WithSide, Method::Cpdmp), (Guidance::WithoutSide, Method::CpdmpChain)] {
        for panel in planar_forcing("", &OUTCOME, guidance, method).panels {
            let of = |states: bool| panel.marks.iter().filter(move |mark| matches!(mark.shape, Shape::Area { .. }) == states);
            let lines: Vec<&Mark> = of(false).filter(|mark| mark.legend != "demonstrated").collect();
            assert!(!lines.is_empty() && of(true).count() > 0);
            for mark in &lines {
                assert!(matches!(mark.shape, Shape::Line { width_pt, .. } if width_pt > 1.5), "{}", mark.legend);
                assert!(method == Method::CpdmpChain || (mark.color == method.color() && of(true).all(|state| state.color != mark.color)));
            }
            for state in of(true) {
                assert!(matches!(state.shape, Shape::Area { border_pt, .. } if border_pt < 0.5) && state.legend.starts_with("states of "));
            }
        }
    }
}
