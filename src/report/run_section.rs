//! What a run folder holds, for people and for other programs.

use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;

use super::manifest::FORMAT;
use super::table::table;

/// A run as its folder tells it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct RunSection {
    /// Name of the scenario.
    pub scenario: String,
    /// Its seed.
    pub seed: u64,
    /// How it ended.
    pub outcome: String,
    /// Version of the program that made it.
    pub version: String,
    /// Hash over every body's state at every step.
    pub state_hash: Option<String>,
    /// The criteria: name, and whether it was as expected.
    pub criteria: Vec<CriterionLine>,
    /// Its files with their sizes.
    pub files: Vec<FileLine>,
}

/// One criterion.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CriterionLine {
    /// Its name.
    pub name: String,
    /// Whether it passed.
    pub passed: bool,
    /// Its value, when it has one.
    pub value: Option<f64>,
    /// Unit of the value.
    pub unit: String,
}

/// One file or folder of a run.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct FileLine {
    /// Its name.
    pub name: String,
    /// Its size (bytes); that of a folder is the sum of its files.
    pub bytes: u64,
}

impl RunSection {
    /// From `manifest.json` and `report.json` of a folder.
    ///
    /// # Errors
    /// What is missing in them, in words.
    pub fn of(folder: &Path, manifest: &Value, report: &Value) -> Result<Self, String> {
        if manifest["format"] != FORMAT {
            return Err(format!("manifest.json: \"format\" is {}, but must be \"{FORMAT}\"", manifest["format"]));
        }
        let text = |of: &Value, file: &str, key: &str| {
            of[key].as_str().map(str::to_owned).ok_or_else(|| format!("{file}: \"{key}\" is missing or no text"))
        };
        let criteria = report["criteria"].as_array().ok_or("report.json: \"criteria\" is missing or no list")?;
        let criterion = |one: &Value| CriterionLine {
            name: one["name"].as_str().unwrap_or_default().to_owned(),
            passed: one["passed"].as_bool().unwrap_or_default(),
            value: one["value"].as_f64(),
            unit: one["unit"].as_str().unwrap_or_default().to_owned(),
        };
        Ok(Self {
            scenario: text(report, "report.json", "scenario")?,
            seed: report["seed"].as_u64().ok_or("report.json: \"seed\" is missing or no whole number")?,
            outcome: text(report, "report.json", "outcome")?,
            version: text(manifest, "manifest.json", "version")?,
            state_hash: report["state_hash"].as_str().map(str::to_owned),
            criteria: criteria.iter().map(criterion).collect(),
            files: files(folder),
        })
    }

    /// The section as lines of text.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = vec![
            format!("  scenario     {}, seed {}", self.scenario, self.seed),
            format!("  outcome      {}", self.outcome.replace('_', " ")),
            format!("  made by      cpdmp {}", self.version),
        ];
        lines.extend(self.state_hash.iter().map(|hash| format!("  state hash   {hash}")));
        let criteria = self.criteria.iter().map(|one| {
            let value = one.value.map_or("-".to_owned(), |value| format!("{value:.4} {}", one.unit));
            vec![one.name.clone(), value, if one.passed { "passed" } else { "failed" }.to_owned()]
        });
        let files = self.files.iter().map(|file| vec![file.name.clone(), format!("{:.1} kB", file.bytes as f64 / 1e3)]);
        for part in [table(&criteria.collect::<Vec<_>>()), table(&files.collect::<Vec<_>>())].into_iter().filter(|part| !part.is_empty()) {
            lines.push(String::new());
            lines.extend(part);
        }
        lines
    }
}

fn files(folder: &Path) -> Vec<FileLine> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let line = |entry: std::fs::DirEntry| {
        let name = entry.file_name().to_string_lossy().into_owned();
        let path = entry.path();
        let inside = || std::fs::read_dir(&path).into_iter().flatten().flatten().filter_map(|file| file.metadata().ok());
        let bytes = if path.is_dir() { inside().map(|about| about.len()).sum() } else { entry.metadata().map_or(0, |about| about.len()) };
        FileLine { name: if path.is_dir() { name + "/" } else { name }, bytes }
    };
    let mut lines: Vec<FileLine> = entries.flatten().map(line).collect();
    lines.sort_by(|a, b| a.name.cmp(&b.name));
    lines
}
