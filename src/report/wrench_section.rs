//! How far the wrench that a force model expects is from what was felt, as `learn` tells it.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Serialize;

use super::table::{figure, table};
use crate::learning::selection::{CrossValidation, ErrorSize, HeldOut, Reproduction, wrench_error_over};

/// The error of the expected wrench against one demonstration, at equal time fractions.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct WrenchRow {
    /// The demonstration; none for all of them together.
    pub demonstration: Option<String>,
    /// Which demonstrations were left out together, counted from 0; none where nothing was.
    pub fold: Option<usize>,
    /// How far its `theta_f` lies outside what was learned from; none for a single value, and where nothing was left out.
    pub extrapolation: Option<f64>,
    /// Every wrench column; its name ends with its unit. Over all demonstrations the mean of rms and the largest of max.
    pub columns: BTreeMap<String, WrenchErrorSize>,
}

/// The error of one wrench column (unit of the column).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct WrenchErrorSize {
    /// Root mean square over the movement.
    pub rms: f64,
    /// Largest.
    pub max: f64,
}

/// The wrench of every demonstration, expected by skills that were learned without its `theta_f`; without its `theta_m` when all share
/// `theta_f`.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct WrenchValidation {
    /// How many groups were left out in turn.
    pub folds: usize,
    /// Every demonstration.
    pub demonstrations: Vec<WrenchRow>,
    /// Mean rms and largest error over all demonstrations.
    pub overall: WrenchRow,
}

impl WrenchRow {
    fn of(demonstration: Option<&str>, names: &[String], error: &[ErrorSize]) -> Self {
        let size = |size: &ErrorSize| WrenchErrorSize { rms: size.rms, max: size.max };
        let columns = names.iter().zip(error).map(|(name, error)| (name.clone(), size(error))).collect();
        Self { demonstration: demonstration.map(str::to_owned), fold: None, extrapolation: None, columns }
    }

    /// A row for each demonstration, and the one over all; nothing without wrench columns.
    pub fn reproduction(names: &[String], all: &[Reproduction]) -> (Vec<Self>, Option<Self>) {
        if names.is_empty() {
            return (Vec::new(), None);
        }
        let rows = all.iter().map(|one| Self::of(Some(&one.demonstration), names, &one.wrench)).collect();
        let over = wrench_error_over(&all.iter().map(|one| one.wrench.as_slice()).collect::<Vec<_>>());
        (rows, Some(Self::of(None, names, &over)))
    }
}

impl WrenchValidation {
    /// From what cross-validation found for the wrench columns of these names; `None` without a force model.
    pub fn of(names: &[String], found: &CrossValidation) -> Option<Self> {
        let row = |held: &HeldOut| {
            let force = held.force.as_ref()?;
            let extrapolation = Some(force.extrapolation).filter(|ratio| ratio.is_finite());
            Some(WrenchRow { fold: Some(force.fold), extrapolation, ..WrenchRow::of(Some(&held.demonstration), names, &force.wrench) })
        };
        let demonstrations = found.held_out.iter().map(row).collect::<Option<Vec<_>>>()?;
        Some(Self { folds: found.force_folds, demonstrations, overall: WrenchRow::of(None, names, &found.wrench()) })
    }

    /// The section as lines of text.
    pub fn lines(&self) -> Vec<String> {
        let outside = |row: &WrenchRow| match (row.fold, row.extrapolation) {
            (None, _) => String::new(),
            (_, None) => "∞".to_owned(),
            (_, Some(ratio)) => format!("{:.0} %", 100.0 * ratio),
        };
        let mut lines = vec![format!("Cross-validation of the expected wrench: {} times learned without what is predicted", self.folds)];
        lines.extend(rows_of(
            ["left out", "outside"].map(str::to_owned).to_vec(),
            self.demonstrations.iter().chain([&self.overall]),
            |row| vec![outside(row)],
        ));
        lines
    }
}

/// What the last row of a table of errors is called: means of the rms errors, the largest of the largest.
pub(super) const ALL: &str = "all: mean, largest";

/// A table of rows: names, what else is told before the errors, and the errors; `first` is the heading up to there.
pub(super) fn rows_of<'a>(
    mut first: Vec<String>,
    rows: impl Iterator<Item = &'a WrenchRow> + Clone,
    also: impl Fn(&WrenchRow) -> Vec<String>,
) -> Vec<String> {
    let names = rows.clone().next().into_iter().flat_map(|row| row.columns.keys());
    first.extend(names.flat_map(|name| [format!("rms {name}"), format!("max {name}")]));
    let row = |row: &WrenchRow| {
        let mut cells = vec![row.demonstration.clone().unwrap_or_else(|| ALL.to_owned())];
        cells.extend(also(row));
        cells.extend(row.columns.values().flat_map(|size| [figure(size.rms), figure(size.max)]));
        cells
    };
    table(&std::iter::once(first).chain(rows.map(row)).collect::<Vec<_>>())
}
