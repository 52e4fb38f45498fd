//! One run per folder: a lock that dies with the process that holds it.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use super::OutputError;

/// A lock that is held. Dropping it lets go and removes the file.
#[derive(Debug)]
pub struct Lock {
    path: PathBuf,
    _file: File,
}

/// Why a lock was not had.
pub enum LockError {
    /// Another process has it; what that process wrote about itself.
    Held(String),
    /// The file system refused.
    Io(std::io::Error),
}

/// Takes the lock at `path`, or says who has it.
///
/// # Errors
/// When another process has it, or the file cannot be made.
pub fn lock(path: &Path) -> Result<Lock, LockError> {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let token = format!("process {}, lock {}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
    loop {
        let mut file = OpenOptions::new().create(true).truncate(false).read(true).write(true).open(path).map_err(LockError::Io)?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(LockError::Held(holder(&mut file))),
            Err(TryLockError::Error(error)) => return Err(LockError::Io(error)),
        }
        if let Err(error) = file.set_len(0).and_then(|()| file.write_all(token.as_bytes())) {
            _ = fs::remove_file(path);
            return Err(LockError::Io(error));
        }
        // Whoever held the lock before may have removed the file between our opening and our locking: then we hold a file without a name.
        if fs::read_to_string(path).is_ok_and(|found| found == token) {
            return Ok(Lock { path: path.to_path_buf(), _file: file });
        }
    }
}

/// Takes the lock of what is written to `target`: a hidden file beside it, in its folder, which is made.
///
/// # Errors
/// When another process writes there, `target` has no name, or the file system refuses.
pub fn lock_beside(target: &Path) -> Result<Lock, OutputError> {
    let name = target.file_name().ok_or_else(|| OutputError::NotARun(target.to_path_buf()))?.to_string_lossy().into_owned();
    let parent = target.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    fs::create_dir_all(parent).map_err(OutputError::io(parent))?;
    let place = parent.join(format!(".{name}.lock"));
    lock(&place).map_err(|error| match error {
        LockError::Held(holder) => OutputError::Busy { path: target.to_path_buf(), holder },
        LockError::Io(source) => OutputError::Io { path: place.clone(), source },
    })
}

fn holder(file: &mut File) -> String {
    let mut text = String::new();
    match file.read_to_string(&mut text) {
        Ok(_) if !text.is_empty() => text.split(',').next().unwrap_or_default().to_owned(),
        _ => "another process".to_owned(),
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // Removed while still held, so that nobody else's lock is removed. A file that stays does no harm.
        _ = fs::remove_file(&self.path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lock_is_held_once_and_let_go() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("lock");
        let held = lock(&path).ok().expect("nobody has it");
        let refused = lock(&path);
        assert!(matches!(refused, Err(LockError::Held(who)) if who == format!("process {}", std::process::id())));
        drop(held);
        assert!(!path.exists());
        assert!(lock(&path).is_ok());
    }
}
