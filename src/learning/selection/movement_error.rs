//! How far a movement is from a demonstration.

use nalgebra::DMatrix;

use super::super::cpdmp::spatial_columns;
use super::super::{ExecutionSettings, LearningError, Skill, generate};
use crate::demonstration::Trajectory;

/// Root mean square and largest value of an error over a movement (unit of the column, or as said where it is used).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ErrorSize {
    /// Root mean square over the movement.
    pub rms: f64,
    /// Largest.
    pub max: f64,
}

impl ErrorSize {
    pub(super) fn of(errors: impl Iterator<Item = f64>) -> Self {
        let (mut squares, mut max, mut count) = (0.0, 0.0f64, 0.0);
        for e in errors {
            squares += e * e;
            max = max.max(e.abs());
            count += 1.0;
        }
        Self { rms: (squares / f64::max(count, 1.0)).sqrt(), max }
    }

    /// Mean of the root mean squares and the largest of the largest, over several movements; zero for none.
    #[must_use]
    pub fn over(errors: &[Self]) -> Self {
        let rms = errors.iter().map(|e| e.rms).sum::<f64>() / errors.len().max(1) as f64;
        Self { rms, max: errors.iter().map(|e| e.max).fold(0.0, f64::max) }
    }
}

/// The error of one movement against one demonstration, at equal time fractions.
#[derive(Debug, Clone, PartialEq)]
pub struct MovementError {
    /// Per motion column (d; unit of the column).
    pub columns: Vec<ErrorSize>,
    /// Euclidean distance over the spatial columns: those in m, or all when none is.
    pub path: ErrorSize,
    /// Angle between the orientations (rad), when both have one.
    pub orientation_rad: Option<ErrorSize>,
    /// Difference between the gripper's openings (-), when both have one.
    pub gripper: Option<ErrorSize>,
}

/// Intervals of the grid of time fractions on which movements are compared.
const INTERVALS: f64 = 400.0;

impl MovementError {
    /// The error of what `skill` does for these settings against `shown`.
    ///
    /// # Errors
    /// When the skill cannot do it.
    pub fn of(skill: &Skill, settings: &ExecutionSettings, shown: &Trajectory) -> Result<Self, LearningError> {
        let duration = settings.duration_s.unwrap_or(skill.motion.duration_s);
        let moved = generate(skill, settings, duration / INTERVALS, 1.0)?;
        Self::between(&moved, shown, &skill.motion.columns)
    }

    /// The error between two movements over these motion columns; each is read at the same time fractions.
    ///
    /// # Errors
    /// When a column is missing.
    pub fn between(a: &Trajectory, b: &Trajectory, columns: &[String]) -> Result<Self, LearningError> {
        let (a, b) = (on_the_grid(a)?, on_the_grid(b)?);
        let off: DMatrix<f64> = a.select(columns)? - b.select(columns)?;
        let spatial = spatial_columns(columns);
        let distance = |t: usize| spatial.iter().map(|j| off[(t, *j)].powi(2)).sum::<f64>().sqrt();
        let turns = a.orientations().zip(b.orientations());
        let openings = a.gripper().zip(b.gripper());
        Ok(Self {
            columns: off.column_iter().map(|column| ErrorSize::of(column.iter().copied())).collect(),
            path: ErrorSize::of((0..off.nrows()).map(distance)),
            orientation_rad: turns.map(|(a, b)| ErrorSize::of(a.iter().zip(&b).map(|(a, b)| a.angle_to(b)))),
            gripper: openings.map(|(a, b)| ErrorSize::of((a - b).iter().copied())),
        })
    }

    /// Mean of the root mean squares and largest of the largest over several movements of the same columns; `None` for no movement.
    #[must_use]
    pub fn over(errors: &[&Self]) -> Option<Self> {
        let d = errors.first()?.columns.len();
        let size = |of: &dyn Fn(&Self) -> ErrorSize| ErrorSize::over(&errors.iter().map(|e| of(e)).collect::<Vec<_>>());
        let of_all = |of: fn(&Self) -> Option<ErrorSize>| {
            let sizes: Option<Vec<ErrorSize>> = errors.iter().map(|e| of(e)).collect();
            sizes.map(|sizes| ErrorSize::over(&sizes))
        };
        Some(Self {
            columns: (0..d).map(|j| size(&|e| e.columns[j])).collect(),
            path: size(&|e| e.path),
            orientation_rad: of_all(|e| e.orientation_rad),
            gripper: of_all(|e| e.gripper),
        })
    }
}

/// A movement at the time fractions at which movements are compared.
pub(super) fn on_the_grid(trajectory: &Trajectory) -> Result<Trajectory, LearningError> {
    Ok(trajectory.resampled(INTERVALS / trajectory.duration_s())?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shifted_line_is_off_by_the_shift_whatever_its_speed_and_rate() {
        let columns = ["x_m", "q_rad", "gripper"].map(str::to_owned);
        let line = |samples: usize, duration: f64, shift: f64| {
            let u = |t: usize| t as f64 / (samples - 1) as f64;
            let values = DMatrix::from_fn(samples, 3, |t, j| [u(t) + shift, 2.0 * u(t), 0.5 + shift][j]);
            Trajectory::new((0..samples).map(|t| duration * u(t)).collect(), columns.to_vec(), values).unwrap()
        };
        let error = MovementError::between(&line(11, 3.0, 0.25), &line(1000, 0.7, 0.0), &columns[..2]).unwrap();
        assert!((error.path.rms - 0.25).abs() < 1e-12 && (error.path.max - 0.25).abs() < 1e-12);
        assert!(error.columns[1].max < 1e-12 && error.orientation_rad.is_none());
        assert!(error.gripper.is_some_and(|off| (off.rms - 0.25).abs() < 1e-12 && (off.max - 0.25).abs() < 1e-12));
        let both = MovementError::over(&[&error, &error]).unwrap();
        assert!((both.path.rms - 0.25).abs() < 1e-12);
    }
}
