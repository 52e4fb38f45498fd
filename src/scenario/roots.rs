//! Which files a scenario may use: those below its own folder, below the current folder, and below folders that the user names.

use std::path::{Component, Path, PathBuf};

/// The folders below which files may be used.
#[derive(Clone, Debug, Default)]
pub(super) struct Roots(Vec<PathBuf>);

impl Roots {
    /// The folder of the scenario, the current one, and those that the user names.
    pub fn new(scenario_directory: &Path, named: &[PathBuf]) -> Self {
        let current = Path::new(".");
        let all = [scenario_directory, current].into_iter().chain(named.iter().map(PathBuf::as_path));
        Self(all.map(resolve).collect())
    }

    /// The folder in which a file that may be used lies is below one of the roots once links are followed. Otherwise where it really lies.
    pub fn check(&self, path: &Path) -> Result<(), PathBuf> {
        let resolved = resolve(path);
        if self.0.iter().any(|root| resolved.starts_with(root)) { Ok(()) } else { Err(resolved) }
    }
}

/// The absolute path with links followed as far as the path exists, and the rest tidied.
pub(super) fn resolve(path: &Path) -> PathBuf {
    let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    let existing = absolute.ancestors().find_map(|ancestor| Some((ancestor, ancestor.canonicalize().ok()?)));
    let Some((ancestor, mut resolved)) = existing else { return absolute };
    for component in absolute.strip_prefix(ancestor).unwrap_or(Path::new("")).components() {
        match component {
            Component::ParentDir => _ = resolved.pop(),
            Component::CurDir => {}
            other => resolved.push(other),
        }
    }
    resolved
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_outside_the_roots_are_refused_with_where_they_lie() {
        let folder = tempfile::tempdir().expect("a folder");
        let roots = Roots(vec![resolve(folder.path())]);
        assert_eq!(roots.check(&folder.path().join("a/b.toml")), Ok(()));
        assert!(roots.check(&folder.path().join("a/../../b.toml")).is_err_and(|path| path.ends_with("b.toml")));
        assert!(roots.check(Path::new("/etc/passwd")).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_out_of_the_roots_is_followed_and_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        std::os::unix::fs::symlink("/etc", folder.path().join("link")).expect("a link");
        let roots = Roots(vec![resolve(folder.path())]);
        assert!(roots.check(&folder.path().join("link/passwd")).is_err());
    }
}
