//! A dataset to its folder: written beside, then renamed, so that there is never half a dataset.

use std::path::Path;

use super::{Dataset, DemonstrationError, Fault, FileFormat, ParameterSource, sequences, trajectory_file};

impl Dataset {
    /// Writes `dataset.toml` and one CSV file per demonstration into a new folder.
    ///
    /// # Errors
    /// When the dataset does not pass [`Self::check`], a name cannot be a file name, the folder already holds files, or the disk
    /// refuses. Nothing is left behind then.
    pub fn write(&self, folder: &Path) -> Result<(), DemonstrationError> {
        self.write_as(folder, FileFormat::Csv)
    }

    /// As [`Self::write`], with the samples in the given format.
    ///
    /// # Errors
    /// As [`Self::write`].
    pub fn write_as(&self, folder: &Path, format: FileFormat) -> Result<(), DemonstrationError> {
        self.check()?;
        self.check_names()?;
        let parent = folder.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        std::fs::create_dir_all(parent).map_err(DemonstrationError::io(parent))?;
        let beside = tempfile::Builder::new().prefix(".dataset-").tempdir_in(parent).map_err(DemonstrationError::io(parent))?;
        for demonstration in &self.demonstrations {
            let file = format!("{}.{}", demonstration.name, format.extension());
            trajectory_file::write_new(&beside.path().join(&file), &file, &demonstration.trajectory, format)?;
        }
        let path = beside.path().join("dataset.toml");
        std::fs::write(&path, self.list(format)).map_err(DemonstrationError::io(&path))?;
        // A temporary folder is private; a dataset is not.
        open_to_readers(beside.path()).map_err(DemonstrationError::io(beside.path()))?;
        std::fs::rename(beside.path(), folder).map_err(DemonstrationError::io(folder))
    }

    fn check_names(&self) -> Result<(), DemonstrationError> {
        let mut faults = Vec::new();
        for (i, demonstration) in self.demonstrations.iter().enumerate() {
            let name = &demonstration.name;
            let plain = name.chars().all(|c| c.is_alphanumeric() || "_-.".contains(c)) && !name.starts_with('.') && !name.is_empty();
            if !plain {
                let expected = "letters, digits, `_`, `-`, `.`: it becomes a file name";
                faults.push(Fault::new("demonstration", format!("the name `{name}`"), expected));
            }
            for column in demonstration.trajectory.columns() {
                let model = self.motion.contains(column) || self.wrench.contains(column);
                if !model && sequences::tells_apart(column) {
                    let found = "a column whose name tells repetitions apart";
                    faults.push(Fault::new(name, found, "another name for it, or a place in motion or wrench").in_column(column));
                }
            }
            if self.demonstrations[..i].iter().any(|other| other.name == *name) {
                faults.push(Fault::new("demonstration", format!("the name `{name}` twice"), "every name once"));
            }
        }
        if faults.is_empty() { Ok(()) } else { Err(DemonstrationError::Invalid(faults)) }
    }

    fn list(&self, format: FileFormat) -> String {
        let names = |list: &[String]| list.iter().map(|name| quoted(name)).collect::<Vec<_>>().join(", ");
        let mut text = format!("schema_version = 1\nmotion = [{}]\nwrench = [{}]\n", names(&self.motion), names(&self.wrench));
        let given = self.parameter_source == ParameterSource::Given;
        if !given {
            text.push_str(&format!("theta = \"{}\"\n", self.parameter_source.word()));
        }
        for demonstration in &self.demonstrations {
            text.push_str(&format!(
                "\n[[demonstration]]\nfile = {}\ntheta_m = {}\ntheta_f = {}\n",
                quoted(&format!("{}.{}", demonstration.name, format.extension())),
                parameters(if given { &demonstration.theta_m } else { &[] }),
                parameters(&demonstration.theta_f)
            ));
        }
        text
    }
}

fn parameters(theta: &[(String, f64)]) -> String {
    let entries: Vec<String> = theta.iter().map(|(name, value)| format!("{} = {value:?}", key(name))).collect();
    if entries.is_empty() { "{}".to_owned() } else { format!("{{ {} }}", entries.join(", ")) }
}

/// A bare key where TOML allows one.
fn key(name: &str) -> String {
    let bare = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    if bare { name.to_owned() } else { quoted(name) }
}

fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

#[cfg(unix)]
fn open_to_readers(path: &Path) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    std::fs::set_permissions(path, std::fs::Permissions::from_mode(0o755))
}

#[cfg(not(unix))]
fn open_to_readers(_: &Path) -> std::io::Result<()> {
    Ok(())
}
