//! What the folder of a run says to those who want to make it again.

use std::path::{Path, PathBuf};

use serde_json::Value;

use super::beginning::Beginning;
use super::files::{REPORT, STATE_LOG, STEP_LOG};
use crate::recording::read_state_log;
use crate::report::{Host, MANIFEST_VERSION, hash_file, read_regular};
use crate::scenario::{LoadOptions, Scenario};
use crate::simulation::WorldTrace;

/// The scenario of a run, in its folder.
pub(super) const SCENARIO: &str = "scenario.toml";

/// The manifest of a run.
#[derive(Clone)]
pub(super) struct RecordedManifest(Value);

/// What the folder of a run says about it, for those who compare with it.
#[derive(Clone)]
pub(super) struct Recorded {
    manifest: RecordedManifest,
    /// Hash over every state of the run.
    pub state_hash: String,
    /// Hashes on the way, world by world.
    pub traces: Vec<WorldTrace>,
}

impl RecordedManifest {
    /// Reads it from the folder, or says why that is no run.
    pub fn read(folder: &Path) -> Result<Self, String> {
        let place = folder.join("manifest.json");
        let text = read_regular(&place)
            .and_then(|bytes| String::from_utf8(bytes).map_err(std::io::Error::other))
            .map_err(|error| format!("{} is no run: {}: {error}", folder.display(), place.display()))?;
        let manifest: Value = serde_json::from_str(&text).unwrap_or_default();
        if manifest["format"] != "cpdmp-run" {
            return Err(format!("{} is not the folder of a run", folder.display()));
        }
        let version = &manifest["schema_version"];
        let is_known = version.is_null() || version.as_u64().is_some_and(|version| version <= u64::from(MANIFEST_VERSION));
        if !is_known {
            let place = place.display();
            return Err(format!("{place} is of version {version}, and this program reads version {MANIFEST_VERSION}: use a newer cpdmp"));
        }
        Ok(Self(manifest))
    }

    /// Its seed.
    pub fn seed(&self) -> Option<u64> {
        self.0["seed"].as_u64()
    }

    /// Why the scenario in the folder is not the one that was run, if it is not. A run that was made before hashes were kept has none.
    pub fn edited(&self, folder: &Path) -> Option<String> {
        let (path, ran) = (folder.join(SCENARIO), self.0["scenario_xxh3_64"].as_str()?);
        let is_other = hash_file(&path).xxh3_64.is_some_and(|found| found != ran);
        let help = "restore the file, give other values with --set KEY=VALUE, or run it as it is now";
        let again = || format!("cpdmp run {} --out ANOTHER_FOLDER", path.display());
        is_other.then(|| format!("this is not the scenario that was run, it has been edited since: {help}: `{}`", again()))
    }

    /// The first file of its folder among `needed` (a folder stands for what is in it) that is not as the run wrote it, and what to do, if there
    /// is one. A run that was made before hashes were kept has none.
    pub fn altered(&self, folder: &Path, needed: &[&str]) -> Option<(PathBuf, String)> {
        let kept = [(REPORT, "report_xxh3_64"), (STEP_LOG, "steps_xxh3_64")].map(|(name, key)| (name, self.0[key].as_str()));
        let left = self.0["left"].as_array().map_or(&[][..], Vec::as_slice);
        let left = left.iter().filter_map(|file| Some((file["path"].as_str()?, file["xxh3_64"].as_str())));
        let is_needed = |name: &str| needed.iter().any(|needed| Path::new(name).starts_with(needed));
        let (path, is_there) = kept.into_iter().chain(left).filter(|(name, _)| is_needed(name)).find_map(|(name, written)| {
            let (path, written) = (folder.join(name), written?);
            let found = hash_file(&path).xxh3_64;
            (found.as_deref() != Some(written)).then_some((path, found.is_some()))
        })?;
        let what = if is_there { "it has been edited or cut since" } else { "it is gone or cannot be read" };
        let again = format!("cpdmp run {} --out ANOTHER_FOLDER", folder.join(SCENARIO).display());
        Some((path, format!("this is not the file that the run wrote, {what}: restore it, or make the run again: `{again}`")))
    }

    /// The files that decided the run, as they are found from here, with the hash that each had.
    fn inputs(&self) -> Vec<(PathBuf, Option<&str>)> {
        let directory = Path::new(self.0["directory"].as_str().unwrap_or_default());
        let inputs = self.0["inputs"].as_array().map_or(&[][..], Vec::as_slice);
        let input = |input: &'_ Value| Some(directory.join(input["path"].as_str()?));
        inputs.iter().filter_map(|found| Some((input(found)?, found["xxh3_64"].as_str()))).collect()
    }

    /// Those of the files that are not as they were. The scenario's own do not matter: what they said is in the folder's scenario.toml.
    pub fn changed_inputs(&self) -> impl Iterator<Item = PathBuf> {
        let decisive = self.inputs().into_iter().filter(|(path, _)| path.extension().is_none_or(|extension| extension != "toml"));
        decisive.filter(|(path, hash)| hash_file(path).xxh3_64.as_deref() != *hash).map(|(path, _)| path)
    }

    /// The options, with the folders of those files allowed: the run was allowed to use them.
    pub fn may_use(&self, options: &LoadOptions) -> LoadOptions {
        let folders = self.inputs().into_iter().filter_map(|(path, _)| Some(path.parent()?.to_path_buf()));
        let mut allowed = options.clone();
        allowed.asset_roots.extend(folders);
        allowed
    }
}

impl Recorded {
    /// Reads the folder, or says why it holds no run that can be compared with, or not with what of it is `needed`.
    pub fn read(folder: &Path, needed: &[&str]) -> Result<Self, String> {
        let manifest = RecordedManifest::read(folder)?;
        if let Some((path, altered)) = manifest.altered(folder, needed) {
            return Err(format!("{}: {altered}", path.display()));
        }
        if let Some(edited) = manifest.edited(folder) {
            return Err(format!("{}: {edited}", folder.join(SCENARIO).display()));
        }
        let Some(state_hash) = manifest.0["state_hash"].as_str().map(str::to_owned) else {
            return Err(format!("{} holds a run that did not come to its end: there is nothing to compare with", folder.display()));
        };
        let traces = match read_state_log(&folder.join(STATE_LOG)) {
            Ok(traces) => traces,
            // A run may be recorded without them; its last hash is in the manifest.
            Err(_) if !folder.join(STATE_LOG).exists() => Vec::new(),
            Err(error) => return Err(error.to_string()),
        };
        Ok(Self { manifest, state_hash, traces })
    }

    /// The part of it that a repetition from there on is held against.
    pub fn from(&self, begin: Option<&Beginning>) -> Result<Self, String> {
        let Some(begin) = begin else { return Ok(self.clone()) };
        let traces: Vec<WorldTrace> = match begin.step() {
            Some(step) => self.traces.iter().filter_map(|world| world.after(step)).collect(),
            // The hash of the skill is part of both: it tells whether the folder's skill is the one that was learned.
            None => self.traces.iter().filter(|world| ["learn", "execute"].contains(&world.phase.as_str())).cloned().collect(),
        };
        if traces.is_empty() {
            return Err(
                "the run kept no hashes on the way (`recording.hash_every_steps`): make it again as a whole, without --from".to_owned()
            );
        }
        Ok(Self { state_hash: last_hash(&traces), traces, manifest: self.manifest.clone() })
    }

    /// See [`RecordedManifest::may_use`].
    pub fn may_use(&self, options: &LoadOptions) -> LoadOptions {
        self.manifest.may_use(options)
    }

    /// Why bits may differ, as far as the folder tells; `changed` says whether flags make another run of it.
    pub fn reasons(&self, changed: bool) -> Vec<String> {
        let mut reasons = Vec::new();
        if changed {
            reasons.push("flags (or CPDMP_* variables) make it another run than the recorded one".to_owned());
        }
        reasons.extend(self.manifest.changed_inputs().map(|path| format!("{} has changed since the run", path.display())));
        let text = |value: &Value| value.as_str().unwrap_or("unknown").to_owned();
        let (version, host) = (text(&self.manifest.0["version"]), Host::this());
        let arch = text(&self.manifest.0["host"]["arch"]);
        if version != env!("CARGO_PKG_VERSION") || arch != host.arch {
            let this = format!("cpdmp {} on {}", env!("CARGO_PKG_VERSION"), host.arch);
            reasons.push(format!("made by cpdmp {version} on {arch}, repeated by {this}: equal bits are promised for the same program on the same architecture only"));
        }
        if reasons.is_empty() {
            reasons.push("same version, architecture and input: equal bits are promised for the same binary, so this is another build, or a bug to report".to_owned());
        }
        reasons
    }
}

/// The scenario in the folder of a run, `path`, without what flags change in it; nothing when it cannot be used without them.
pub(super) fn as_recorded(path: &Path, options: &LoadOptions) -> Option<Scenario> {
    Scenario::load(path, &options.without_overrides()).ok()
}

/// Whether `asked` is another scenario than the one that was run. A flag that says what the run was told anyway changes nothing.
pub(super) fn is_changed(recorded: Option<&Scenario>, asked: &Scenario) -> bool {
    recorded.is_none_or(|recorded| recorded.resolved != asked.resolved)
}

/// The last hash of the last world.
pub(super) fn last_hash(traces: &[WorldTrace]) -> String {
    let last = traces.last().and_then(|world| world.trace.hashes.last());
    last.map_or_else(String::new, |hash| format!("{hash:016x}"))
}
