//! Which scenario files the arguments mean.

use std::path::{Path, PathBuf};

use super::terminal::Terminal;
use crate::report::Outcome;

/// The files that the arguments name: a file itself, the scenarios of a folder, those that match a pattern. In the order of the arguments,
/// sorted within each, none twice. An argument that names nothing is reported, and the outcome says how the command ends.
pub(super) fn select(paths: &[PathBuf], terminal: &Terminal) -> Result<Vec<PathBuf>, Outcome> {
    let mut files: Vec<PathBuf> = Vec::new();
    let mut empty = false;
    for path in paths {
        let found = scenarios(path);
        if found.is_empty() {
            terminal.error(&format!("error: no scenarios: {} names no file that ends in .toml\n", path.display()));
            empty = true;
        }
        for file in found {
            if !files.contains(&file) {
                files.push(file);
            }
        }
    }
    if empty { Err(Outcome::NothingSelected) } else { Ok(files) }
}

/// The scenarios that one argument names.
pub(super) fn scenarios(path: &Path) -> Vec<PathBuf> {
    if !path.is_dir() && !is_pattern(path) {
        // A file that is not there is a fault of its own, told when it is read.
        return vec![path.to_path_buf()];
    }
    let is_scenario = |file: &PathBuf| {
        let is_toml = file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
        // The list of a dataset is no scenario, and lies in its folder by this name.
        is_toml && !file.is_dir() && file.file_name().is_none_or(|name| name != "dataset.toml")
    };
    entries(path).into_iter().filter(is_scenario).collect()
}

/// What one argument names: what is in a folder, what matches a pattern, or itself. Sorted.
pub(super) fn entries(path: &Path) -> Vec<PathBuf> {
    let mut found: Vec<PathBuf> = if path.is_dir() {
        std::fs::read_dir(path).into_iter().flatten().flatten().map(|entry| entry.path()).collect()
    } else if is_pattern(path) {
        glob::glob(&path.to_string_lossy()).into_iter().flatten().flatten().collect()
    } else {
        vec![path.to_path_buf()]
    };
    found.sort();
    found
}

/// Whether it is a pattern: nothing bears the name itself.
fn is_pattern(path: &Path) -> bool {
    !path.exists() && path.to_string_lossy().contains(['*', '?', '['])
}
