//! What a skill would do: its path and its states in space, without forces and without a robot.

use nalgebra::{DMatrix, DVector};

use super::{ExecutionSettings, SkillExecution, StepInput};
use crate::demonstration::{GRIPPER_COLUMN, QUATERNION_COLUMNS, Trajectory};
use crate::learning::cpdmp::{CouplingSettings, segments};
use crate::learning::{LearningError, Skill};

/// The most samples one generated trajectory may have.
const MOST_SAMPLES: f64 = 1e7;

/// The longest step of a generated movement, times `omega` (-). At half of it a movement ends within 1e-3 of its size of where it should.
const LONGEST_STEP: f64 = 0.5;

/// The movement without forces: motion columns, orientation and gripper from the start to `until` times the duration (-, > 0; 1 for the
/// taught end, more to see it settle), sampled every `dt_s` (s, > 0; adjusted so that the last sample is the end), and integrated
/// in finer steps where that is too coarse for the spring.
///
/// # Errors
/// As [`SkillExecution::new`], or when `dt_s` or `until` are not positive or ask for more than 10 million samples.
pub fn generate(skill: &Skill, settings: &ExecutionSettings, dt_s: f64, until: f64) -> Result<Trajectory, LearningError> {
    let mut execution = free(skill, settings)?;
    let length = execution.duration_s() * until;
    let steps = (length / dt_s).round().max(1.0);
    if !(dt_s > 0.0 && until > 0.0 && steps < MOST_SAMPLES) {
        let asked = format!("{until} durations in steps of {dt_s} s");
        return Err(LearningError::Request(format!("{asked}: both must be positive, with fewer than 10 million steps")));
    }
    let dt = length / steps;
    // Samples may be far apart; what is integrated may not.
    let parts = (execution.omega() * dt / LONGEST_STEP).ceil().max(1.0);
    if steps * parts >= MOST_SAMPLES {
        return Err(LearningError::Request(format!("{until} durations take {:.1e} steps, more than 10 million", steps * parts)));
    }
    let mut columns = skill.motion.columns.clone();
    if skill.orientation.is_some() {
        columns.extend(QUATERNION_COLUMNS.map(str::to_owned));
    }
    if skill.gripper.is_some() {
        columns.push(GRIPPER_COLUMN.to_owned());
    }
    let samples = steps as usize + 1;
    let mut cells = Vec::with_capacity(samples * columns.len());
    for i in 0..samples {
        if i > 0 {
            (0..parts as usize).for_each(|_| _ = execution.step(&StepInput::of(dt / parts)));
        }
        let state = execution.state();
        cells.extend(state.position.iter());
        cells.extend(state.orientation.iter().flat_map(|q| q.coords.iter()));
        cells.extend(state.gripper.map(|g| g.clamp(0.0, 1.0)));
    }
    let times = (0..samples).map(|i| dt * i as f64).collect();
    Ok(Trajectory::new(times, columns.clone(), DMatrix::from_row_slice(samples, columns.len(), &cells))?)
}

/// One state of the motion model in space, for drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct TaskSpaceState {
    /// Its number.
    pub state: usize,
    /// Time fraction of its mean (-).
    pub u: f64,
    /// Standard deviation of that (-).
    pub u_deviation: f64,
    /// Where the movement is at that moment (d; unit of the motion columns).
    pub position: DVector<f64>,
    /// `Sigma_i` of the forcing term given the phase (d x d; squared unit): everything the model expects to vary there. The forcing term
    /// moves the spring's equilibrium one to one, so this is the spread of slow deviations of the position.
    pub predictive: DMatrix<f64>,
    /// `B_i` (d x d; squared unit): the part of it that demonstrations disagree about, which decides about compliance.
    pub between: DMatrix<f64>,
    /// -1 complies, 0 is stiff.
    pub beta: f64,
    /// Time fractions between which it is the most responsible state; `None` when it never is.
    pub active: Option<[f64; 2]>,
}

/// Every state of the motion model on the path for these settings; none for the baseline.
///
/// # Errors
/// As [`SkillExecution::new`].
pub fn task_space_states(skill: &Skill, settings: &ExecutionSettings) -> Result<Vec<TaskSpaceState>, LearningError> {
    /// Steps over the movement between which positions are interpolated.
    const STEPS: usize = 2000;
    let mut execution = free(skill, settings)?;
    let dt = execution.duration_s() / STEPS as f64;
    let mut path = vec![execution.state().position.clone()];
    path.extend((0..STEPS).map(|_| execution.step(&StepInput::of(dt)).position.clone()));
    let mut shaping = skill.motion.shaping_at(&skill.request(settings)?.theta)?;
    let segments = segments(&mut shaping);
    let Some((gmr, input)) = shaping.mixture() else { return Ok(Vec::new()) };
    let state = |i: usize| {
        let u = input.time_fraction(gmr.input_mean(i)[0], skill.motion.alpha).clamp(0.0, 1.0);
        let at = u * STEPS as f64;
        let before = (at as usize).min(STEPS - 1);
        let deviation = skill.motion.phmm().map_or(0.0, |phmm| phmm.covariances[i][(0, 0)].max(0.0).sqrt());
        let mut active = segments.iter().filter(|s| s.state == i).peekable();
        let start = active.peek().map(|s| s.start);
        TaskSpaceState {
            state: i,
            u,
            u_deviation: deviation / input.rate(u, skill.motion.alpha),
            position: path[before].lerp(&path[before + 1], at - before as f64),
            predictive: gmr.conditional_covariance(i).clone(),
            between: skill.compliance.between[i].clone(),
            beta: skill.compliance.beta[i],
            active: start.zip(active.last()).map(|(start, last)| [start, last.end]),
        }
    };
    Ok((0..gmr.components()).map(state).collect())
}

/// An execution on which no force acts.
fn free(skill: &Skill, settings: &ExecutionSettings) -> Result<SkillExecution, LearningError> {
    SkillExecution::new(skill, &ExecutionSettings { coupling: CouplingSettings::default(), ..settings.clone() })
}
