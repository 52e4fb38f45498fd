//! A single file that a command writes: beside its final place first, then renamed, and only over what is ours.

use std::fs::{self, File};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use super::OutputError;

/// What a file must be to be replaced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Replaceable {
    /// A skill.
    Skill,
    /// Samples: its first line names a column `time_s`, or it is a Parquet file.
    Samples,
    /// The table of a sweep: a Parquet file.
    Table,
    /// A JUnit report.
    Junit,
}

impl Replaceable {
    fn describe(self) -> &'static str {
        match self {
            Self::Skill => "a skill",
            Self::Samples => "a file of samples",
            Self::Table => "a Parquet file",
            Self::Junit => "a JUnit report",
        }
    }
}

/// Bytes at the beginning of a file that say what it is.
const BEGINNING: u64 = 4096;

/// Checks that `path` is free or holds what may be replaced, and makes its folder.
///
/// # Errors
/// When something else is there, or the folder cannot be made.
pub fn prepare_file(path: &Path, replaceable: Replaceable) -> Result<(), OutputError> {
    let path = &followed(path);
    if path.symlink_metadata().is_ok() && !is_replaceable(path, replaceable) {
        return Err(OutputError::NotOurs { path: path.to_path_buf(), what: replaceable.describe() });
    }
    let folder = folder(path);
    fs::create_dir_all(folder).map_err(OutputError::io(folder))
}

/// Where a file is written that is called `path`: where a link leads, if it is one, even to nothing.
#[must_use]
pub fn followed(path: &Path) -> PathBuf {
    let Ok(target) = fs::read_link(path) else { return path.to_path_buf() };
    path.canonicalize().unwrap_or_else(|_| folder(path).join(target))
}

/// Writes a file beside its place and renames it, so that there is never half of it. A link is followed.
///
/// # Errors
/// When something else is there, or the file system refuses.
pub fn replace_file(path: &Path, content: &[u8], replaceable: Replaceable) -> Result<(), OutputError> {
    prepare_file(path, replaceable)?;
    let mut builder = tempfile::Builder::new();
    // A temporary file is private; what a command writes is a file like any other.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o644));
    let place = followed(path);
    let write = || {
        let mut beside = builder.tempfile_in(folder(&place))?;
        beside.write_all(content)?;
        beside.as_file().sync_all()?;
        beside.persist(&place).map_err(|error| error.error)
    };
    write().map(|_| ()).map_err(OutputError::io(path))
}

/// Removes a file if it is what might be replaced, or empties it where it cannot be removed.
pub fn remove_file(path: &Path, replaceable: Replaceable) {
    let place = followed(path);
    if is_replaceable(&place, replaceable) && fs::remove_file(&place).is_err() {
        _ = File::create(place);
    }
}

/// Replaces the content of a file that is there, beside its place first, and leaves its permissions as they are. A link is followed.
///
/// # Errors
/// When the file is not there, or the file system refuses.
pub fn rewrite_file(path: &Path, content: &[u8]) -> Result<(), OutputError> {
    let rewrite = || {
        let place = path.canonicalize()?;
        let mut beside = tempfile::Builder::new().tempfile_in(folder(&place))?;
        beside.write_all(content)?;
        beside.as_file().set_permissions(place.metadata()?.permissions())?;
        beside.as_file().sync_all()?;
        beside.persist(&place).map_err(|error| error.error)
    };
    rewrite().map(|_| ()).map_err(OutputError::io(path))
}

fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn is_replaceable(path: &Path, replaceable: Replaceable) -> bool {
    // Opening a pipe or device could wait for ever.
    if !path.metadata().is_ok_and(|about| about.is_file()) {
        return false;
    }
    let mut bytes = Vec::new();
    if File::open(path).and_then(|file| file.take(BEGINNING).read_to_end(&mut bytes)).is_err() {
        return false;
    }
    let text = String::from_utf8_lossy(&bytes);
    match replaceable {
        Replaceable::Table => bytes.starts_with(b"PAR1"),
        Replaceable::Skill => text.trim_start().starts_with('{') && text.contains("\"cpdmp-skill\""),
        // What `mktemp` makes is there, and holds nothing.
        Replaceable::Junit => bytes.is_empty() || text.contains("<testsuites"),
        Replaceable::Samples => {
            bytes.starts_with(b"PAR1") || text.lines().next().is_some_and(|line| line.split(',').any(|c| c == "time_s"))
        }
    }
}
