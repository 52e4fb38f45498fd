//! The tool's paths in space, from above and from the side, with the ellipses of the states (the paper's Fig. 6b).

use nalgebra::Matrix2;

use super::arm_run::{ArmRun, Curve, DEVIATIONS, kind_of};
use super::chart::{Axis, Chart, Figure};
use super::mark::{Mark, Symbol};
use crate::math::covariance_outline;
use crate::palette::BLACK;
use crate::palette::meaning::{EXECUTED, PLANNED, TAUGHT};
use crate::simulation::StepRecord;

/// Width and height of a panel (pt).
const PANEL_PT: [f64; 2] = [340.0, 330.0];
/// What is seen: the axes to the right and upwards.
const VIEWS: [(&str, [usize; 2]); 3] = [("From above", [0, 1]), ("From the robot's front", [1, 2]), ("From the robot's right", [0, 2])];
const AXES: [&str; 3] = ["x", "y", "z"];

/// One panel per view of the taught, planned and executed paths; none when the skill does not move all three coordinates.
#[must_use]
pub fn arm_paths(run: &ArmRun) -> Option<Figure> {
    let columns = AXES.map(|axis| format!("{axis}_m"));
    let planned = columns.each_ref().map(|column| run.planned(column));
    let [Some(x), Some(y), Some(z)] = planned else { return None };
    let planned = [x, y, z];
    let taught = columns.each_ref().map(|column| run.taught(column));
    let places = columns.each_ref().map(|column| run.skill.motion.columns.iter().position(|known| known == column));
    let panel = |(title, axes): (&str, [usize; 2])| {
        let mut chart = Chart::map(title, axes.map(|axis| Axis::new(&format!("{} (m)", AXES[axis]))));
        let pairs = taught[axes[0]].iter().zip(&taught[axes[1]]);
        chart.marks.extend(pairs.map(|(a, b)| Mark::line("taught", TAUGHT, 0.6, across(a, b))));
        for state in &run.states {
            let [Some(a), Some(b)] = axes.map(|axis| places[axis]) else { break };
            let spread = Matrix2::from_fn(|i, j| state.between[([a, b][i], [a, b][j])]);
            let (color, legend) = kind_of(state.beta);
            let outline = covariance_outline([state.position[a], state.position[b]], &spread, DEVIATIONS);
            chart.marks.push(Mark::area(legend, color, 0.15, outline));
        }
        chart.marks.push(Mark::line("planned", PLANNED, 1.6, across(&planned[axes[0]], &planned[axes[1]])));
        let path = |steps: &[StepRecord]| steps.iter().map(|step| axes.map(|axis| step.tool.translation.vector[axis])).collect::<Curve>();
        chart.marks.extend(run.others(|steps| Some(path(steps))));
        let executed = path(run.steps);
        let start = executed.first().copied();
        chart.marks.push(Mark::line("executed", EXECUTED, 1.6, executed));
        let arcs = run.arcs.iter().map(|arc| arc.iter().map(|place| axes.map(|axis| place[axis])).collect());
        chart.marks.extend(arcs.map(|arc| Mark::dashes("arc of the handle about its hinge", BLACK, 0.8, arc)));
        chart.marks.push(Mark::symbols("start", BLACK, Symbol::Ring, 3.0, start.into_iter().collect()));
        chart
    };
    let panels = VIEWS.map(panel).to_vec();
    Some(Figure { title: format!("Paths of the tool: {}", run.name), panels, columns: 2, panel_size_pt: PANEL_PT })
}

/// Two curves over one time as a path.
fn across(right: &Curve, up: &Curve) -> Curve {
    right.iter().zip(up).map(|(a, b)| [a[1], b[1]]).collect()
}
