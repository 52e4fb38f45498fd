//! A skill as JSON: `{"format": "cpdmp-skill", "version": 1, …}`. Numbers survive the round trip bit for bit; unknown keys are allowed.
//! A checksum over the content tells a damaged file from a good one; files of other programs need none.

use std::io::Read;
use std::path::Path;

use super::Skill;
use super::checksum::{self, checksum};
use super::schema::{FORMAT, File, VERSION};
use crate::learning::LearningError;

/// The largest file that is read (bytes): 200 states over 32 columns with 64 parameters take 20 MB.
const MOST_BYTES: u64 = 64 << 20;

/// The JSON Schema of `skill.json`.
#[must_use]
pub fn skill_schema() -> serde_json::Value {
    schemars::schema_for!(File).to_value()
}

/// A fault of the content, in the words of this program.
fn worded(error: &serde_json::Error) -> String {
    let text = error.to_string();
    match text.strip_prefix("missing field `").and_then(|rest| rest.split_once('`')) {
        Some((key, place)) => format!("the key \"{key}\" is missing{place}"),
        None => text,
    }
}

impl Skill {
    /// The skill as JSON text, with its checksum.
    ///
    /// # Errors
    /// When the skill does not pass [`Skill::check`].
    pub fn to_json(&self) -> Result<String, LearningError> {
        self.check()?;
        let wrong = |e: serde_json::Error| LearningError::Skill(e.to_string());
        let mut file = File::of(self);
        file.checksum = Some(checksum(&serde_json::to_value(&file).map_err(wrong)?));
        let mut text = serde_json::to_string_pretty(&file).map_err(wrong)?;
        text.push('\n');
        Ok(text)
    }

    /// A skill from JSON text.
    ///
    /// # Errors
    /// When the text is not JSON of this format and version, does not fit its checksum, or the skill does not pass [`Skill::check`].
    pub fn from_json(text: &str) -> Result<Self, LearningError> {
        let value: serde_json::Value = serde_json::from_str(text).map_err(not_json)?;
        if value["format"] != FORMAT {
            let found = if value["format"].is_null() { "missing".to_owned() } else { shortened(&value["format"]) };
            return Err(LearningError::Skill(format!("\"format\" is {found}, but must be \"{FORMAT}\": this is not a skill file")));
        }
        if value["version"].as_f64() != Some(VERSION as f64) {
            let newer = value["version"].as_f64() > Some(VERSION as f64);
            let hint = if newer { ": a newer cpdmp wrote it, use that one" } else { "" };
            let found = shortened(&value["version"]);
            return Err(LearningError::Skill(format!("\"version\" is {found}, but must be {VERSION}{hint}")));
        }
        checksum::verify(&value)?;
        // The text is read again because only then a fault has a line and a column.
        let file: File = serde_json::from_str(text).map_err(|e| LearningError::Skill(worded(&e)))?;
        let skill = file.into_skill()?;
        skill.check()?;
        Ok(skill)
    }

    /// Reads a skill file of at most 64 MiB.
    ///
    /// # Errors
    /// As [`Skill::from_json`], or when the file cannot be read or is larger.
    pub fn read(path: &Path) -> Result<Self, LearningError> {
        let io = |source| LearningError::Io { path: path.to_owned(), source };
        // Opening a pipe could wait for ever.
        if !std::fs::metadata(path).map_err(io)?.is_file() {
            return Err(LearningError::Skill("it is no regular file".to_owned()));
        }
        let mut bytes = Vec::new();
        std::fs::File::open(path).and_then(|file| file.take(MOST_BYTES + 1).read_to_end(&mut bytes)).map_err(io)?;
        if bytes.len() as u64 > MOST_BYTES {
            return Err(LearningError::Skill(format!("the file has more than {} MiB", MOST_BYTES >> 20)));
        }
        let text = std::str::from_utf8(&bytes)
            .map_err(|e| LearningError::Skill(format!("the file is not text in UTF-8, from byte {} on", e.valid_up_to())))?;
        Self::from_json(text)
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
        beside.as_file().sync_all().map_err(io)?;
        beside.persist(path).map_err(|e| io(e.error))?;
        Ok(())
    }
}

fn not_json(error: serde_json::Error) -> LearningError {
    let cut = if error.is_eof() { ": the file ends too early, it is not complete" } else { "" };
    LearningError::Skill(format!("not JSON: {error}{cut}"))
}

/// A value as it stands in the file, short enough for a message.
fn shortened(value: &serde_json::Value) -> String {
    let text = value.to_string();
    if text.chars().count() > 40 { format!("{}…", text.chars().take(40).collect::<String>()) } else { text }
}
