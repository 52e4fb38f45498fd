//! Where the arm complies, why, and what comes of it: spread of the demonstrations, beta, forces and displacement over one time.

use std::cmp::Ordering;

use nalgebra::Vector3;

use super::arm_run::{ArmRun, kind_of, over_time};
use super::chart::{Axis, Chart, Figure};
use super::mark::Mark;
use super::state_numbers::number_states;
use crate::learning::cpdmp::{Statistic, spread_unit};
use crate::palette::BLACK;
use crate::palette::meaning::{COMPLIES, EXECUTED, EXPECTED, MEASURED, MINIMISES, PERSON, PLANNED, STIFF};
use crate::simulation::StepRecord;

/// Width and height of a panel (pt).
const PANEL_PT: [f64; 2] = [600.0, 170.0];
/// About the part of it between the axes (pt).
const PLOT_PT: [f64; 2] = [PANEL_PT[0] - 78.0, PANEL_PT[1] - 62.0];

/// The compliance profile of a run.
#[must_use]
pub fn arm_compliance(run: &ArmRun) -> Figure {
    let mut panels = vec![switch(run), forces(run)];
    if !run.states.is_empty() {
        panels.insert(0, spread(run));
    }
    panels.extend(displacement(run));
    Figure { title: format!("Compliance: {}", run.name), panels, columns: 1, panel_size_pt: PANEL_PT }
}

/// A panel over the time of the whole run, with its compliant windows and the time after the skill.
fn panel(run: &ArmRun, title: &str, vertical: &str) -> Chart {
    let mut horizontal = Axis::new("time (s)");
    horizontal.includes = vec![0.0, run.steps.last().map_or(run.duration_s, |step| step.time_s)];
    let mut chart = Chart::plot(title, [horizontal, Axis::new(vertical)]);
    chart.marks.extend(run.stretches());
    chart
}

/// The root of each state's statistic, while the state is active, against the root of sigma: eq. (20) in units that can be imagined.
fn spread(run: &ArmRun) -> Chart {
    let compliance = &run.skill.compliance;
    let statistic = match compliance.statistic {
        Statistic::Literal => "Spread of each state: its own covariance",
        Statistic::Conditional => "Spread of each state: its covariance given the phase",
        Statistic::BetweenDemonstration => "Spread of each state: how far demonstrations disagree",
    };
    let mut chart = panel(run, statistic, &format!("spread ({})", spread_unit(&run.skill.motion.columns)));
    for state in &run.states {
        let (Some([from, to]), Some(value_m2)) = (state.active, compliance.values_m2.get(state.state)) else { continue };
        let (color, legend) = kind_of(state.beta);
        let (from, to, height) = (from * run.duration_s, to * run.duration_s, millimetres(*value_m2));
        chart.marks.push(Mark::area(legend, color, 0.45, vec![[from, 0.0], [from, height], [to, height], [to, 0.0]]));
    }
    if compliance.threshold_m2.is_finite() {
        let sigma = millimetres(compliance.threshold_m2);
        chart.marks.push(Mark::dashes("root of the threshold sigma", BLACK, 1.0, vec![[0.0, sigma], [run.duration_s, sigma]]));
    }
    number_states(run, PLOT_PT, &mut chart);
    chart
}

/// The standard deviation (thousandths of a unit) of a variance (its square).
fn millimetres(value_m2: f64) -> f64 {
    value_m2.max(0.0).sqrt() * 1e3
}

fn switch(run: &ArmRun) -> Chart {
    // A state may be one that complies in a run that does not let it.
    let how_far =
        if run.steps.iter().any(|step| step.activation > 0.0) { ", and how far the coupling is on" } else { "; the coupling is never on" };
    let mut chart = panel(run, &format!("Compliance of the active state{how_far}"), "beta, activation (-)");
    // Pieces of one colour, each up to where the next one begins.
    let (mut from, kind) = (0, |step: &StepRecord| step.acting_beta().partial_cmp(&0.0));
    for piece in run.steps.chunk_by(|a, b| kind(a) == kind(b)) {
        let until = (from + piece.len() + 1).min(run.steps.len());
        let (legend, color) = match kind(&piece[0]) {
            Some(Ordering::Less) => ("beta, complies", COMPLIES),
            Some(Ordering::Greater) => ("beta, minimises the force error", MINIMISES),
            _ => ("beta, stiff", STIFF),
        };
        chart.marks.push(Mark::line(legend, color, 2.2, over_time(&run.steps[from..until], StepRecord::acting_beta)));
        from += piece.len();
    }
    chart.marks.push(Mark::line("activation of the coupling", BLACK, 0.8, run.executed(|step| step.activation)));
    if let Some([_, vertical]) = &mut chart.axes {
        vertical.includes = vec![-1.0, 1.0];
    }
    chart
}

fn forces(run: &ArmRun) -> Chart {
    let mut chart = panel(run, "Size of the forces at the tool", "force (N)");
    let measured = |step: &StepRecord| Vector3::from(step.wrench.fixed_rows::<3>(0)).norm();
    chart.marks.push(Mark::line("measured", MEASURED, 0.7, run.executed(measured)));
    if run.skill.force.is_some() {
        chart.marks.push(Mark::line("expected", EXPECTED, 1.6, run.executed(|step| step.expected_force.norm())));
    }
    if run.steps.iter().any(|step| step.human.force.norm() > 0.0) {
        chart.marks.push(Mark::line("of the person", PERSON, 1.6, run.executed(|step| step.human.force.norm())));
    }
    chart
}

/// None where the coupling never asks for anything.
fn displacement(run: &ArmRun) -> Option<Chart> {
    run.steps.iter().find(|step| step.coupling_displacement.norm() > 0.0)?;
    let mut chart = panel(run, "How far forces move the tool from the plan", "displacement (mm)");
    let asked = run.executed(|step| step.coupling_displacement.norm() * 1e3);
    chart.marks.push(Mark::line("asked for by the coupling", PLANNED, 1.0, asked));
    chart.marks.push(Mark::line("reference, off the plan", EXECUTED, 1.6, run.executed(|step| step.deviation.norm() * 1e3)));
    Some(chart)
}
