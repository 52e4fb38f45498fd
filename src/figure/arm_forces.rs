//! What the run felt and what it expected, and what was executed beside it: one row per axis.

use super::arm_run::{ArmRun, over_time};
use super::chart::{Axis, Chart, Figure};
use super::mark::Mark;
use crate::palette::meaning::{EXECUTED, EXPECTED, MEASURED};
use crate::simulation::StepRecord;

/// Width and height of a panel with another one beside it, and of one that has the row to itself (pt).
const PANEL_PT: [f64; 2] = [400.0, 190.0];
const WIDE_PANEL_PT: [f64; 2] = [600.0, 190.0];
/// Width of the line of a force (pt).
const LINE_PT: f64 = 1.1;
/// The axes of the robot's base frame, with what they are called.
const AXES: [(&str, &str); 3] = [("x", "x, forwards"), ("y", "y, to the left"), ("z", "z, upwards")];

/// Forces on the tool over time: measured and expected ones at the left, at the right how far they are from each other, of the run and of what
/// stands beside it and expects forces. Where the run expects none, there is only what was measured.
#[must_use]
pub fn arm_forces(run: &ArmRun) -> Figure {
    let expects = run.skill.force.is_some();
    let of_axis = |axis: usize| [Some(felt(run, axis)), expects.then(|| unexpected(run, axis))];
    let panels: Vec<Chart> = (0..3).flat_map(of_axis).flatten().collect();
    let (columns, panel_size_pt) = if expects { (2, PANEL_PT) } else { (1, WIDE_PANEL_PT) };
    Figure { title: format!("Forces on the tool: {}", run.name), panels, columns, panel_size_pt }
}

/// What was measured, and what the run expected. The measure is smoother than what an engine solves for its contacts, and says so.
fn felt(run: &ArmRun, axis: usize) -> Chart {
    let (name, title) = AXES[axis];
    let mut chart = Chart::plot(
        &format!("{title}: smoothed estimate from the joints"),
        [Axis::new("time (s)"), Axis::new(&format!("force {name} (N)"))],
    );
    chart.marks.extend(run.stretches());
    let measured = |step: &StepRecord| step.wrench[axis];
    chart.marks.extend(run.others(LINE_PT, |steps| Some(over_time(steps, measured))));
    chart.marks.push(Mark::line("measured", MEASURED, LINE_PT, run.executed(measured)));
    if run.skill.force.is_some() {
        chart.marks.push(Mark::line("expected", EXPECTED, 1.6, run.executed(|step| step.expected_force[axis])));
    }
    chart
}

/// Measured less expected force.
fn unexpected(run: &ArmRun, axis: usize) -> Chart {
    let (name, title) = AXES[axis];
    let axes = [Axis::new("time (s)"), Axis::new(&format!("unexpected force {name} (N)"))];
    let mut chart = Chart::plot(&format!("{title}: measured less expected"), axes);
    chart.marks.extend(run.stretches());
    let unexpected = |step: &StepRecord| step.wrench[axis] - step.expected_force[axis];
    chart.marks.extend(run.others(LINE_PT, |steps| expects(steps).then(|| over_time(steps, unexpected))));
    chart.marks.push(Mark::line("executed, measured less expected", EXECUTED, LINE_PT, run.executed(unexpected)));
    chart
}

/// Whether a force is ever expected: a skill without a model of the forces, as the baseline, expects none, and its whole force would be drawn.
fn expects(steps: &[StepRecord]) -> bool {
    steps.iter().any(|step| step.expected_force.norm() > 0.0)
}
