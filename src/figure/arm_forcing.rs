//! The forcing term over the phase with the states that make it: the paper's Fig. 6a.

use nalgebra::Matrix2;

use super::arm_run::{ArmRun, DEVIATIONS, kind_of};
use super::chart::{Axis, Chart, Figure};
use super::mark::Mark;
use crate::learning::dmp::PhaseInput;
use crate::learning::{LearningError, motion_sequences};
use crate::math::covariance_outline;
use crate::palette::meaning::{PLANNED, TAUGHT};

/// Width and height of a panel (pt).
const PANEL_PT: [f64; 2] = [600.0, 220.0];
/// Points of the curve.
const POINTS: usize = 401;

/// One panel per column of the motion: what the forcing terms of the demonstrations must have been (4), the skill's in the setting, and its
/// states at two standard deviations.
///
/// # Errors
/// When the demonstrations cannot be used, or parameters are missing.
pub fn arm_forcing(run: &ArmRun) -> Result<Figure, LearningError> {
    let motion = &run.skill.motion;
    let sequences = motion_sequences(run.dataset, run.learning)?;
    let theta = run.skill.request(&run.question)?.theta;
    let mut shaping = motion.shaping_at(&theta)?;
    let features = motion.parameters.features.at(&theta);
    let (mut phase, mut forcing) = (Vec::with_capacity(POINTS), Vec::with_capacity(POINTS));
    for i in 0..POINTS {
        let u = i as f64 / (POINTS - 1) as f64;
        let mut f = vec![0.0; motion.columns.len()];
        shaping.forcing(u, &mut f);
        phase.push(motion.phase_input.at(u, motion.alpha));
        forcing.push(f);
    }
    let input = match motion.phase_input {
        PhaseInput::TimeFraction => "phase input u = -ln(s)/alpha (-)",
        PhaseInput::Phase => "phase s (-)",
    };
    let panel = |(j, column): (usize, &String)| {
        let mut chart = Chart::plot("", [Axis::new(input), Axis::new(&format!("forcing along {}", labelled(column)))]);
        let taught = sequences.iter().map(|sequence| sequence.values.chunks_exact(sequence.dimension).map(|row| [row[0], row[j + 1]]));
        chart.marks.extend(taught.map(|points| Mark::line("taught", TAUGHT, 0.6, points.collect())));
        for state in &run.states {
            let Some(phmm) = motion.phmm() else { break };
            let (mean, all) = (phmm.mean_at(state.state, &features), &phmm.covariances[state.state]);
            let covariance = Matrix2::new(all[(0, 0)], all[(0, j + 1)], all[(j + 1, 0)], all[(j + 1, j + 1)]);
            let (color, legend) = kind_of(state.beta);
            chart.marks.push(Mark::area(legend, color, 0.15, covariance_outline([mean[0], mean[j + 1]], &covariance, DEVIATIONS)));
        }
        let curve = phase.iter().zip(&forcing).map(|(u, f)| [*u, f[j]]).collect();
        chart.marks.push(Mark::line("of the skill in this setting", PLANNED, 1.8, curve));
        chart
    };
    let panels = motion.columns.iter().enumerate().map(panel).collect();
    Ok(Figure { title: format!("Forcing term: {}", run.name), panels, columns: 1, panel_size_pt: PANEL_PT })
}

/// `x_m` as `x (m)`.
fn labelled(column: &str) -> String {
    column.rsplit_once('_').map_or_else(|| column.to_owned(), |(name, unit)| format!("{name} ({unit})"))
}
