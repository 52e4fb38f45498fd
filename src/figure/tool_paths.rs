//! Where the tool was led, where the skill wanted it, and where it went: the paper's Fig. 6(b).

use super::chart::{Axis, Chart, Figure};
use super::mark::{Mark, Symbol};
use crate::demonstration::Trajectory;
use crate::palette::{BLACK, BLUE, GREEN, GREY, VERMILION};
use crate::simulation::{Experiment, RunOutcome};
use crate::world::{ObjectKind, door_turn, support_height_m};

/// Width and height of a panel (pt).
const PANEL_PT: [f64; 2] = [340.0, 360.0];
/// Points of a door's arc.
const ARC_POINTS: usize = 91;

/// The plane of a panel: names and numbers of its axes.
type Plane = [(&'static str, usize); 2];

/// Two panels, from above and from the robot's right: taught, generated and executed paths, and the arcs on which doors carry their handles.
#[must_use]
pub fn tool_paths(outcome: &RunOutcome, experiment: &Experiment) -> Figure {
    let planes: [(&str, Plane); 2] = [("from above", [("x_m", 0), ("y_m", 1)]), ("from the side", [("x_m", 0), ("z_m", 2)])];
    let panels = planes.iter().map(|(title, plane)| panel(title, plane, outcome, experiment)).collect();
    Figure { title: "Paths of the tool".to_owned(), panels, columns: 2, panel_size_pt: PANEL_PT }
}

fn panel(title: &str, plane: &Plane, outcome: &RunOutcome, experiment: &Experiment) -> Chart {
    let label = |(name, _): (&str, usize)| name.replace("_m", " (m)");
    let mut chart = Chart::map(title, plane.map(|axis| Axis::new(&label(axis))));
    for demonstration in &outcome.dataset.demonstrations {
        chart.marks.extend(path(&demonstration.trajectory, plane).map(|points| Mark::line("taught", GREY, 0.6, points)));
    }
    for (arc, hinge) in arcs(experiment) {
        let flat = |point: &[f64; 3]| plane.map(|(_, axis)| point[axis]);
        chart.marks.push(Mark::line("arc of the handle", GREEN, 2.2, arc.iter().map(flat).collect()));
        chart.marks.push(Mark::symbols("hinge", BLACK, Symbol::Disc, 2.5, vec![flat(&hinge)]));
    }
    let executed = outcome.steps.iter().map(|step| plane.map(|(_, axis)| step.tool.translation.vector[axis])).collect();
    chart.marks.push(Mark::line("executed", VERMILION, 1.6, executed));
    chart.marks.extend(path(&outcome.plan, plane).map(|points| Mark::dashes("generated", BLUE, 1.0, points)));
    chart
}

fn path(trajectory: &Trajectory, plane: &Plane) -> Option<Vec<[f64; 2]>> {
    let values = trajectory.select(&plane.map(|(name, _)| name)).ok()?;
    Some(values.row_iter().map(|row| [row[0], row[1]]).collect())
}

/// The arc of the handle in use of every door, with its hinge at the handle's height (m, world).
fn arcs(experiment: &Experiment) -> Vec<(Vec<[f64; 3]>, [f64; 3])> {
    let support = support_height_m(&experiment.objects);
    let arc = |object: &crate::world::Object| {
        let ObjectKind::Cabinet(cabinet) = &object.kind else { return None };
        let center = object.center(&experiment.parameters);
        let hinge = center.push(cabinet.hinge_height_m(support));
        let handle = cabinet.handle(center.y, &experiment.parameters);
        let at = |k: usize| door_turn(cabinet.opening_max_rad * k as f64 / (ARC_POINTS - 1) as f64) * handle.coords + hinge;
        Some(((0..ARC_POINTS).map(|k| at(k).into()).collect(), hinge.into()))
    };
    experiment.objects.iter().filter_map(arc).collect()
}
