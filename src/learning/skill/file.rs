//! A skill as JSON: `{"format": "cpdmp-skill", "version": 1, …}`. Numbers survive the round trip bit for bit; unknown keys are allowed.

use std::path::Path;

use super::Skill;
use super::schema::{FORMAT, File, VERSION};
use crate::learning::LearningError;

impl Skill {
    /// The skill as JSON text.
    ///
    /// # Errors
    /// When the skill does not pass [`Skill::check`].
    pub fn to_json(&self) -> Result<String, LearningError> {
        self.check()?;
        let mut text = serde_json::to_string_pretty(&File::of(self)).map_err(|e| LearningError::Skill(e.to_string()))?;
        text.push('\n');
        Ok(text)
    }

    /// A skill from JSON text.
    ///
    /// # Errors
    /// When the text is not JSON of this format and version, or the skill does not pass [`Skill::check`].
    pub fn from_json(text: &str) -> Result<Self, LearningError> {
        let wrong = |e: serde_json::Error| LearningError::Skill(e.to_string());
        let value: serde_json::Value = serde_json::from_str(text).map_err(wrong)?;
        if value["format"] != FORMAT {
            return Err(LearningError::Skill(format!("\"format\" is {}, but must be \"{FORMAT}\"", value["format"])));
        }
        if value["version"] != VERSION {
            let hint = if value["version"].as_u64() > Some(VERSION) { ": a newer cpdmp wrote it" } else { "" };
            return Err(LearningError::Skill(format!("\"version\" is {}, but must be {VERSION}{hint}", value["version"])));
        }
        let file: File = serde_json::from_str(text).map_err(wrong)?;
        let skill = file.into_skill()?;
        skill.check()?;
        Ok(skill)
    }

    /// Reads a skill file.
    ///
    /// # Errors
    /// As [`Skill::from_json`], or when the file cannot be read.
    pub fn read(path: &Path) -> Result<Self, LearningError> {
        let text = std::fs::read_to_string(path).map_err(|source| LearningError::Io { path: path.to_owned(), source })?;
        Self::from_json(&text)
    }

    /// Writes a skill file: beside, then renamed.
    ///
    /// # Errors
    /// As [`Skill::to_json`], or when the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), LearningError> {
        let text = self.to_json()?;
        let io = |source| LearningError::Io { path: path.to_owned(), source };
        let parent = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let mut builder = tempfile::Builder::new();
        // A temporary file is private; a skill is a file like any other.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o644));
        let beside = builder.tempfile_in(parent).map_err(io)?;
        std::fs::write(beside.path(), text).map_err(io)?;
        beside.persist(path).map_err(|e| io(e.error))?;
        Ok(())
    }
}
