//! What the run felt against what it expected, and what was executed beside it: one panel per axis.

use super::arm_run::{ArmRun, over_time};
use super::chart::{Axis, Chart, Figure};
use super::mark::Mark;
use crate::palette::meaning::EXECUTED;
use crate::simulation::StepRecord;

/// Width and height of a panel (pt).
const PANEL_PT: [f64; 2] = [600.0, 190.0];
/// The axes of the robot's base frame, with what they are called.
const AXES: [(&str, &str); 3] = [("x", "x: forwards"), ("y", "y: to the left"), ("z", "z: upwards")];

/// Measured less expected force over time, of the run and of what stands beside it and expects forces; none when nothing does, or the run
/// expects none.
#[must_use]
pub fn arm_forces(run: &ArmRun) -> Option<Figure> {
    if !run.beside.iter().any(|(_, steps)| expects(steps)) || run.skill.force.is_none() {
        return None;
    }
    let panels = (0..3).map(|axis| panel(run, axis)).collect();
    Some(Figure { title: format!("Force, measured less expected: {}", run.name), panels, columns: 1, panel_size_pt: PANEL_PT })
}

fn panel(run: &ArmRun, axis: usize) -> Chart {
    let (name, title) = AXES[axis];
    let mut chart = Chart::plot(title, [Axis::new("time (s)"), Axis::new(&format!("unexpected force {name} (N)"))]);
    chart.marks.extend(run.compliant_windows());
    let unexpected = |step: &StepRecord| step.wrench[axis] - step.expected_force[axis];
    chart.marks.extend(run.others(|steps| expects(steps).then(|| over_time(steps, unexpected))));
    chart.marks.push(Mark::line("executed", EXECUTED, 1.1, run.executed(unexpected)));
    chart
}

/// Whether a force is ever expected: a skill without a model of the forces, as the baseline, expects none, and its whole force would be drawn.
fn expects(steps: &[StepRecord]) -> bool {
    steps.iter().any(|step| step.expected_force.norm() > 0.0)
}
