//! Where a run leaves its files: beside the final place first, then renamed.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::Outcome;
use super::lock::{Lock, lock_beside};
use super::manifest::{FORMAT, read_regular};

/// Why output cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The place is taken by something that is not ours.
    #[error("{} is not the folder of a run and is not overwritten: choose another --out, or move it away", .0.display())]
    NotARun(PathBuf),
    /// The place of a file is taken by something that is not ours.
    #[error("{} is not {what} and is not overwritten: name another file, or move it away", path.display())]
    NotOurs {
        /// The file.
        path: PathBuf,
        /// What it would have to be.
        what: &'static str,
    },
    /// Another run writes there.
    #[error("{} is in use by {holder}: wait for it, or choose another --out", path.display())]
    Busy {
        /// The folder.
        path: PathBuf,
        /// Who uses it.
        holder: String,
    },
    /// The file system refused.
    #[error("{} cannot be written: {source}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
}

impl OutputError {
    /// How a command ends that meets this error.
    pub fn outcome(&self) -> Outcome {
        match self {
            Self::Busy { .. } => Outcome::OutputBusy,
            Self::NotARun(_) | Self::NotOurs { .. } | Self::Io { .. } => Outcome::OutputFailed,
        }
    }

    pub(super) fn io(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_path_buf();
        move |source| Self::Io { path, source }
    }
}

/// The folder of a run that is being written. Nothing is seen at its final place until [`RunFolder::finish`]; an older run stays till then.
#[derive(Debug)]
pub struct RunFolder {
    target: PathBuf,
    staging: PathBuf,
    _lock: Lock,
}

impl RunFolder {
    /// Takes the folder `target`: checks that it may be replaced, locks it, and makes the place beside it.
    pub fn open(target: &Path) -> Result<Self, OutputError> {
        may_be_replaced(target)?;
        let name = target.file_name().ok_or_else(|| OutputError::NotARun(target.to_path_buf()))?.to_string_lossy().into_owned();
        let parent = target.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let lock = lock_beside(target)?;
        // Left behind only by a run that was killed: under the lock nobody else writes here.
        let staging = parent.join(format!(".{name}.partial"));
        bring_back(target, &staging)?;
        clear(&staging)?;
        fs::create_dir(&staging).map_err(OutputError::io(&staging))?;
        Ok(Self { target: target.to_path_buf(), staging, _lock: lock })
    }

    /// The place where files are written for now.
    pub fn staging(&self) -> &Path {
        &self.staging
    }

    /// What was told of files while they were being written, with the place where they are looked for.
    #[must_use]
    pub fn in_place(&self, told: &str) -> String {
        told.replace(&self.staging.display().to_string(), &self.target.display().to_string())
    }

    /// Writes one file of the run.
    pub fn write(&self, name: &str, content: &str) -> Result<(), OutputError> {
        write_file(&self.staging.join(name), content)
    }

    /// Puts the run in its place. An older run there is replaced.
    pub fn finish(self) -> Result<PathBuf, OutputError> {
        may_be_replaced(&self.target)?;
        let old = self.staging.with_extension("old");
        if self.target.exists() {
            fs::rename(&self.target, &old).map_err(OutputError::io(&self.target))?;
        }
        if let Err(source) = fs::rename(&self.staging, &self.target) {
            // Better the older run than none.
            _ = fs::rename(&old, &self.target);
            return Err(OutputError::Io { path: self.target.clone(), source });
        }
        clear(&self.staging)?;
        Ok(self.target.clone())
    }
}

impl Drop for RunFolder {
    fn drop(&mut self) {
        _ = fs::remove_dir_all(&self.staging);
    }
}

/// A folder may be replaced when it is not there, is empty, or holds a run.
fn may_be_replaced(target: &Path) -> Result<(), OutputError> {
    let Ok(mut entries) = fs::read_dir(target) else {
        return if target.symlink_metadata().is_ok() { Err(OutputError::NotARun(target.to_path_buf())) } else { Ok(()) };
    };
    if entries.next().is_none() || is_run(target) { Ok(()) } else { Err(OutputError::NotARun(target.to_path_buf())) }
}

/// Whether a folder holds a run that is whole: its manifest is written last.
fn is_run(folder: &Path) -> bool {
    let manifest = read_regular(&folder.join("manifest.json")).unwrap_or_default();
    let manifest: serde_json::Value = serde_json::from_slice(&manifest).unwrap_or_default();
    manifest["format"] == FORMAT
}

/// Removes what there is of a run beside its place. The older one under the newer one's name: half removed it would look like somebody's.
fn clear(staging: &Path) -> Result<(), OutputError> {
    remove_if_there(staging)?;
    _ = fs::rename(staging.with_extension("old"), staging);
    // Without it nobody takes the rest for a run.
    _ = fs::remove_file(staging.join("manifest.json"));
    remove_if_there(staging)
}

fn remove_if_there(folder: &Path) -> Result<(), OutputError> {
    match fs::remove_dir_all(folder) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(OutputError::Io { path: folder.to_path_buf(), source: error }),
        _ => Ok(()),
    }
}

/// Writes a file so that it is on the disk when this returns.
pub fn write_file(path: &Path, content: impl AsRef<[u8]>) -> Result<(), OutputError> {
    let write = || {
        let mut file = File::create(path)?;
        file.write_all(content.as_ref())?;
        file.sync_all()
    };
    write().map_err(OutputError::io(path))
}

/// Puts a whole run in its place that a kill has left beside it, between the two renames of [`RunFolder::finish`]: the new one, which has its
/// manifest, or the old one.
fn bring_back(target: &Path, staging: &Path) -> Result<(), OutputError> {
    let old = staging.with_extension("old");
    let whole = [staging, &old].into_iter().find(|place| is_run(place));
    let is_free = fs::read_dir(target).map_or(!target.exists(), |mut entries| entries.next().is_none());
    if let Some(place) = whole.filter(|_| is_free) {
        fs::rename(place, target).map_err(OutputError::io(target))?;
    }
    // What bears our name and is none of ours would be removed at the end.
    may_be_replaced(&old)
}

#[cfg(test)]
mod tests {
    use super::*;

    const MANIFEST: &str = r#"{"format":"cpdmp-run"}"#;

    /// Contract: a kill between the renames of the end loses neither run.
    #[test]
    fn what_a_kill_left_beside_its_place_is_brought_back() {
        let place = tempfile::tempdir().expect("a folder");
        let target = place.path().join("a");
        for (whole, is_made) in [(".a.partial", false), (".a.old", false), (".a.old", true)] {
            if is_made {
                fs::create_dir(&target).expect("made");
            }
            for beside in [".a.partial", ".a.old"] {
                fs::create_dir_all(place.path().join(beside)).expect("made");
            }
            fs::write(place.path().join(whole).join("manifest.json"), MANIFEST).expect("written");
            fs::write(place.path().join(whole).join("from"), whole).expect("written");
            let folder = RunFolder::open(&target).expect("free");
            assert_eq!(fs::read_to_string(target.join("from")).expect("there"), whole);
            drop(folder);
            fs::remove_dir_all(&target).expect("removed");
            fs::remove_dir_all(place.path().join(".a.old")).ok();
        }
        // A manifest that was being written is that of no run.
        fs::create_dir_all(place.path().join(".a.partial")).expect("made");
        fs::write(place.path().join(".a.partial/manifest.json"), &MANIFEST[..9]).expect("written");
        drop(RunFolder::open(&target).expect("free"));
        assert!(!target.exists());
        fs::create_dir_all(place.path().join(".a.old")).expect("made");
        fs::write(place.path().join(".a.old/thesis"), "mine").expect("written");
        assert!(matches!(RunFolder::open(&target), Err(OutputError::NotARun(path)) if path.ends_with(".a.old")));
    }

    #[test]
    fn nothing_is_seen_before_the_end_and_an_older_run_stays_until_then() {
        let place = tempfile::tempdir().expect("a folder");
        let target = place.path().join("runs/a");
        for content in ["first", "second"] {
            let folder = RunFolder::open(&target).expect("free");
            folder.write("manifest.json", MANIFEST).expect("written");
            folder.write("x", content).expect("written");
            assert_ne!(fs::read_to_string(target.join("x")).unwrap_or_default(), content);
            folder.finish().expect("renamed");
            assert_eq!(fs::read_to_string(target.join("x")).expect("there"), content);
        }
        let left: Vec<_> = fs::read_dir(place.path().join("runs")).expect("there").collect();
        assert_eq!(left.len(), 1, "no lock, no staging, no old run is left: {left:?}");
    }

    #[test]
    fn what_is_not_a_run_is_never_overwritten() {
        let place = tempfile::tempdir().expect("a folder");
        fs::write(place.path().join("thesis.tex"), "years of work").expect("written");
        assert!(matches!(RunFolder::open(place.path()), Err(OutputError::NotARun(_))));
        assert!(matches!(RunFolder::open(&place.path().join("thesis.tex")), Err(OutputError::NotARun(_))));
    }

    #[test]
    fn one_folder_is_for_one_run() {
        let place = tempfile::tempdir().expect("a folder");
        let target = place.path().join("a");
        let first = RunFolder::open(&target).expect("free");
        assert_eq!(RunFolder::open(&target).map_err(|error| error.outcome()).err(), Some(Outcome::OutputBusy));
        drop(first);
        assert!(RunFolder::open(&target).is_ok());
    }
}
