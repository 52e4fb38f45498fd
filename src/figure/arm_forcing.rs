//! The forcing term over the phase with the states that make it.

use nalgebra::{DVector, Matrix2};

use super::arm_run::{ArmRun, Curve, DEVIATIONS, kind_of};
use super::chart::{Axis, Chart, Figure};
use super::mark::Mark;
use crate::learning::cpdmp::MotionModel;
use crate::learning::dmp::PhaseInput;
use crate::learning::phmm::Sequence;
use crate::learning::{LearningError, motion_sequences};
use crate::math::covariance_outline;
use crate::palette::meaning::{PLANNED, TAUGHT};

/// Width and height of a panel (pt).
pub(super) const PANEL_PT: [f64; 2] = [600.0, 220.0];
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
    let curve = ForcingCurve::of(motion, &run.skill.request(&run.question)?.theta)?;
    let panel = |j: usize| {
        let mut chart = panel_of(motion, j);
        chart.marks.extend(sequences.iter().map(|sequence| Mark::line("taught", TAUGHT, 0.6, demanded(sequence, j))));
        for state in &run.states {
            let (color, legend) = kind_of(state.beta);
            chart.marks.extend(curve.outline(motion, state.state, j).map(|outline| Mark::area(legend, color, 0.15, outline)));
        }
        chart.marks.push(Mark::line("of the skill in this setting", PLANNED, 1.8, curve.along(j)));
        chart
    };
    let panels = (0..motion.columns.len()).map(panel).collect();
    Ok(Figure { title: format!("Forcing term: {}", run.name), panels, columns: 1, panel_size_pt: PANEL_PT })
}

/// Forcing is drawn over at least this range (m or rad).
const LEAST_RANGE: f64 = 0.01;

/// An empty panel for the forcing along column `j` of the motion.
pub(super) fn panel_of(motion: &MotionModel, j: usize) -> Chart {
    let input = match motion.phase_input {
        PhaseInput::TimeFraction => "phase input u = -ln(s)/alpha (-)",
        PhaseInput::Phase => "phase s (-)",
    };
    Chart::plot("", [Axis::new(input), Axis::at_least(&format!("forcing along {}", labelled(&motion.columns[j])), LEAST_RANGE)])
}

/// What a demonstration demands along column `j` (4).
pub(super) fn demanded(sequence: &Sequence, j: usize) -> Curve {
    sequence.values.chunks_exact(sequence.dimension).map(|row| [row[0], row[j + 1]]).collect()
}

/// The forcing term of a skill for some parameters.
pub(super) struct ForcingCurve {
    features: DVector<f64>,
    phase: Vec<f64>,
    forcing: Vec<Vec<f64>>,
}

impl ForcingCurve {
    pub(super) fn of(motion: &MotionModel, theta: &DVector<f64>) -> Result<Self, LearningError> {
        let mut shaping = motion.shaping_at(theta)?;
        let (mut phase, mut forcing) = (Vec::with_capacity(POINTS), Vec::with_capacity(POINTS));
        for i in 0..POINTS {
            let u = i as f64 / (POINTS - 1) as f64;
            let mut f = vec![0.0; motion.columns.len()];
            shaping.forcing(u, &mut f);
            phase.push(motion.phase_input.at(u, motion.alpha));
            forcing.push(f);
        }
        Ok(Self { features: motion.parameters.features.at(theta), phase, forcing })
    }

    /// The forcing along column `j` over the phase.
    pub(super) fn along(&self, j: usize) -> Curve {
        self.phase.iter().zip(&self.forcing).map(|(u, f)| [*u, f[j]]).collect()
    }

    /// The ellipse of a state over phase and column `j`; none for the baseline.
    pub(super) fn outline(&self, motion: &MotionModel, state: usize, j: usize) -> Option<Curve> {
        let phmm = motion.phmm()?;
        let (mean, all) = (phmm.mean_at(state, &self.features), &phmm.covariances[state]);
        let covariance = Matrix2::new(all[(0, 0)], all[(0, j + 1)], all[(j + 1, 0)], all[(j + 1, j + 1)]);
        Some(covariance_outline([mean[0], mean[j + 1]], &covariance, DEVIATIONS))
    }
}

/// `x_m` as `x (m)`.
fn labelled(column: &str) -> String {
    column.rsplit_once('_').map_or_else(|| column.to_owned(), |(name, unit)| format!("{name} ({unit})"))
}
