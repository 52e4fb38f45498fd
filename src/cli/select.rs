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
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    if path.is_dir() {
        matching(path, "*")
    } else if !path.exists() && name.contains(['*', '?']) {
        matching(path.parent().unwrap_or(Path::new("")), &name)
    } else {
        // A file that is not there is a fault of its own, told when it is read.
        vec![path.to_path_buf()]
    }
}

/// The files that one argument names, whatever they hold: itself, or those that match it as a pattern.
pub(super) fn files_like(path: &Path) -> Vec<PathBuf> {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let is_pattern = !path.exists() && name.contains(['*', '?']);
    if is_pattern { all_matching(path.parent().unwrap_or(Path::new("")), &name) } else { vec![path.to_path_buf()] }
}

/// The scenario files of a folder whose names match the pattern, sorted.
fn matching(folder: &Path, pattern: &str) -> Vec<PathBuf> {
    let mut files = all_matching(folder, pattern);
    files.retain(|file| file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml")));
    files
}

/// The folders that one argument names as a pattern.
pub(super) fn folders_like(path: &Path) -> Vec<PathBuf> {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let is_pattern = !path.exists() && name.contains(['*', '?']);
    let mut found = if is_pattern { entries_matching(path.parent().unwrap_or(Path::new("")), &name) } else { Vec::new() };
    found.retain(|path| path.is_dir());
    found
}

/// The files of a folder whose names match the pattern, sorted.
fn all_matching(folder: &Path, pattern: &str) -> Vec<PathBuf> {
    let mut files = entries_matching(folder, pattern);
    files.retain(|file| !file.is_dir());
    files
}

/// What is in a folder under names that match the pattern, sorted.
fn entries_matching(folder: &Path, pattern: &str) -> Vec<PathBuf> {
    let place = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let Ok(entries) = std::fs::read_dir(place) else { return Vec::new() };
    let names = entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned());
    let mut files: Vec<PathBuf> = names.filter(|name| matches(pattern, name)).map(|name| folder.join(name)).collect();
    files.sort();
    files
}

/// Whether a name matches a pattern in which `*` stands for any characters and `?` for one.
fn matches(pattern: &str, name: &str) -> bool {
    let (pattern, name): (Vec<char>, Vec<char>) = (pattern.chars().collect(), name.chars().collect());
    // reached[i]: the part of the pattern read so far matches the first i characters of the name.
    let mut reached = vec![false; name.len() + 1];
    reached[0] = true;
    for symbol in pattern {
        let mut next = vec![false; name.len() + 1];
        for i in 0..=name.len() {
            next[i] = match symbol {
                '*' => reached[i] || (i > 0 && next[i - 1]),
                '?' => i > 0 && reached[i - 1],
                exact => i > 0 && reached[i - 1] && name[i - 1] == exact,
            };
        }
        reached = next;
    }
    reached[name.len()]
}

#[cfg(test)]
mod tests {
    use super::matches;

    #[test]
    fn patterns_match_as_in_a_shell() {
        for (pattern, name) in [("*.toml", "a.toml"), ("pick*", "pick_and_place.toml"), ("a?c", "abc"), ("*a*b*", "xaxxbx"), ("*", "")] {
            assert!(matches(pattern, name), "{pattern} {name}");
        }
        for (pattern, name) in [("*.toml", "a.tom"), ("a?c", "ac"), ("a", "ab"), ("", "a")] {
            assert!(!matches(pattern, name), "{pattern} {name}");
        }
    }
}
