//! From demonstrations to what the models learn from: forcing targets and wrenches over the phase, at one rate.

use nalgebra::{DMatrix, DVector};

use super::dmp::forcing_target;
use super::phmm::Sequence;
use super::{LearningError, LearningSettings, magnitudes};
use crate::demonstration::{Dataset, Demonstration, DemonstrationError, Fault, Trajectory};
use crate::math::SmoothingDerivative;

/// One demonstration, ready to be learned from.
pub(super) struct Prepared {
    /// Its length (s).
    pub(super) duration_s: f64,
    /// Parameters of the motion model (p).
    pub(super) theta_m: DVector<f64>,
    /// Parameters of the force model.
    pub(super) theta_f: DVector<f64>,
    /// Time fractions (T), 0 to 1.
    pub(super) fractions: Vec<f64>,
    /// Forcing targets (T x d).
    pub(super) forcing: DMatrix<f64>,
    /// Wrenches (T x w).
    pub(super) wrench: DMatrix<f64>,
    /// First and last smoothed position (d).
    pub(super) start: DVector<f64>,
    pub(super) goal: DVector<f64>,
    /// Estimated variance of the sensor's noise in the forcing targets (d; squared unit of the column).
    pub(super) noise: DVector<f64>,
    /// Orientation and gripper as recorded, at the learning rate.
    pub(super) trajectory: Trajectory,
    /// Longest time without a sample (s).
    pub(super) largest_gap_s: f64,
    /// Window over which the movement was smoothed and differentiated (s).
    pub(super) window_s: f64,
}

/// What the motion model learns from: phase input and forcing targets (4) of every demonstration.
///
/// # Errors
/// When settings are outside their ranges or the dataset is not usable.
pub fn motion_sequences(dataset: &Dataset, settings: &LearningSettings) -> Result<Vec<Sequence>, LearningError> {
    settings.check()?;
    dataset.check()?;
    Ok(prepare(dataset, settings)?.iter().map(|prepared| prepared.motion_sequence(settings)).collect())
}

/// All demonstrations of a dataset.
pub(super) fn prepare(dataset: &Dataset, settings: &LearningSettings) -> Result<Vec<Prepared>, LearningError> {
    let faults: Vec<Fault> = dataset.demonstrations.iter().filter_map(|d| too_short(d, settings)).collect();
    if !faults.is_empty() {
        return Err(DemonstrationError::Invalid(faults).into());
    }
    magnitudes::check(dataset, settings.rate_hz)?;
    dataset.demonstrations.iter().map(|d| prepare_one(d, dataset, settings)).collect()
}

/// The fewest samples that can be differentiated twice.
fn fewest_samples(settings: &LearningSettings) -> usize {
    (settings.smoothing_degree + 2) | 1
}

fn too_short(demonstration: &Demonstration, settings: &LearningSettings) -> Option<Fault> {
    let (samples, least) = (demonstration.trajectory.samples(), fewest_samples(settings));
    let expected = format!("at least {least}: the forcing term (4) differentiates them twice");
    let found = if samples == 1 { "1 sample".to_owned() } else { format!("{samples} samples") };
    (samples < least).then(|| Fault { place: demonstration.name.clone(), found, expected, ..Fault::default() })
}

impl Prepared {
    /// Phase input and forcing targets, as the motion model sees them.
    pub(super) fn motion_sequence(&self, settings: &LearningSettings) -> Sequence {
        self.sequence(&self.forcing, &self.theta_m, settings)
    }

    /// Phase input and wrenches, as the force model sees them.
    pub(super) fn force_sequence(&self, settings: &LearningSettings) -> Sequence {
        self.sequence(&self.wrench, &self.theta_f, settings)
    }

    fn sequence(&self, columns: &DMatrix<f64>, theta: &DVector<f64>, settings: &LearningSettings) -> Sequence {
        let mut values = Vec::with_capacity(columns.len() + self.fractions.len());
        for (u, row) in self.fractions.iter().zip(columns.row_iter()) {
            values.push(settings.phase_input.at(*u, settings.alpha));
            values.extend(row.iter());
        }
        Sequence { values, dimension: columns.ncols() + 1, theta: theta.clone() }
    }
}

fn prepare_one(demonstration: &Demonstration, dataset: &Dataset, settings: &LearningSettings) -> Result<Prepared, LearningError> {
    let trajectory = &demonstration.trajectory;
    let uniform = trajectory.resampled(1.0 / step_s(trajectory))?;
    let forcing = forcing_targets(&demonstration.name, &uniform, dataset, settings)?;
    let learned = trajectory.resampled(settings.rate_hz)?;
    let last = (learned.samples() - 1) as f64;
    let values = |theta: &[(String, f64)]| DVector::from_iterator(theta.len(), theta.iter().map(|(_, value)| *value));
    Ok(Prepared {
        duration_s: trajectory.duration_s(),
        theta_m: values(&demonstration.theta_m),
        theta_f: values(&demonstration.theta_f),
        fractions: (0..learned.samples()).map(|t| t as f64 / last).collect(),
        forcing: resampled_rows(&forcing.targets, learned.samples()),
        wrench: learned.select(&dataset.wrench)?,
        start: forcing.start,
        goal: forcing.goal,
        noise: forcing.noise,
        trajectory: learned,
        largest_gap_s: trajectory.largest_gap_s(),
        window_s: forcing.window_s,
    })
}

struct Forcing {
    targets: DMatrix<f64>,
    start: DVector<f64>,
    goal: DVector<f64>,
    noise: DVector<f64>,
    window_s: f64,
}

fn forcing_targets(name: &str, uniform: &Trajectory, dataset: &Dataset, settings: &LearningSettings) -> Result<Forcing, LearningError> {
    let (samples, step) = (uniform.samples(), uniform.duration_s() / (uniform.samples() - 1) as f64);
    let wanted = ((settings.smoothing_window_s / step / 2.0).round() as usize) * 2 + 1;
    let least = fewest_samples(settings);
    let window = wanted.clamp(least, least.max((samples - 1) | 1));
    let filter = SmoothingDerivative::new(step, window, settings.smoothing_degree)?;
    if samples < window {
        return Err(LearningError::Data(format!("{name}: {samples} samples, but differentiating twice needs at least {window}")));
    }
    let omega = settings.stiffness.sqrt() / uniform.duration_s();
    let gain = filter.noise_gain_of([1.0, 2.0 / omega, 1.0 / (omega * omega)]);
    let positions = uniform.select(&dataset.motion)?;
    let d = positions.ncols();
    let zero = DVector::zeros(d);
    let targets = DMatrix::zeros(samples, d);
    let window_s = window as f64 * step;
    let mut forcing = Forcing { targets, start: zero.clone(), goal: zero.clone(), noise: zero, window_s };
    for j in 0..d {
        let raw = positions.column(j).into_owned();
        if stands_still(raw.as_slice()) {
            // Nothing forces it; the filter would leave rounding, which models would take for movement.
            (forcing.start[j], forcing.goal[j]) = (raw[0], raw[0]);
            continue;
        }
        let smooth = filter.apply(raw.as_slice())?;
        let (start, goal) = (smooth.value[0], smooth.value[samples - 1]);
        for t in 0..samples {
            let phase = (-settings.alpha * t as f64 / (samples - 1) as f64).exp();
            let motion = [smooth.value[t], smooth.first[t], smooth.second[t]];
            forcing.targets[(t, j)] = forcing_target(motion, start, goal, phase, omega);
        }
        let rest: f64 = raw.iter().zip(&smooth.value).map(|(x, y)| (x - y).powi(2)).sum::<f64>() / samples as f64;
        // What a filter of gain g leaves of white noise of variance v is (1 - g) v.
        forcing.noise[j] = gain * rest / (1.0 - filter.noise_gain()[0]);
        (forcing.start[j], forcing.goal[j]) = (start, goal);
    }
    Ok(forcing)
}

/// Change of a column relative to its magnitude below which it is rounding (-).
const ROUNDING: f64 = 1e-12;

fn stands_still(values: &[f64]) -> bool {
    let (least, most) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(*x), b.max(*x)));
    most - least <= ROUNDING * least.abs().max(most.abs())
}

/// How many times as many samples as were recorded a movement is differentiated at, at most (-).
const DENSEST: f64 = 10.0;

/// The time between samples at which a movement is differentiated (s): the median of those recorded. Where samples come in bursts, that is the
/// time inside a burst, and counts for no less than a part of the mean.
fn step_s(trajectory: &Trajectory) -> f64 {
    let mut steps: Vec<f64> = trajectory.times_s().windows(2).map(|t| t[1] - t[0]).collect();
    steps.sort_by(f64::total_cmp);
    steps[steps.len() / 2].max(trajectory.duration_s() / steps.len() as f64 / DENSEST)
}

/// The same rows over the same time, `samples` of them, linear in between.
fn resampled_rows(rows: &DMatrix<f64>, samples: usize) -> DMatrix<f64> {
    let scale = (rows.nrows() - 1) as f64 / (samples - 1) as f64;
    DMatrix::from_fn(samples, rows.ncols(), |t, j| {
        let at = t as f64 * scale;
        let before = (at.floor() as usize).min(rows.nrows() - 2);
        let fraction = at - before as f64;
        rows[(before, j)] * (1.0 - fraction) + rows[(before + 1, j)] * fraction
    })
}
