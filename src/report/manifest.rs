//! `manifest.json`: what a run was made from, so that it can be made again.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::Serialize;
use twox_hash::XxHash3_64;

/// The version of this format.
pub const MANIFEST_VERSION: u32 = 1;

/// What marks a folder as one of ours.
pub(super) const FORMAT: &str = "cpdmp-run";

/// What a run was made from.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Manifest {
    /// Always `cpdmp-run`.
    pub format: &'static str,
    /// Version of this format.
    pub schema_version: u32,
    /// Version of the program.
    pub version: &'static str,
    /// Name of the scenario.
    pub scenario: String,
    /// Its seed.
    pub seed: u64,
    /// How the run ended.
    pub outcome: super::Outcome,
    /// Hash over every body's state at every step.
    pub state_hash: Option<String>,
    /// The command line.
    pub command: Vec<String>,
    /// The folder in which it was given.
    pub directory: Option<PathBuf>,
    /// When it began (s since 1970-01-01 UTC).
    pub started_unix_s: Option<u64>,
    /// XXH3-64 of the `scenario.toml` in the folder, in hexadecimal.
    pub scenario_xxh3_64: Option<String>,
    /// The same of its `report.json`.
    pub report_xxh3_64: Option<String>,
    /// The same of its `steps.parquet`; `null` when there is none.
    pub steps_xxh3_64: Option<String>,
    /// What else it left that a repetition is held against or taken up from, or figures are drawn from, as paths in the folder.
    pub left: Vec<FileHash>,
    /// The files that decide the run.
    pub inputs: Vec<FileHash>,
    /// Where it ran.
    pub host: Host,
}

/// One file of a run: what decided it, or what it left.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct FileHash {
    /// Its path: as the scenario names it, or in the folder of the run.
    pub path: PathBuf,
    /// Its length in bytes; `null` if it could not be read again.
    pub bytes: Option<u64>,
    /// XXH3-64 of its bytes, in hexadecimal.
    pub xxh3_64: Option<String>,
}

/// The machine that ran it. Equal hashes are promised for equal architectures.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Host {
    /// Operating system.
    pub os: &'static str,
    /// Processor architecture.
    pub arch: &'static str,
    /// Processor cores that the program could use.
    pub cores: Option<usize>,
}

impl Host {
    /// This machine.
    #[must_use]
    pub fn this() -> Self {
        let cores = std::thread::available_parallelism().ok().map(usize::from);
        Self { os: std::env::consts::OS, arch: std::env::consts::ARCH, cores }
    }
}

impl Manifest {
    /// The manifest of a run with that report; the caller adds what only it knows.
    pub fn new(report: &super::RunReport) -> Self {
        Self {
            format: FORMAT,
            schema_version: MANIFEST_VERSION,
            version: report.version,
            scenario: report.scenario.clone(),
            seed: report.seed,
            outcome: report.outcome,
            state_hash: report.state_hash.clone(),
            command: Vec::new(),
            directory: None,
            started_unix_s: None,
            scenario_xxh3_64: None,
            report_xxh3_64: None,
            steps_xxh3_64: None,
            left: Vec::new(),
            inputs: Vec::new(),
            host: Host::this(),
        }
    }

    /// The manifest as `manifest.json`.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a manifest holds nothing that JSON cannot") + "\n"
    }
}

/// What a file holds. A pipe could keep its reader waiting for ever, and a device has no end: they are refused.
///
/// # Errors
/// When it is no regular file or cannot be read.
pub fn read_regular(path: &Path) -> std::io::Result<Vec<u8>> {
    if !std::fs::metadata(path)?.is_file() {
        return Err(std::io::Error::other("it is no regular file"));
    }
    std::fs::read(path)
}

/// Length and hash of a file.
pub fn hash_file(path: &Path) -> FileHash {
    let bytes = read_regular(path).ok();
    FileHash { path: path.to_path_buf(), bytes: bytes.as_ref().map(|bytes| bytes.len() as u64), xxh3_64: bytes.as_deref().map(hash_bytes) }
}

/// XXH3-64 of what a file holds, in hexadecimal.
#[must_use]
pub fn hash_bytes(bytes: &[u8]) -> String {
    format!("{:016x}", XxHash3_64::oneshot(bytes))
}
