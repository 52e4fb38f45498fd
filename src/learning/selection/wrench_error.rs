//! How far the wrench that a skill expects is from a demonstration.

use super::super::{LearningError, Skill};
use super::ErrorSize;
use super::movement_error::on_the_grid;
use crate::demonstration::Demonstration;

/// The error of `F_des(theta_f, s)` of `skill`, for the demonstration's own `theta_f`, against the wrench that was shown, at equal time
/// fractions: per column of the force model (w; unit of the column); none without a force model.
///
/// # Errors
/// When the demonstration lacks a column or parameter of the force model.
pub fn wrench_error(skill: &Skill, demonstration: &Demonstration) -> Result<Vec<ErrorSize>, LearningError> {
    let Some(force) = &skill.force else { return Ok(Vec::new()) };
    let shown = on_the_grid(&demonstration.trajectory)?.select(&force.columns)?;
    let last = (shown.nrows() - 1) as f64;
    let fractions: Vec<f64> = (0..shown.nrows()).map(|i| i as f64 / last).collect();
    let off = skill.expected_wrench(&demonstration.theta_f, &fractions)? - shown;
    Ok(off.column_iter().map(|column| ErrorSize::of(column.iter().copied())).collect())
}

/// Mean of the root mean squares and largest of the largest, per column, over several demonstrations; none for no demonstration.
#[must_use]
pub fn wrench_error_over(errors: &[&[ErrorSize]]) -> Vec<ErrorSize> {
    let w = errors.first().map_or(0, |first| first.len());
    (0..w).map(|j| ErrorSize::over(&errors.iter().map(|error| error[j]).collect::<Vec<_>>())).collect()
}
