//! Files of an older version brought to this one's, comments and order kept.
//!
//! There is one version of the languages of scenarios and of lists of demonstrations so far. What can be old is a file from before they had a
//! version, whose keys mean what they mean here: it gets one.

use std::path::{Path, PathBuf};

use super::diagnostic::{InvalidScenario, diagnose};
use super::fault::{Code, Fault, Severity};
use super::load::newer_version;
use super::parse;
use super::schema::{SCENARIO, SCHEMA_VERSION};
use super::source::{self, Source, SourceId, Sources};
use super::suggest::{did_you_mean, name_list};
use super::tree::{Node, Value};

/// What has to be done to a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Migration {
    /// Nothing: it is at this version.
    Current,
    /// It is replaced.
    Changed {
        /// The whole text as it has to be.
        text: String,
        /// What differs, one sentence each.
        changes: Vec<String>,
    },
}

impl Migration {
    /// The version of scenarios and of lists of demonstrations that files are brought to.
    pub const VERSION: i64 = SCHEMA_VERSION;

    /// What has to be done to the scenario, or the list of demonstrations, at `path`. Nothing is written.
    ///
    /// # Errors
    /// When the file cannot be read, is something else, or is of a version that this program does not know.
    pub fn of(path: &Path) -> Result<Self, InvalidScenario> {
        let mut sources = Sources::default();
        let mut faults = Vec::new();
        let migration = examine(path, &mut sources, &mut faults);
        let refused = |faults| InvalidScenario(diagnose(faults, &sources));
        if faults.iter().any(|fault| fault.severity == Severity::Error) {
            Err(refused(faults))
        } else {
            migration.ok_or_else(|| refused(Vec::new()))
        }
    }
}

/// `None` only with a fault.
fn examine(path: &Path, sources: &mut Sources, faults: &mut Vec<Fault>) -> Option<Migration> {
    let text = source::read(path).map_err(|fault| faults.push(fault)).ok()?;
    let name = path.display().to_string();
    let source = sources.add(Source { name, directory: PathBuf::new(), text: text.as_str().into(), rank: 0 });
    let tree = parse::document(&text, source, faults);
    if !faults.is_empty() {
        return None;
    }
    if let Some(version) = tree.entry("schema_version") {
        faults.extend(newer_version(&tree).or_else(|| unknown_version(&version.node)));
        return Some(Migration::Current);
    }
    // Whatever it extends says which version it is.
    if tree.entry("extends").is_some() {
        return Some(Migration::Current);
    }
    faults.extend(strangers(&tree, path));
    Some(with_version(&text, &tree, source))
}

/// A version that there has never been.
fn unknown_version(node: &Node) -> Option<Fault> {
    let message = || format!("there has never been such a version: the first one is {SCHEMA_VERSION}");
    (node.value != Value::Integer(SCHEMA_VERSION))
        .then(|| Fault::at(Code::Version, node.origin, message()).expected(SCHEMA_VERSION.to_string()))
}

/// Keys that say that the file is neither a scenario nor a list of demonstrations: it is not ours to change.
fn strangers(tree: &Node, path: &Path) -> Vec<Fault> {
    if tree.entries().is_empty() {
        return vec![Fault::whole_file(Code::MissingKey, path, format!("`{}` holds no key", path.display()))];
    }
    if path.file_name().is_some_and(|name| name == "dataset.toml") || tree.entry("motion").is_some() {
        return Vec::new();
    }
    let known = || SCENARIO.keys.iter().map(|key| key.name);
    let unknown = tree.entries().iter().filter(|entry| known().all(|name| name != entry.key));
    let fault = |key: &str| format!("`{key}` is no key of a scenario or of a list of demonstrations, which is what can be migrated");
    unknown
        .map(|entry| {
            Fault::at(Code::UnknownKey, entry.origin, fault(&entry.key))
                .expected(format!("one of {}", name_list(known())))
                .maybe_help(did_you_mean(&entry.key, known()))
        })
        .collect()
}

/// The text with its version in front of its first key.
fn with_version(text: &str, tree: &Node, source: SourceId) -> Migration {
    let first = tree.entries().iter().map(|entry| entry.origin).filter(|origin| origin.source == source).map(|origin| origin.start).min();
    let start = text[..first.unwrap_or(0)].rfind('\n').map_or(0, |index| index + 1);
    let (before, after) = text.split_at(start);
    let end = if text.contains("\r\n") { "\r\n" } else { "\n" };
    let added = format!("schema_version = {SCHEMA_VERSION}");
    let line = before.matches('\n').count() + 1;
    Migration::Changed { text: format!("{before}{added}{end}{after}"), changes: vec![format!("`{added}` added as line {line}")] }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(name: &str, text: &str) -> Result<Migration, String> {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("written");
        Migration::of(&path).map_err(|invalid| invalid.to_string())
    }

    fn changed(text: &str) -> String {
        match of("a.toml", text).expect("ours") {
            Migration::Changed { text, .. } => text,
            Migration::Current => panic!("nothing was changed"),
        }
    }

    #[test]
    fn the_version_comes_before_the_first_key_and_all_else_stays() {
        assert_eq!(changed("# What\r\nname = \"a\" # why\r\n"), "# What\r\nschema_version = 1\r\nname = \"a\" # why\r\n");
        assert_eq!(changed("[parameters]\na = 1"), "schema_version = 1\n[parameters]\na = 1");
        assert_eq!(changed("[[object]]\nname = \"a\""), "schema_version = 1\n[[object]]\nname = \"a\"");
        assert_eq!(changed("human.help.kind = \"none\""), "schema_version = 1\nhuman.help.kind = \"none\"");
    }

    #[test]
    fn what_is_current_or_says_its_version_elsewhere_stays() {
        for text in ["schema_version = 1\nname = \"a\"", "extends = \"b.toml\""] {
            assert_eq!(of("a.toml", text), Ok(Migration::Current));
        }
        assert!(matches!(of("dataset.toml", "wrench = []"), Ok(Migration::Changed { .. })));
    }

    #[test]
    fn what_is_not_ours_is_refused() {
        for (text, told) in [
            ("schema_version = 2", "version 2"),
            ("schema_version = 0", "never been"),
            ("schema_version = \"1\"", "never been"),
            ("[package]\nname = \"a\"", "`package` is no key"),
            ("", "holds no key"),
            ("=", "not TOML"),
        ] {
            let refused = of("a.toml", text).expect_err(text);
            assert!(refused.contains(told), "{text}: {refused}");
        }
    }
}
