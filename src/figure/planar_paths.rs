//! Paths past the obstacle, method by method: the paper's figure of its first simulated experiment.

use std::cmp::Reverse;

use super::chart::{Axis, Chart, Figure};
use super::mark::{Mark, Symbol};
use crate::math::ellipse_outline;
use crate::palette::{BLACK, GREY, Rgb, VERMILION, YELLOW};
use crate::planar::{Case, Guidance, Method, Movement, Obstacle, PlanarOutcome, obstacles, rank};

/// Width and height of a panel (pt).
const PANEL_PT: [f64; 2] = [300.0, 320.0];
/// Panels side by side, at most.
const MOST_COLUMNS: usize = 3;

/// Widths of the path past the narrowest obstacle, and how much wider that past the next wider one is (pt): of taught situations and of new ones.
/// Paths that lie on each other are all seen.
const TAUGHT_PT: [f64; 2] = [0.9, 0.9];
const NEW_PT: [f64; 2] = [2.0, 1.2];

/// One panel per method: demonstrations, obstacle, paths to taught situations (thin) and to new ones (thick), collisions marked. Of several
/// obstacles each has a colour, and so has what passes it.
#[must_use]
pub fn planar_paths(title: &str, outcome: &PlanarOutcome, guidance: Guidance) -> Figure {
    let cases: Vec<&Case> = outcome.cases_with(guidance).collect();
    let panels: Vec<Chart> = outcome.methods_with(guidance).into_iter().map(|method| panel(method, outcome, &cases)).collect();
    let columns = panels.len().clamp(1, MOST_COLUMNS);
    Figure { title: title.to_owned(), panels, columns, panel_size_pt: PANEL_PT }
}

fn panel(method: Method, outcome: &PlanarOutcome, cases: &[&Case]) -> Chart {
    let mut chart = Chart::map(method.title(), [Axis::new("x (m)"), Axis::new("y (m)")]);
    // Panels of one figure show one stretch of the plane, or they could not be compared.
    let all = || cases.iter().flat_map(|case| &case.movements).flat_map(|movement| &movement.path_m);
    for axis in 0..2 {
        let of = |fold: fn(f64, f64) -> f64, start: f64| all().map(|point| point[axis]).fold(start, fold);
        if let Some(axes) = &mut chart.axes {
            axes[axis].includes = vec![of(f64::min, f64::INFINITY), of(f64::max, f64::NEG_INFINITY)];
        }
    }
    let obstacles = obstacles(cases.iter().copied());
    chart.marks.extend(shapes(&obstacles));
    chart.marks.extend(outcome.demonstrations.iter().map(|shown| Mark::line("demonstrated", GREY, 0.6, shown.path_m.clone())));
    let movements = || cases.iter().flat_map(|case| case.of(method).map(move |movement| (*case, movement)));
    // The legend names the obstacles in their order, whichever is passed first.
    let entry = |one: &Obstacle| Some(drawn(&one.name(), one.color()?, (one.is_taught(), rank(&obstacles, &one.ellipse)), Vec::new()));
    chart.marks.extend(obstacles.iter().filter_map(entry));
    let mut paths: Vec<(&Case, &Movement)> = movements().collect();
    paths.sort_by_key(|(case, _)| (case.taught, Reverse(rank(&obstacles, &case.obstacle))));
    chart.marks.extend(paths.into_iter().map(|(case, movement)| path(case, movement, &obstacles)));
    chart.marks.extend(goals(cases));
    let hits: Vec<[f64; 2]> =
        movements().filter(|(_, movement)| movement.collides).filter_map(|(case, movement)| deepest(case, movement)).collect();
    if !hits.is_empty() {
        chart.marks.push(Mark::symbols("collision", VERMILION, Symbol::Cross, 4.5, hits));
    }
    chart
}

/// The obstacles, the widest first, or it would cover the others; of several the legend tells the look alone, as their paths have their names.
fn shapes(obstacles: &[Obstacle]) -> Vec<Mark> {
    let shape = |obstacle: &Obstacle| {
        let outline = ellipse_outline(obstacle.ellipse.centre_m, obstacle.ellipse.half_axes_m);
        match obstacle.color() {
            Some(color) => Mark::area("", color, 0.12, outline),
            None => Mark::area("obstacle", GREY, 0.35, outline),
        }
    };
    let several = (obstacles.len() > 1).then(|| Mark::area("obstacle, in the colour of its paths", GREY, 0.12, Vec::new()));
    obstacles.iter().rev().map(shape).chain(several).collect()
}

/// Taught and other goals, or the one that all situations share.
fn goals(cases: &[&Case]) -> Vec<Mark> {
    let of = |taught: bool| cases.iter().filter(move |case| case.taught == taught).map(|case| case.goal_m).collect::<Vec<_>>();
    if let [first, rest @ ..] = cases
        && rest.iter().all(|case| case.goal_m == first.goal_m)
    {
        return vec![Mark::symbols("goal", BLACK, Symbol::Disc, 3.0, vec![first.goal_m])];
    }
    vec![
        Mark::symbols("taught goal", BLACK, Symbol::Disc, 3.0, of(true)),
        Mark::symbols("goal that was not taught", YELLOW, Symbol::Square, 3.2, of(false)),
    ]
}

/// A path past one of several obstacles has that one's colour, and its method's otherwise.
fn path(case: &Case, movement: &Movement, obstacles: &[Obstacle]) -> Mark {
    let of_obstacle = obstacles.iter().find(|known| known.ellipse == case.obstacle).and_then(|one| Some((one.name(), one.color()?)));
    let (legend, color) = of_obstacle.unwrap_or_else(|| {
        let kind = if case.taught { "taught" } else { "not taught" };
        (format!("{}, {kind}", movement.method.title()), movement.method.color())
    });
    drawn(&legend, color, (case.taught, rank(obstacles, &case.obstacle)), movement.path_m.clone())
}

/// The line of a taught situation, or of another one, past the obstacle of a rank.
fn drawn(legend: &str, color: Rgb, (taught, rank): (bool, usize), points: Vec<[f64; 2]>) -> Mark {
    let [narrowest, wider] = if taught { TAUGHT_PT } else { NEW_PT };
    let width_pt = narrowest + wider * rank as f64;
    if taught { Mark::dashes(legend, color, width_pt, points) } else { Mark::line(legend, color, width_pt, points) }
}

/// The point of a path that is deepest inside the obstacle.
fn deepest(case: &Case, movement: &Movement) -> Option<[f64; 2]> {
    let depth = |point: &&[f64; 2]| case.obstacle.signed_distance(**point);
    movement.path_m.iter().min_by(|a, b| depth(a).total_cmp(&depth(b))).copied()
}
