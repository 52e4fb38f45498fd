//! The tool's motion over time with the states of the skill: the paper's Figs. 10 and 11.

use std::f64::consts::TAU;

use super::arm_run::{ArmRun, Curve, DEVIATIONS, EXECUTED_PT, OTHERS_PT, PLANNED_PT, kind_of, over_time};
use super::chart::{Axis, Chart, Figure};
use super::mark::Mark;
use crate::learning::TaskSpaceState;
use crate::palette::meaning::{EXECUTED, PLANNED, TAUGHT};

/// Width and height of a panel (pt).
const PANEL_PT: [f64; 2] = [600.0, 220.0];
/// A coordinate is drawn over at least this range (m).
const LEAST_RANGE_M: f64 = 0.02;
/// Points of an outline.
const POINTS: usize = 80;
/// The axes of the robot's base frame, with what they are called.
const AXES: [(&str, &str); 3] = [("x", "x: forwards"), ("y", "y: to the left"), ("z", "z: upwards")];

/// One panel per axis: taught, planned and executed motion of the tool, and every state as an ellipse that is as wide as the state is long
/// and as high as the demonstrations disagree in it, at two standard deviations each. A skill of the joints has neither plan nor states there.
#[must_use]
pub fn arm_motion(run: &ArmRun) -> Figure {
    let panels = (0..3).map(|axis| panel(run, axis)).collect();
    Figure { title: format!("Motion of the tool: {}", run.name), panels, columns: 1, panel_size_pt: PANEL_PT }
}

fn panel(run: &ArmRun, axis: usize) -> Chart {
    let (name, title) = AXES[axis];
    let column = format!("{name}_m");
    let mut chart = Chart::plot(title, [Axis::new("time (s)"), Axis::at_least(&format!("{name} (m)"), LEAST_RANGE_M)]);
    chart.marks.extend(run.stretches());
    chart.marks.extend(run.taught(&column).into_iter().map(|taught| Mark::line("taught", TAUGHT, 0.6, taught)));
    let of_column = run.skill.motion.columns.iter().position(|known| *known == column);
    if let (Some(of_column), Some(planned)) = (of_column, run.planned(&column)) {
        chart.marks.extend(run.states.iter().map(|state| ellipse(run, state, of_column, &planned)));
        chart.marks.push(Mark::line("planned", PLANNED, PLANNED_PT, planned));
    }
    chart.marks.extend(run.others(OTHERS_PT, |steps| Some(over_time(steps, |step| step.tool.translation.vector[axis]))));
    chart.marks.push(Mark::line("executed", EXECUTED, EXECUTED_PT, run.executed(|step| step.tool.translation.vector[axis])));
    chart
}

/// The outline of a state, carried along the planned coordinate `m`: `x = m(t) + k sigma_x sin(a)` at `t = t_i + k sigma_t cos(a)`. Its
/// part outside of the movement is cut off.
fn ellipse(run: &ArmRun, state: &TaskSpaceState, column: usize, planned: &Curve) -> Mark {
    let half_s = DEVIATIONS * state.u_deviation * run.duration_s;
    let half_m = DEVIATIONS * state.between[(column, column)].max(0.0).sqrt();
    let point = |i: usize| {
        let angle = TAU * i as f64 / POINTS as f64;
        let time_s = (state.u * run.duration_s + half_s * angle.cos()).clamp(0.0, run.duration_s);
        [time_s, at(planned, time_s) + half_m * angle.sin()]
    };
    let (color, legend) = kind_of(state.beta);
    Mark::area(legend, color, 0.15, (0..POINTS).map(point).collect())
}

/// The value of a curve of evenly spaced times, between two points on a straight line.
fn at(curve: &Curve, time_s: f64) -> f64 {
    let (start, end) = (curve[0][0], curve[curve.len() - 1][0]);
    let along = (time_s - start) / (end - start) * (curve.len() - 1) as f64;
    let before = (along.max(0.0) as usize).min(curve.len() - 2);
    let fraction = along - before as f64;
    curve[before][1] * (1.0 - fraction) + curve[before + 1][1] * fraction
}
