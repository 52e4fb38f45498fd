//! The plane: obstacles, demonstrations, and the paths of every method (the paper's Figs. 1 to 3).

use rerun::{Points2D, Radius, Transform3D};

use super::palette;
use super::planar_entity::{DEMONSTRATIONS, GOALS, MAP, OBSTACLES};
use super::planar_grid::log_grid;
use super::planar_movements::Drawn;
use super::planar_recorder::PlanarRecorder;
use super::planar_shapes::{ON_TOP, closed, points, strips};
use super::recorder::Fault;
use crate::math::ellipse_outline;
use crate::planar::{Obstacle, PlanarOutcome, obstacles};

/// Width of demonstrations on the screen (pt). Thinner lines break into dots.
const SHOWN_PT: f32 = 1.3;

/// Logs everything in the plane.
pub(super) fn log_map(recorder: &PlanarRecorder, outcome: &PlanarOutcome) -> Result<(), Fault> {
    let up = Transform3D::from_mat3x3([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]);
    recorder.always(MAP.path(), &up)?;
    log_grid(recorder, outcome)?;
    let obstacles = obstacles(&outcome.cases);
    let outline = |one: &Obstacle| closed(ellipse_outline(one.ellipse.centre_m, one.ellipse.half_axes_m));
    let outlines = strips(obstacles.iter().map(outline).collect(), palette::IDLE, 1.5);
    let colors = obstacles.iter().map(|one| one.color().map_or(palette::IDLE, palette::rgb));
    recorder.always(
        OBSTACLES.path(),
        &outlines.with_colors(colors).with_labels(obstacles.iter().map(Obstacle::name)).with_show_labels(false),
    )?;
    let shown = outcome.demonstrations.iter().map(|shown| points(&shown.path_m)).collect();
    recorder.always(DEMONSTRATIONS.path(), &strips(shown, palette::TAUGHT, SHOWN_PT))?;
    log_goals(recorder, outcome)?;
    for guidance in outcome.guidances() {
        for method in outcome.methods_with(guidance) {
            Drawn { recorder, outcome, obstacles: &obstacles, guidance, method }.log()?;
        }
    }
    Ok(())
}

/// Where movements should end (m), each place once, and whether that was taught.
pub(super) fn goals(outcome: &PlanarOutcome) -> Vec<([f64; 2], bool)> {
    let mut goals: Vec<([f64; 2], bool)> = Vec::new();
    for case in &outcome.cases {
        if goals.iter().all(|(goal, _)| *goal != case.goal_m) {
            goals.push((case.goal_m, case.taught));
        }
    }
    goals
}

fn log_goals(recorder: &PlanarRecorder, outcome: &PlanarOutcome) -> Result<(), Fault> {
    let goals = goals(outcome);
    let colors = goals.iter().map(|(_, taught)| if *taught { palette::IDLE } else { palette::rgb(crate::palette::YELLOW) });
    let places: Vec<[f64; 2]> = goals.iter().map(|(goal, _)| *goal).collect();
    recorder.always(
        GOALS.path(),
        &Points2D::new(points(&places)).with_colors(colors).with_radii([Radius::new_ui_points(4.0)]).with_draw_order(ON_TOP),
    )
}
