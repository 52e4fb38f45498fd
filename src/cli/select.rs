//! Which scenario files the arguments mean.

use std::ffi::OsStr;
use std::path::{Component, Path, PathBuf};

use glob::{MatchOptions, Pattern};
use walkdir::WalkDir;

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

/// The scenarios that one argument names: a file itself, those of a folder; of what matches a pattern, those that each match names.
pub(super) fn scenarios(path: &Path) -> Vec<PathBuf> {
    if is_pattern(path) {
        let mut found: Vec<PathBuf> =
            matching(path).iter().filter(|one| one.is_dir() || is_scenario(one)).flat_map(|one| scenarios(one)).collect();
        found.sort();
        found.dedup();
        return found;
    }
    if path.is_dir() {
        return inside(path).into_iter().filter(|file| is_scenario(file) && !file.is_dir()).collect();
    }
    // A file that is not there is a fault of its own, told when it is read.
    vec![path.to_path_buf()]
}

/// Whether it is named like a scenario. The list of a dataset is none, and lies in its folder by this name.
pub(super) fn is_scenario(file: &Path) -> bool {
    let is_toml = file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
    is_toml && file.file_name().is_none_or(|name| name != "dataset.toml")
}

/// What is in a folder, sorted. What is hidden, such as a run that is being written, is nobody's to find.
pub(super) fn inside(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut found: Vec<PathBuf> = entries.filter(|entry| !is_hidden(&entry.file_name())).map(|entry| entry.path()).collect();
    found.sort();
    found
}

/// Whether it is a pattern: nothing bears the name itself.
pub(super) fn is_pattern(path: &Path) -> bool {
    !path.exists() && has_wildcard(path.as_os_str())
}

/// What matches a pattern, sorted.
pub(super) fn matching(path: &Path) -> Vec<PathBuf> {
    let Ok(pattern) = Pattern::new(&path.to_string_lossy()) else { return Vec::new() };
    // What comes before the first part with a wildcard is where to look.
    let parts: Vec<Component<'_>> = path.components().collect();
    let fixed = parts.iter().take_while(|part| !has_wildcard(part.as_os_str())).count();
    let base: PathBuf = parts[..fixed].iter().collect();
    let start = if base.as_os_str().is_empty() { Path::new(".") } else { &base };
    let is_deep = parts.iter().any(|part| part.as_os_str() == "**");
    // As in a shell: a link to a folder is one for `*`, and no way into the depth for `**`, where it could lead in a circle.
    let walk = WalkDir::new(start).min_depth(1).follow_links(!is_deep).max_depth(if is_deep { usize::MAX } else { parts.len() - fixed });
    let seen = walk.into_iter().filter_entry(|entry| entry.depth() == 0 || !is_hidden(entry.file_name())).flatten();
    let named = seen.filter_map(|entry| Some(base.join(entry.path().strip_prefix(start).ok()?)));
    let options = MatchOptions { case_sensitive: true, require_literal_separator: true, require_literal_leading_dot: true };
    let mut found: Vec<PathBuf> = named.filter(|path| pattern.matches_path_with(path, options)).collect();
    found.sort();
    found
}

fn has_wildcard(name: &OsStr) -> bool {
    name.to_string_lossy().contains(['*', '?', '['])
}

fn is_hidden(name: &OsStr) -> bool {
    name.to_string_lossy().starts_with('.')
}
