//! Which scenario files the arguments mean.

use std::ffi::OsStr;
use std::path::{Component, Path, PathBuf};

use glob::{MatchOptions, Pattern};
use walkdir::{DirEntry, WalkDir};

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
    if !is_pattern(path) {
        // A file that is not there is a fault of its own, told when it is read.
        return if path.is_dir() { scenarios_in(path) } else { vec![path.to_path_buf()] };
    }
    let of_match = |one: PathBuf| match (one.is_dir(), is_scenario(&one)) {
        (true, _) => scenarios_in(&one),
        (false, true) => vec![one],
        (false, false) => Vec::new(),
    };
    let mut found: Vec<PathBuf> = matching(path).into_iter().flat_map(of_match).collect();
    found.sort();
    found.dedup();
    found
}

fn scenarios_in(folder: &Path) -> Vec<PathBuf> {
    match std::fs::read_dir(folder) {
        Ok(_) => inside(folder).into_iter().filter(|file| is_scenario(file) && !file.is_dir()).collect(),
        // So is a folder that cannot be looked into.
        Err(_) => vec![folder.to_path_buf()],
    }
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

/// What matches a pattern, sorted; also what may hold matches and cannot be looked into.
pub(super) fn matching(path: &Path) -> Vec<PathBuf> {
    // What comes before the first part with a wildcard is where to look.
    let parts: Vec<Component<'_>> = path.components().collect();
    let plain: PathBuf = parts.iter().collect();
    let Ok(pattern) = Pattern::new(&plain.to_string_lossy()) else { return Vec::new() };
    let fixed = parts.iter().take_while(|part| !has_wildcard(part.as_os_str())).count();
    let base: PathBuf = parts[..fixed].iter().collect();
    let start = if base.as_os_str().is_empty() { Path::new(".") } else { &base };
    let is_deep = parts.iter().any(|part| part.as_os_str() == "**");
    let asks_for_hidden = parts[fixed..].iter().any(|part| matches!(part, Component::Normal(name) if is_hidden(name)));
    // As in a shell: a link to a folder is one for `*`, and no way into the depth for `**`, where it could lead in a circle.
    let walk = WalkDir::new(start).min_depth(1).follow_links(!is_deep).max_depth(if is_deep { usize::MAX } else { parts.len() - fixed });
    let seen = walk.into_iter().filter_entry(|entry| entry.depth() == 0 || asks_for_hidden || !is_hidden(entry.file_name()));
    let named = |place: &Path| Some(base.join(place.strip_prefix(start).ok()?));
    let options = MatchOptions { case_sensitive: true, require_literal_separator: true, require_literal_leading_dot: true };
    let fits = |place: &PathBuf| pattern.matches_path_with(place, options);
    // Whether what would match lies in it.
    let leads_on = |place: &PathBuf| {
        let head: PathBuf = parts.iter().take(place.components().count()).collect();
        place.is_dir() && (is_deep || Pattern::new(&head.to_string_lossy()).is_ok_and(|head| head.matches_path_with(place, options)))
    };
    let of_entry = |entry: Result<DirEntry, walkdir::Error>| match entry {
        Ok(entry) => named(entry.path()).filter(fits),
        // A link to nothing is what its name says; a folder that is closed, or leads to where it is in, hides something.
        Err(error) => named(error.path()?).filter(|place| fits(place) || leads_on(place)),
    };
    let mut found: Vec<PathBuf> = seen.filter_map(of_entry).collect();
    found.sort();
    found.dedup();
    found
}

fn has_wildcard(name: &OsStr) -> bool {
    name.to_string_lossy().contains(['*', '?', '['])
}

fn is_hidden(name: &OsStr) -> bool {
    name.to_string_lossy().starts_with('.')
}
