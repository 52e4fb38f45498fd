//! The forcing term over the phase with the states that make it: the paper's Fig. 6a.

use rerun::{EntityPath, Scalars};

use super::entity_path::{FORCING, FORCING_OUTLINES, TAUGHT_FORCING};
use super::outline_figure::{Outline, around, log_outlines};
use super::palette;
use super::paths::{AXES, COLUMNS, style};
use super::recorder::{Fault, Recorder};
use super::state_figure::DEVIATIONS;
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
        let input_at = |time_s: f64| motion.phase_input.at(time_s / duration_s, motion.alpha);
        let outline = |ellipse: &Ellipse| {
            let (ellipse, inputs) = (*ellipse, ellipse.inputs());
            let times_s = inputs.filter(|input| (0.0..=1.0).contains(input)).map(time_s).collect();
            Outline { beta: ellipse.beta, times_s, halves: Box::new(move |time_s| ellipse.halves(input_at(time_s))) }
        };
        let outlines: Vec<Outline<'_>> = ellipses(experiment, outcome, column)?.iter().map(outline).collect();
        log_outlines(recorder, &FORCING_OUTLINES.of(&[name]), &outlines)?;
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
#[derive(Clone, Copy)]
struct Ellipse {
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
            beta: betas[state],
            mean: [mean[0], mean[row]],
            covariance: [[all[(0, 0)], all[(0, row)]], [all[(row, 0)], all[(row, row)]]],
        }
    };
    Ok((0..phmm.states()).map(ellipse).collect())
}

impl Ellipse {
    /// Phase inputs at equal angles around it.
    fn inputs(&self) -> impl Iterator<Item = f64> + use<> {
        around(self.mean[0], DEVIATIONS * self.covariance[0][0].max(0.0).sqrt())
    }

    /// Where it is cut at a phase input: `f = m_f + S_fp / S_pp (p - m_p) ± sqrt((S_ff - S_fp^2 / S_pp) (k^2 - (p - m_p)^2 / S_pp))`.
    fn halves(&self, input: f64) -> [f64; 2] {
        let [[pp, pf], [fp, ff]] = self.covariance;
        let away = input - self.mean[0];
        let middle = self.mean[1] + fp / pp * away;
        let half = (ff - fp * pf / pp).max(0.0).sqrt() * (DEVIATIONS * DEVIATIONS - away * away / pp).sqrt();
        [middle + half, middle - half]
    }
}
