//! What several methods made of the same settings, side by side: plain data, and a table of it for people.

use schemars::JsonSchema;
use serde::Serialize;

use super::table::figure;
use crate::planar::{Case, Guidance, Method, Movement, PlanarOutcome};

/// Methods beside each other.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ComparisonReport {
    /// Every setting, with what each method made of it.
    pub settings: Vec<SettingReport>,
    /// Every method over all settings that are judged for it.
    pub methods: Vec<MethodSummary>,
}

/// One setting.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct SettingReport {
    /// Its name.
    pub name: String,
    /// What the models are told beside the shape of the task: `one_side`, `with_side` or `without_side`.
    pub guidance: &'static str,
    /// `taught`, `new` (between the demonstrated ones) or `beyond` (outside of them).
    pub kind: &'static str,
    /// How far it lies outside what was demonstrated, as a fraction of its range; 0 inside.
    pub extrapolation: Option<f64>,
    /// Clearance of the ideal path (m): the smaller one where there are two.
    pub ideal_clearance_m: Option<f64>,
    /// The method that keeps most of the ideal clearance on every side asked for; `null` when every method fails on one.
    pub winner: Option<&'static str>,
    /// Every movement of every method.
    pub results: Vec<MovementReport>,
}

/// One movement of one method in one setting.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct MovementReport {
    /// The method.
    pub method: &'static str,
    /// Which state chain, counted from 0, where the method is reproduced chain by chain.
    pub chain: Option<usize>,
    /// Smallest distance of the path to the obstacle (m); negative is the depth of penetration.
    pub clearance_m: Option<f64>,
    /// Whether the path touches the obstacle.
    pub collides: bool,
    /// On which side it passes: `left` or `right`; `null` when it never comes that far.
    pub side: Option<&'static str>,
    /// Root mean square distance from the ideal path (m).
    pub path_error_m: Option<f64>,
    /// Distance from the end to the goal (m).
    pub goal_error_m: Option<f64>,
}

/// One method over all settings.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct MethodSummary {
    /// The method.
    pub method: &'static str,
    /// What its model was told.
    pub guidance: &'static str,
    /// Movements that it made.
    pub movements: usize,
    /// Those that collide.
    pub collisions: usize,
    /// Settings that it wins.
    pub wins: usize,
    /// Its smallest clearance (m).
    pub worst_clearance_m: Option<f64>,
}

impl ComparisonReport {
    /// The comparison of an experiment.
    #[must_use]
    pub fn of(outcome: &PlanarOutcome) -> Self {
        let mut methods: Vec<MethodSummary> = Vec::new();
        for guidance in [Guidance::OneSide, Guidance::WithSide, Guidance::WithoutSide] {
            let cases: Vec<&Case> = outcome.cases_with(guidance).collect();
            methods.extend(methods_of(&cases).into_iter().map(|method| summary(method, guidance, &cases)));
        }
        Self { settings: outcome.cases.iter().map(setting).collect(), methods }
    }
}

/// The methods of some cases, each once, in their order.
fn methods_of(cases: &[&Case]) -> Vec<Method> {
    let mut methods: Vec<Method> = cases.iter().flat_map(|case| &case.movements).map(|movement| movement.method).collect();
    methods.sort();
    methods.dedup();
    methods
}

fn finite(number: f64) -> Option<f64> {
    number.is_finite().then_some(number)
}

fn setting(case: &Case) -> SettingReport {
    SettingReport {
        name: case.name.clone(),
        guidance: case.guidance.key(),
        kind: case.novelty().name(),
        extrapolation: finite(case.extrapolation),
        ideal_clearance_m: case.ideals.iter().map(|ideal| ideal.clearance_m).reduce(f64::min),
        winner: case.winner.map(Method::key),
        results: case.movements.iter().map(movement).collect(),
    }
}

fn movement(movement: &Movement) -> MovementReport {
    MovementReport {
        method: movement.method.key(),
        chain: movement.chain,
        clearance_m: finite(movement.clearance_m),
        collides: movement.collides,
        side: movement.side.map(|side| side.key()),
        path_error_m: finite(movement.path_error_m),
        goal_error_m: finite(movement.goal_error_m),
    }
}

fn summary(method: Method, guidance: Guidance, cases: &[&Case]) -> MethodSummary {
    let movements = || cases.iter().flat_map(|case| case.of(method));
    MethodSummary {
        method: method.key(),
        guidance: guidance.key(),
        movements: movements().count(),
        collisions: movements().filter(|movement| movement.collides).count(),
        wins: cases.iter().filter(|case| case.winner == Some(method)).count(),
        worst_clearance_m: movements().map(|movement| movement.clearance_m).reduce(f64::min).and_then(finite),
    }
}

/// The tables, one for each thing that models can be told: a row per setting, a column per method.
pub(super) fn table(comparison: &ComparisonReport) -> Vec<String> {
    let mut lines = Vec::new();
    for guidance in ["one_side", "with_side", "without_side"] {
        let methods: Vec<&MethodSummary> = comparison.methods.iter().filter(|method| method.guidance == guidance).collect();
        let settings = comparison.settings.iter().filter(|setting| setting.guidance == guidance);
        let mut rows: Vec<Vec<String>> = settings.map(|setting| row(setting, &methods)).collect();
        if rows.is_empty() {
            continue;
        }
        let heads = ["setting", guidance, "ideal"].into_iter().chain(methods.iter().map(|method| method.method));
        rows.insert(0, heads.map(|head| head.replace('_', " ")).collect());
        let totals = methods.iter().map(|method| format!("{} won, {} of {} collide", method.wins, method.collisions, method.movements));
        rows.push(["all", "", ""].map(str::to_owned).into_iter().chain(totals).collect());
        lines.extend(aligned(&rows));
    }
    lines.push("  clearance to the obstacle in m; * wins, ! collides".to_owned());
    lines
}

fn row(setting: &SettingReport, methods: &[&MethodSummary]) -> Vec<String> {
    let metres = |value: Option<f64>| value.map_or("-".to_owned(), figure);
    let cell = |method: &&MethodSummary| {
        let of = setting.results.iter().filter(|result| result.method == method.method);
        let each = of.map(|result| {
            let side = if setting.guidance == "one_side" { "" } else { result.side.unwrap_or("no side") };
            format!(
                "{}{}{side}{}",
                metres(result.clearance_m),
                if side.is_empty() { "" } else { " " },
                if result.collides { "!" } else { "" }
            )
        });
        let won = if setting.winner == Some(method.method) { " *" } else { "  " };
        format!("{}{won}", each.collect::<Vec<_>>().join(", "))
    };
    let start = [setting.name.clone(), setting.kind.to_owned(), metres(setting.ideal_clearance_m)];
    start.into_iter().chain(methods.iter().map(cell)).collect()
}

/// Rows with columns as wide as their widest entry; numbers to the right.
fn aligned(rows: &[Vec<String>]) -> Vec<String> {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let pad = |(column, cell): (usize, &String)| {
        let width = widths[column];
        if column < 2 { format!("{cell:<width$}") } else { format!("{cell:>width$}") }
    };
    let line = |row: &Vec<String>| format!("  {}", row.iter().enumerate().map(pad).collect::<Vec<_>>().join("  ")).trim_end().to_owned();
    rows.iter().map(line).collect()
}
