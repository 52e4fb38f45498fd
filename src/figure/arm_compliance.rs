//! Where the arm complies, why, and what comes of it: spread of the demonstrations, beta, forces and displacement over one time.

use nalgebra::Vector3;

use super::arm_run::{ArmRun, kind_of};
use super::chart::{Axis, Chart, Figure};
use super::mark::{Anchor, Mark};
use crate::learning::cpdmp::{Statistic, spread_unit};
use crate::palette::BLACK;
use crate::palette::meaning::{COMPLIES, EXECUTED, EXPECTED, MEASURED, PERSON, PLANNED};
use crate::simulation::StepRecord;

/// Width and height of a panel (pt).
const PANEL_PT: [f64; 2] = [600.0, 170.0];

/// The compliance profile of a run.
#[must_use]
pub fn arm_compliance(run: &ArmRun) -> Figure {
    let mut panels = vec![switch(run), forces(run), displacement(run)];
    if !run.states.is_empty() {
        panels.insert(0, spread(run));
    }
    Figure { title: format!("Compliance: {}", run.name), panels, columns: 1, panel_size_pt: PANEL_PT }
}

/// A panel over the time of the whole run, with its compliant windows.
fn panel(run: &ArmRun, title: &str, vertical: &str) -> Chart {
    let mut horizontal = Axis::new("time (s)");
    horizontal.includes = vec![0.0, run.steps.last().map_or(run.duration_s, |step| step.time_s)];
    let mut chart = Chart::plot(title, [horizontal, Axis::new(vertical)]);
    chart.marks.extend(run.compliant_windows());
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
    number_states(run, &mut chart);
    chart
}

/// Writes the number of every state above its bar.
fn number_states(run: &ArmRun, chart: &mut Chart) {
    let top = |mark: &Mark| mark.places().iter().map(|place| place[1]).fold(0.0, f64::max);
    let highest = chart.marks.iter().map(top).fold(0.0, f64::max);
    for state in &run.states {
        let (Some([from, to]), Some(value_m2)) = (state.active, run.skill.compliance.values_m2.get(state.state)) else { continue };
        let above = [0.5 * (from + to) * run.duration_s, millimetres(*value_m2) + 0.07 * highest];
        chart.marks.push(Mark::words(BLACK, above, Anchor::Middle, &state.state.to_string()));
    }
    if let Some([_, vertical]) = &mut chart.axes {
        vertical.includes = vec![1.12 * highest];
    }
}

/// The standard deviation (thousandths of a unit) of a variance (its square).
fn millimetres(value_m2: f64) -> f64 {
    value_m2.max(0.0).sqrt() * 1e3
}

fn switch(run: &ArmRun) -> Chart {
    let mut chart = panel(run, "Compliance of the active state, and how far the coupling is on", "beta, activation (-)");
    chart.marks.push(Mark::line("beta", COMPLIES, 1.6, run.executed(|step| step.beta)));
    chart.marks.push(Mark::line("activation", EXECUTED, 1.2, run.executed(|step| step.activation)));
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
    chart.marks.push(Mark::line("of the person", PERSON, 1.6, run.executed(|step| step.human.force.norm())));
    chart
}

fn displacement(run: &ArmRun) -> Chart {
    let mut chart = panel(run, "How far forces move the tool from the plan", "displacement (mm)");
    let asked = run.executed(|step| step.coupling_displacement.norm() * 1e3);
    chart.marks.push(Mark::line("asked for by the coupling", PLANNED, 1.0, asked));
    chart.marks.push(Mark::line("reference, off the plan", EXECUTED, 1.6, run.executed(|step| step.deviation.norm() * 1e3)));
    chart
}
