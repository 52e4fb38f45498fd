//! `cpdmp inspect`: what a file or folder is and holds.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde_json::Value;

use super::args::Format;
use super::failure::Failure;
use super::learn::read_skill;
use super::recorded_run::RecordedManifest;
use super::terminal::Terminal;
use crate::demonstration::Dataset;
use crate::report::{DataSection, Outcome, RobotSection, RunSection, SkillSection, read_regular};
use crate::robot::{self, LoadOptions};

/// What was found; `kind` says which of the sections is there.
#[derive(Serialize)]
struct Found {
    schema_version: u32,
    path: PathBuf,
    #[serde(flatten)]
    content: Content,
}

#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum Content {
    Skill { skill: SkillSection },
    Dataset { data: DataSection },
    Run { run: RunSection },
    Robot { robot: RobotSection },
}

/// Looks at one path.
pub(super) fn inspect(path: &Path, terminal: &Terminal) -> Outcome {
    match content(path) {
        Ok(content) => {
            match terminal.format {
                Format::Json => terminal.json(&Found { schema_version: 1, path: path.to_path_buf(), content }),
                Format::Human => terminal.result(&text(path, &content)),
            }
            Outcome::Passed
        }
        Err(failure) => failure.tell(terminal),
    }
}

/// Recognises what is there by what it holds, not by its name.
fn content(path: &Path) -> Result<Content, Failure> {
    let invalid = |message: String| Failure::new(Outcome::InvalidInput, [format!("{}: {message}", path.display())]);
    if path.is_dir() {
        return if path.join("manifest.json").is_file() { run(path) } else { dataset(path) };
    }
    let beginning = beginning(path).map_err(|error| invalid(error.to_string()))?;
    let text = beginning.trim_start_matches('\u{feff}').trim_start();
    if text.starts_with('<') {
        let loaded = robot::load(path, &LoadOptions::default());
        let loaded = loaded.map_err(|error| Failure::new(Outcome::InvalidInput, [error.to_string()]))?;
        return Ok(Content::Robot { robot: RobotSection::of(&loaded) });
    }
    if text.starts_with('{') {
        if text.contains("\"cpdmp-run\"") {
            return run(path.parent().unwrap_or(Path::new("")));
        }
        let skill = read_skill(path)?;
        let skill = SkillSection::of(&skill).map_err(|error| Failure::of_learning(path, &error))?;
        return Ok(Content::Skill { skill });
    }
    if text.is_empty() {
        return Err(invalid("the file is empty".to_owned()));
    }
    if text.contains("[teaching") || text.contains("[[criterion]]") {
        return Err(invalid("this is a scenario: cpdmp validate checks it, cpdmp run carries it out".to_owned()));
    }
    dataset(path)
}

/// The first 64 KiB, enough to know a kind.
fn beginning(path: &Path) -> std::io::Result<String> {
    // Opening a pipe could wait for ever.
    if !std::fs::metadata(path)?.is_file() {
        return Err(std::io::Error::other("no regular file: pipes and devices are not read"));
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(64 << 10).read_to_end(&mut bytes)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

fn dataset(path: &Path) -> Result<Content, Failure> {
    let import = Dataset::import(path).map_err(|error| Failure::of_data(path, &error))?;
    let warnings = import.warnings.iter().map(|warning| format!("warning: {warning}"));
    let notes = import.notes.iter().cloned().chain(warnings).collect();
    Ok(Content::Dataset { data: DataSection::of(&import.dataset, notes) })
}

fn run(folder: &Path) -> Result<Content, Failure> {
    let read = |name: &str| -> Result<Value, Failure> {
        let path = folder.join(name);
        let invalid = |error: String| Failure::new(Outcome::InvalidInput, [format!("{}: {error}", path.display())]);
        let bytes = read_regular(&path).map_err(|error| invalid(error.to_string()))?;
        serde_json::from_slice(&bytes).map_err(|error| invalid(error.to_string()))
    };
    let (manifest, report) = (read("manifest.json")?, read("report.json")?);
    let invalid = |what| Failure::new(Outcome::InvalidInput, [what]);
    let run = RunSection::of(folder, &manifest, &report).map_err(|what| invalid(format!("{}: {what}", folder.display())))?;
    // A manifest of a newer program may say something else by the same words.
    RecordedManifest::read(folder).map_err(invalid)?;
    Ok(Content::Run { run })
}

fn text(path: &Path, content: &Content) -> String {
    let (kind, lines) = match content {
        Content::Skill { skill } => ("skill", skill.lines()),
        Content::Dataset { data } => ("dataset", data.lines()),
        Content::Run { run } => ("run", run.lines()),
        Content::Robot { robot } => ("robot", robot.lines()),
    };
    format!("{}: {kind}\n{}\n", path.display(), lines.join("\n"))
}
