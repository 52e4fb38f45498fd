//! Room on the disk for what a run leaves: what matters more is written first, and what does not fit leaves nothing half.

use std::fs;
use std::path::Path;

/// Where a run is written, and what became of it.
pub(super) struct Room<'a> {
    folder: &'a Path,
    /// Gives up what only served until now: a recording that has grown with the run.
    spare: &'a dyn Fn(),
    /// What could not be written.
    pub failures: Vec<String>,
}

impl<'a> Room<'a> {
    /// In `folder`; `spare` makes room where there is none.
    pub fn new(folder: &'a Path, spare: &'a dyn Fn()) -> Self {
        Self { folder, spare, failures: Vec::new() }
    }

    /// Writes the file or folder `name`; when that fails, once more with what can be spared gone.
    pub fn put(&mut self, name: &str, write: impl Fn(&Path) -> Result<(), String>) {
        let place = self.folder.join(name);
        if write(&place).is_ok() {
            return;
        }
        remove(&place);
        (self.spare)();
        if let Err(error) = write(&place) {
            remove(&place);
            let is_named = error.contains(&place.display().to_string());
            self.failures.push(if is_named { error } else { format!("{}: {error}", place.display()) });
        }
    }

    /// Removes what can be made again from the rest, for `error` leaves no room for what cannot. Whether there was something.
    pub fn clear(&mut self, names: &[&str], error: &str) -> bool {
        (self.spare)();
        let there: Vec<&str> = names.iter().copied().filter(|name| self.folder.join(name).exists()).collect();
        for name in &there {
            remove(&self.folder.join(name));
            self.failures.push(format!("{}: no room: {error}", self.folder.join(name).display()));
        }
        !there.is_empty()
    }
}

/// What cannot be removed stays: there is nothing better to do with it.
fn remove(place: &Path) {
    _ = if place.is_dir() { fs::remove_dir_all(place) } else { fs::remove_file(place) };
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    #[test]
    fn what_does_not_fit_leaves_nothing_and_what_fits_later_is_written() {
        let folder = tempfile::tempdir().expect("a folder");
        let spared = Cell::new(false);
        let spare = || spared.set(true);
        let mut room = Room::new(folder.path(), &spare);
        room.put("good", |place| fs::write(place, "good").map_err(|error| error.to_string()));
        assert!(!spared.get() && room.failures.is_empty());
        room.put("later", |place| {
            fs::write(place, "half").expect("written");
            if spared.get() { fs::write(place, "whole").map_err(|error| error.to_string()) } else { Err("no room".to_owned()) }
        });
        room.put("never", |place| {
            fs::create_dir_all(place).and_then(|()| fs::write(place.join("half"), "half")).expect("written");
            Err("no room".to_owned())
        });
        assert_eq!(room.failures, [format!("{}: no room", folder.path().join("never").display())]);
        assert_eq!(fs::read_to_string(folder.path().join("later")).expect("there"), "whole");
        assert!(!folder.path().join("never").exists());
        assert!(room.clear(&["later", "never"], "full") && !folder.path().join("later").exists());
        assert!(!room.clear(&["later"], "full") && room.failures[1].ends_with("later: no room: full"), "{:?}", room.failures);
    }
}
