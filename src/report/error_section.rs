//! How far a skill is from demonstrations, as `learn` tells it.

use schemars::JsonSchema;
use serde::Serialize;

use super::WrenchValidation;
use super::table::{figure, table};
use super::wrench_section::ALL;
use crate::learning::selection::{CrossValidation, ErrorSize, MovementError, Reproduction};

/// The error of one movement against one demonstration, at equal time fractions.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ErrorRow {
    /// The demonstration; none for all of them together.
    pub demonstration: Option<String>,
    /// Root mean square of the distance over the spatial columns, or over all when none is in m; over all demonstrations the mean.
    pub rms: f64,
    /// Largest distance.
    pub max: f64,
    /// Root mean square per motion column (unit of the column).
    pub rms_columns: Vec<f64>,
    /// Largest per motion column.
    pub max_columns: Vec<f64>,
    /// Root mean square of the angle between the orientations (rad), when both have one.
    pub rms_orientation_rad: Option<f64>,
    /// Root mean square of the difference between the gripper's openings (0 closed, 1 open), when both have one.
    pub rms_gripper: Option<f64>,
}

/// One demonstration, predicted by skills that were learned without it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ValidationRow {
    /// The demonstration.
    pub demonstration: String,
    /// Which demonstrations were left out together, counted from 0.
    pub fold: usize,
    /// How far its parameters lie outside those that were learned from; none for a single value.
    pub extrapolation: Option<f64>,
    /// The skill, told parameters, start and goal.
    pub with_ends: ErrorRow,
    /// The skill, told the parameters alone.
    pub parameters_alone: ErrorRow,
    /// The baseline, told start and goal.
    pub lwr: ErrorRow,
}

/// A whole cross-validation.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ValidationSection {
    /// How many groups were left out in turn.
    pub folds: usize,
    /// Every demonstration.
    pub demonstrations: Vec<ValidationRow>,
    /// Mean rms and largest error over all demonstrations.
    pub with_ends: ErrorRow,
    /// The same.
    pub parameters_alone: ErrorRow,
    /// The same.
    pub lwr: ErrorRow,
    /// Which has the smaller mean rms with start and goal told: `cpdmp` or `lwr`.
    pub better: &'static str,
    /// How many demonstrations the skill predicts better than the baseline.
    pub demonstrations_won: usize,
    /// The wrench that the force model expects, when there is one; the baseline has none.
    pub wrench: Option<WrenchValidation>,
}

impl ErrorRow {
    /// One row.
    pub fn of(demonstration: Option<&str>, error: &MovementError) -> Self {
        let each = |of: fn(&ErrorSize) -> f64| error.columns.iter().map(of).collect();
        Self {
            demonstration: demonstration.map(str::to_owned),
            rms: error.path.rms,
            max: error.path.max,
            rms_columns: each(|size| size.rms),
            max_columns: each(|size| size.max),
            rms_orientation_rad: error.orientation_rad.map(|size| size.rms),
            rms_gripper: error.gripper.map(|size| size.rms),
        }
    }

    /// A row for each demonstration, and the one over all.
    pub fn reproduction(all: &[Reproduction]) -> (Vec<Self>, Option<Self>) {
        let rows = all.iter().map(|one| Self::of(Some(&one.demonstration), &one.error)).collect();
        let over = MovementError::over(&all.iter().map(|one| &one.error).collect::<Vec<_>>());
        (rows, over.map(|error| Self::of(None, &error)))
    }
}

/// The error of the orientation for people (deg).
pub(super) fn turn(error: &ErrorRow) -> Option<String> {
    error.rms_orientation_rad.map(|angle| figure(angle.to_degrees()))
}

/// The error of the gripper's opening for people.
pub(super) fn opening(error: &ErrorRow) -> Option<String> {
    error.rms_gripper.map(figure)
}

impl ValidationSection {
    /// From what cross-validation found, for wrench columns of these names; `None` when it found nothing.
    pub fn of(found: &CrossValidation, wrench: &[String]) -> Option<Self> {
        let row = |of: Option<MovementError>| of.map(|error| ErrorRow::of(None, &error));
        let (with_ends, lwr) = (row(found.with_ends())?, row(found.lwr())?);
        let demonstrations = found.held_out.iter().map(|held| ValidationRow {
            demonstration: held.demonstration.clone(),
            fold: held.fold,
            extrapolation: Some(held.extrapolation).filter(|ratio| ratio.is_finite()),
            with_ends: ErrorRow::of(None, &held.with_ends),
            parameters_alone: ErrorRow::of(None, &held.parameters_alone),
            lwr: ErrorRow::of(None, &held.lwr),
        });
        Some(Self {
            folds: found.folds,
            demonstrations: demonstrations.collect(),
            parameters_alone: row(found.parameters_alone())?,
            better: if with_ends.rms < lwr.rms { "cpdmp" } else { "lwr" },
            demonstrations_won: found.held_out.iter().filter(|held| held.with_ends.path.rms < held.lwr.path.rms).count(),
            with_ends,
            lwr,
            wrench: WrenchValidation::of(wrench, found),
        })
    }

    /// The section as lines of text; errors in `unit`.
    pub fn lines(&self, unit: &str) -> Vec<String> {
        let heading =
            ["left out", "outside", "rms", "max", "rms, parameters alone", "rms, LWR-DMP", "max, LWR-DMP", "better"].map(str::to_owned);
        let mut heading = heading.to_vec();
        for (name, has) in [("rms turn deg", turn(&self.with_ends)), ("rms gripper", opening(&self.with_ends))] {
            heading.extend(has.iter().flat_map(|_| [name.to_owned(), format!("{name}, LWR-DMP")]));
        }
        let better = |ours: f64, theirs: f64| if ours < theirs { "CPDMP" } else { "LWR-DMP" }.to_owned();
        let row = |name: &str, outside: String, ends: &ErrorRow, alone: &ErrorRow, lwr: &ErrorRow| {
            let numbers = [ends.rms, ends.max, alone.rms, lwr.rms, lwr.max].map(figure);
            let mut row = vec![name.to_owned(), outside];
            row.extend(numbers);
            row.push(better(ends.rms, lwr.rms));
            row.extend([turn(ends), turn(lwr), opening(ends), opening(lwr)].into_iter().flatten());
            row
        };
        let outside = |ratio: Option<f64>| ratio.map_or("∞".to_owned(), |ratio| format!("{:.0} %", 100.0 * ratio));
        let mut rows = vec![heading];
        rows.extend(
            self.demonstrations
                .iter()
                .map(|held| row(&held.demonstration, outside(held.extrapolation), &held.with_ends, &held.parameters_alone, &held.lwr)),
        );
        rows.push(row(ALL, String::new(), &self.with_ends, &self.parameters_alone, &self.lwr));
        let winner = if self.better == "cpdmp" { "the skill" } else { "the baseline LWR-DMP" };
        let mut lines = vec![format!("Cross-validation: error in {unit}, {} times learned without what is predicted", self.folds)];
        lines.extend(table(&rows));
        let (won, of) = (self.demonstrations_won, self.demonstrations.len());
        lines.push(format!("  {winner} predicts better on average; the skill does so for {won} of {of} demonstrations"));
        lines
    }
}
