//! The forcing term over the phase with the states that make it: the paper's Fig. 6a.

use rerun::{EntityPath, Scalars};

use super::entity_path::{FORCING, FORCING_LOWER, FORCING_UPPER, TAUGHT_FORCING};
use super::lanes::{beta_color, beta_in_words};
use super::palette;
use super::paths::{AXES, COLUMNS, style};
use super::recorder::{Fault, Recorder};
use super::state_figure::{DEVIATIONS, POINTS};
use super::task_states::betas;
use crate::learning::motion_sequences;
use crate::simulation::{Experiment, RunOutcome};

/// Points of the skill's curve.
const CURVE_POINTS: usize = 281;
/// Every so many samples of a demonstration are drawn.
const EVERY: usize = 5;

/// Logs the forcing terms of the columns that are places. `duration_s` is how long the execution takes: the phase is drawn where it is then.
pub(super) fn log_forcing(recorder: &Recorder, experiment: &Experiment, outcome: &RunOutcome, duration_s: f64) -> Result<(), Fault> {
    let motion = &outcome.skill.motion;
    let sequences = motion_sequences(&outcome.dataset, &experiment.learning)?;
    let time_s = |input: f64| motion.phase_input.time_fraction(input, motion.alpha) * duration_s;
    let log = |entity: EntityPath, look, (times, values): (Vec<f64>, Vec<f64>)| -> Result<(), Fault> {
        recorder.always(entity.clone(), &look)?;
        recorder.at_times(entity, &times, Scalars::new(values).columns_of_unit_batches()?)
    };
    for (axis, name) in AXES.iter().enumerate() {
        let Some(column) = motion.columns.iter().position(|known| known == COLUMNS[axis]) else { continue };
        for (demonstration, sequence) in outcome.dataset.demonstrations.iter().zip(&sequences) {
            let rows = sequence.values.chunks_exact(sequence.dimension).step_by(EVERY);
            let points = rows.map(|row| (time_s(row[0]), row[column + 1])).unzip();
            log(TAUGHT_FORCING.of(&[name, &demonstration.name]), style("taught", palette::TAUGHT, 0.8), points)?;
        }
        for ellipse in ellipses(experiment, outcome, column)? {
            let look = || style(&format!("state, {}", beta_in_words(ellipse.beta)), beta_color(ellipse.beta), 1.0);
            for (entity, sign) in [(FORCING_UPPER, 1.0), (FORCING_LOWER, -1.0)] {
                let points = ellipse.half(sign).filter(|(input, _)| (0.0..=1.0).contains(input));
                let points = points.map(|(input, value)| (time_s(input), value)).unzip();
                log(entity.of(&[name, &ellipse.state.to_string()]), look(), points)?;
            }
        }
        log(FORCING.of(&[name]), style("skill", palette::PLANNED, 2.0), curve(experiment, outcome, column, duration_s)?)?;
    }
    Ok(())
}

/// The skill's forcing term along a column of the motion: times (s) and values.
fn curve(experiment: &Experiment, outcome: &RunOutcome, column: usize, duration_s: f64) -> Result<(Vec<f64>, Vec<f64>), Fault> {
    let skill = &outcome.skill;
    let mut shaping = skill.motion.shaping_at(&skill.request(&experiment.question())?.theta)?;
    let mut forcing = vec![0.0; skill.motion.columns.len()];
    let points = (0..CURVE_POINTS).map(|i| {
        let u = i as f64 / (CURVE_POINTS - 1) as f64;
        shaping.forcing(u, &mut forcing);
        (u * duration_s, forcing[column])
    });
    Ok(points.unzip())
}

/// A state over the phase input and one column of the forcing term.
struct Ellipse {
    state: usize,
    beta: f64,
    /// Mean, and covariance row by row.
    mean: [f64; 2],
    covariance: [[f64; 2]; 2],
}

/// The states at the parameters of the experiment; none for the baseline.
fn ellipses(experiment: &Experiment, outcome: &RunOutcome, column: usize) -> Result<Vec<Ellipse>, Fault> {
    let skill = &outcome.skill;
    let Some(phmm) = skill.motion.phmm() else { return Ok(Vec::new()) };
    let phi = skill.motion.parameters.features.at(&skill.request(&experiment.question())?.theta);
    let (row, betas) = (column + 1, betas(experiment, skill)?);
    let ellipse = |state: usize| {
        let (mean, all) = (phmm.mean_at(state, &phi), &phmm.covariances[state]);
        Ellipse {
            state,
            beta: betas[state],
            mean: [mean[0], mean[row]],
            covariance: [[all[(0, 0)], all[(0, row)]], [all[(row, 0)], all[(row, row)]]],
        }
    };
    Ok((0..phmm.states()).map(ellipse).collect())
}

impl Ellipse {
    /// One half as a curve over the phase input: `f = m_f + S_fp / S_pp (p - m_p) ± k sqrt((S_ff - S_fp^2 / S_pp) (1 - (p - m_p)^2 / (k^2 S_pp)))`.
    fn half(&self, sign: f64) -> impl Iterator<Item = (f64, f64)> {
        let [[pp, pf], [fp, ff]] = self.covariance;
        let (slope, rest) = (fp / pp, (ff - fp * pf / pp).max(0.0).sqrt());
        let (mean, width) = (self.mean, DEVIATIONS * pp.max(0.0).sqrt());
        (0..POINTS).map(move |i| {
            let angle = std::f64::consts::PI * (1.0 - i as f64 / (POINTS - 1) as f64);
            let along = width * angle.cos();
            (mean[0] + along, mean[1] + slope * along + sign * DEVIATIONS * rest * angle.sin())
        })
    }
}
