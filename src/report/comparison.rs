//! What several methods made of the same settings, side by side: plain data, and a table of it for people.

use serde::Serialize;

use super::table::figure;

/// Methods beside each other.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ComparisonReport {
    /// Every setting, with what each method made of it.
    pub settings: Vec<SettingReport>,
    /// Every method over all settings.
    pub methods: Vec<MethodSummary>,
}

/// One setting.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SettingReport {
    /// Its name: unique in the comparison.
    pub name: String,
    /// `taught`, `new` (between the demonstrated ones) or `beyond` (outside of them).
    pub kind: &'static str,
    /// Clearance of the ideal path (m).
    pub ideal_clearance_m: Option<f64>,
    /// The method with the largest clearance; `null` when two have it.
    pub winner: Option<String>,
    /// What each method made of it, in the order of [`ComparisonReport::methods`].
    pub results: Vec<MethodResult>,
}

/// What one method made of one setting.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MethodResult {
    /// The method.
    pub method: String,
    /// Smallest distance of the path to the obstacle (m): negative where the path is inside, by the depth. `null` without a path.
    pub clearance_m: Option<f64>,
    /// Whether the path touches the obstacle.
    pub collides: bool,
    /// On which side it passes, where that is a question: `left` or `right`.
    pub side: Option<&'static str>,
}

/// One method over all settings.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MethodSummary {
    /// The method.
    pub method: String,
    /// Settings in which it collides or has no path.
    pub collisions: usize,
    /// Settings in which it has the largest clearance.
    pub wins: usize,
    /// Its smallest clearance (m).
    pub worst_clearance_m: Option<f64>,
}

impl ComparisonReport {
    /// From settings whose results stand in one order of methods. Winners and summaries follow from them.
    #[must_use]
    pub fn of(mut settings: Vec<SettingReport>) -> Self {
        for setting in &mut settings {
            setting.winner = winner(&setting.results);
        }
        let names = settings.first().map_or(&[][..], |setting| &setting.results);
        let methods = names.iter().enumerate().map(|(index, result)| summary(&result.method, index, &settings)).collect();
        Self { settings, methods }
    }
}

/// Clearances nearer to each other than this are a draw (m): no reader of a figure could tell them apart.
const DRAW_M: f64 = 1e-6;

fn winner(results: &[MethodResult]) -> Option<String> {
    let mut ranked: Vec<(f64, &str)> = results.iter().filter_map(|result| Some((result.clearance_m?, result.method.as_str()))).collect();
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0));
    match ranked[..] {
        [(first, _), (second, _), ..] if first - second < DRAW_M => None,
        [(_, method), ..] => Some(method.to_owned()),
        [] => None,
    }
}

fn summary(method: &str, index: usize, settings: &[SettingReport]) -> MethodSummary {
    let results = || settings.iter().filter_map(|setting| setting.results.get(index));
    let clearances = results().filter_map(|result| result.clearance_m);
    MethodSummary {
        method: method.to_owned(),
        collisions: results().filter(|result| result.collides || result.clearance_m.is_none()).count(),
        wins: settings.iter().filter(|setting| setting.winner.as_deref() == Some(method)).count(),
        worst_clearance_m: clearances.reduce(f64::min),
    }
}

/// The table: one row per setting, one column per method, `*` at the winner, `!` at a collision.
pub(super) fn table(comparison: &ComparisonReport) -> Vec<String> {
    let heads = ["setting", "", "ideal"].map(str::to_owned).into_iter().chain(comparison.methods.iter().map(|m| m.method.clone()));
    let mut rows: Vec<Vec<String>> = vec![heads.collect()];
    for setting in &comparison.settings {
        let metres = |value: Option<f64>| value.map_or("-".to_owned(), |value| format!("{} m", figure(value)));
        let cell = |result: &MethodResult| {
            let won = setting.winner.as_ref() == Some(&result.method);
            let side = result.side.map_or(String::new(), |side| format!(" {side}"));
            let flags = format!("{}{}", if result.collides { "!" } else { " " }, if won { "*" } else { " " });
            format!("{}{side} {flags}", metres(result.clearance_m))
        };
        let start = [setting.name.clone(), setting.kind.to_owned(), metres(setting.ideal_clearance_m)];
        rows.push(start.into_iter().chain(setting.results.iter().map(cell)).collect());
    }
    let totals = comparison.methods.iter().map(|m| format!("{} wins, {} collisions", m.wins, m.collisions));
    rows.push(["all", "", ""].map(str::to_owned).into_iter().chain(totals).collect());
    let columns = rows[0].len();
    let widths: Vec<usize> =
        (0..columns).map(|column| rows.iter().filter_map(|row| row.get(column)).map(|c| c.chars().count()).max().unwrap_or(0)).collect();
    let pad = |(column, cell): (usize, &String)| {
        let width = widths.get(column).copied().unwrap_or(0);
        if column < 2 { format!("{cell:<width$}") } else { format!("{cell:>width$}") }
    };
    let line = |row: &Vec<String>| format!("  {}", row.iter().enumerate().map(pad).collect::<Vec<_>>().join("  ")).trim_end().to_owned();
    let note = "  clearance to the obstacle; * the largest, ! a collision".to_owned();
    rows.iter().map(line).chain([note]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn setting(name: &str, clearances: [Option<f64>; 2]) -> SettingReport {
        let result = |(method, clearance_m): (&str, Option<f64>)| MethodResult {
            method: method.to_owned(),
            clearance_m,
            collides: clearance_m.is_some_and(|clearance| clearance <= 0.0),
            side: None,
        };
        let results = ["CPDMP", "LWR-DMP"].into_iter().zip(clearances).map(result).collect();
        SettingReport { name: name.to_owned(), kind: "new", ideal_clearance_m: Some(1.0), winner: None, results }
    }

    #[test]
    fn the_largest_clearance_wins_whoever_has_it() {
        let settings =
            [("a", [Some(0.9), Some(-0.2)]), ("b", [Some(0.5), Some(0.8)]), ("c", [Some(0.7), Some(0.7)]), ("d", [None, Some(-1.0)])];
        let comparison = ComparisonReport::of(settings.map(|(name, clearances)| setting(name, clearances)).into());
        let winners: Vec<Option<&str>> = comparison.settings.iter().map(|setting| setting.winner.as_deref()).collect();
        assert_eq!(winners, [Some("CPDMP"), Some("LWR-DMP"), None, Some("LWR-DMP")]);
        let [ours, rival] = &comparison.methods[..] else { panic!("two methods") };
        assert_eq!((ours.wins, ours.collisions, ours.worst_clearance_m), (1, 1, Some(0.5)));
        assert_eq!((rival.wins, rival.collisions, rival.worst_clearance_m), (2, 2, Some(-1.0)));
        let lines = table(&comparison);
        assert!(lines[1].contains("0.9 m  *") && lines[1].ends_with("-0.2 m !"), "{}", lines[1]);
        assert!(lines[2].contains("0.5 m   ") && lines[2].ends_with("0.8 m  *"), "{}", lines[2]);
    }
}
