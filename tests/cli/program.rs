//! Calls the program in a folder of its own.

use std::fs;
use std::path::Path;

use assert_cmd::Command;

/// A scenario without faults. Tests derive theirs from it, so that each names only what it is about.
pub const GOOD: &str = r#"
schema_version = 1
name = "good"

[parameters]
block_height_m = 0.2

[[object]]
name = "block"
kind = "u_block"
center_m = [1.2, 0.9]
base_height_m = "block_height_m"
aperture_m = 0.18
post_height_m = 0.14

[[object]]
name = "toy"
kind = "ball"
center_m = [0.6, 0.1]
radius_m = 0.03
mass_kg = 0.05

[[object]]
name = "table"
kind = "table"
center_m = [0.62, 0.12]
size_m = [0.3, 0.4]
top_height_m = 0.0

[teaching]
duration_s = 4.0
position_spread_m = 0.002
grid = { block_height_m = [0.17, 0.20, 0.26] }

[[teaching.waypoint]]
time_s = 0.0
offset_m = [0.6, 0.4, 0.1]

[[teaching.waypoint]]
time_s = 4.0
at = "toy"
offset_m = [0.0, 0.0, 0.1]

[learning]
theta_m = ["block_height_m"]

[[criterion]]
name = "goal"
kind = "goal_reached"
max_m = 0.02
"#;

/// A temporary folder with files in it.
pub struct Folder(tempfile::TempDir);

impl Folder {
    /// A folder with these files.
    pub fn with(files: &[(&str, &[u8])]) -> Self {
        let folder = Self(tempfile::tempdir().expect("a temporary folder"));
        for (name, content) in files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().expect("a file has a folder")).expect("a folder");
            fs::write(path, content).expect("a file");
        }
        folder
    }

    /// A folder with the good scenario, one piece of it replaced, as `a.toml`.
    pub fn with_change(old: &str, new: &str) -> Self {
        assert_eq!(GOOD.matches(old).count(), 1, "`{old}` must be there once");
        Self::with(&[("a.toml", GOOD.replace(old, new).as_bytes())])
    }

    pub fn path(&self) -> &Path {
        self.0.path()
    }

    /// The files and folders in it, sorted.
    pub fn names(&self) -> Vec<String> {
        names(self.path())
    }

    /// Calls the program in this folder.
    pub fn call(&self, arguments: &[&str]) -> Said {
        let output = cpdmp().current_dir(self.path()).args(arguments).output().expect("the program starts");
        Said {
            code: output.status.code(),
            stdout: String::from_utf8(output.stdout).expect("text"),
            stderr: String::from_utf8(output.stderr).expect("text"),
        }
    }

    /// Calls `validate a.toml`, which must refuse it, and returns what it says.
    pub fn refused(&self) -> String {
        let said = self.call(&["validate", "a.toml"]);
        assert_eq!(said.code, Some(3), "{}{}", said.stdout, said.stderr);
        said.stderr
    }
}

/// The files and folders in a folder, sorted.
pub fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let name = |entry: std::io::Result<fs::DirEntry>| entry.expect("an entry").file_name().to_string_lossy().into_owned();
    let mut names: Vec<String> = entries.map(name).collect();
    names.sort();
    names
}

/// What the program said.
#[derive(Debug)]
pub struct Said {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

/// The program, in an environment that does not depend on who runs the test.
pub fn cpdmp() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cpdmp"));
    for (name, _) in std::env::vars().filter(|(name, _)| name.starts_with("CPDMP_")) {
        command.env_remove(name);
    }
    command.env("LC_ALL", "C.UTF-8").env_remove("NO_COLOR").env_remove("COLUMNS").env_remove("CLICOLOR_FORCE");
    command
}
