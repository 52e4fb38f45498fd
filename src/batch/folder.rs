//! The folder of a sweep: what was asked, the row log, and at the end the table.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::row_log::RowLog;
use super::table::{Head, cells, columns};
use super::table_file::write_table;
use super::{BatchError, Plan, Row, Shard, Summary};
use crate::report::{Lock, OutputError, lock_beside};

/// What marks a folder as that of a sweep.
const FORMAT: &str = "cpdmp-sweep";
const ABOUT: &str = "sweep.json";
const ROWS: &str = "rows.jsonl";
const TABLE: &str = "sweep.parquet";

/// `sweep.json`: which sweep the folder holds.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct About {
    format: String,
    schema_version: u32,
    version: String,
    scenario: String,
    sweep_hash: String,
    members: u64,
    shard: String,
    command: Vec<String>,
}

/// The folder of a sweep that is being made. It belongs to this process while this value lives.
#[derive(Debug)]
pub struct SweepFolder {
    path: PathBuf,
    /// What was done so far.
    pub log: RowLog,
    _lock: Lock,
}

impl SweepFolder {
    /// Takes the folder `path` for that part of a sweep, begun by `command`; with `resume`, goes on with what is there.
    ///
    /// # Errors
    /// When the folder is in use, holds something else or another sweep, or holds this one and nobody said that it should go on.
    pub fn open(path: &Path, plan: &Plan, shard: Shard, resume: bool, command: Vec<String>) -> Result<Self, BatchError> {
        let about = About {
            format: FORMAT.to_owned(),
            schema_version: 1,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            scenario: plan.scenario.clone(),
            sweep_hash: plan.hash.clone(),
            members: plan.members,
            shard: shard.to_string(),
            command,
        };
        let lock = lock_beside(path)?;
        match found(path)? {
            None => begin(path, &about)?,
            Some(_) if !resume => return Err(BatchError::Begun(path.to_path_buf())),
            Some(there) => same(path, &there, &about)?,
        }
        let log = RowLog::open(&path.join(ROWS), plan.members)?;
        Ok(Self { path: path.to_path_buf(), log, _lock: lock })
    }

    /// Writes the table from the log, in the order of the members: beside its place first, then renamed.
    ///
    /// # Errors
    /// When a row is missing or the file system refuses.
    pub fn finish(&self, plan: &Plan, shard: Shard) -> Result<(PathBuf, Summary), BatchError> {
        let target = self.path.join(TABLE);
        let head = Head {
            scenario: plan.scenario.clone(),
            hash: plan.hash.clone(),
            members: plan.members,
            shard: (!shard.is_whole()).then(|| shard.to_string()),
            columns: columns(&plan.keys, &plan.criteria),
        };
        let mut summary = Summary::new(&plan.criteria);
        let rows = shard.indices(plan.members).map(|index| {
            let missing = || BatchError::NotAWhole(format!("the row of member {index} is missing"));
            let row: Row = self.log.row(index)?.ok_or_else(missing)?;
            summary.add(&row);
            Ok(cells(&row, plan.criteria.len()))
        });
        write_table(&target, &head, rows)?;
        Ok((target, summary))
    }
}

/// The sweep that the folder holds, if it holds one; an error if it holds something else.
fn found(path: &Path) -> Result<Option<About>, BatchError> {
    let not_ours = || OutputError::NotOurs { path: path.to_path_buf(), what: "the folder of a sweep" };
    match fs::read_to_string(path.join(ABOUT)) {
        Ok(text) => match serde_json::from_str::<About>(&text) {
            Ok(about) if about.format == FORMAT => Ok(Some(about)),
            _ => Err(not_ours().into()),
        },
        Err(_) => {
            let Ok(mut entries) = fs::read_dir(path) else {
                return if path.symlink_metadata().is_ok() { Err(not_ours().into()) } else { Ok(None) };
            };
            // A sweep that was killed while it began leaves nothing but the file that was to become `sweep.json`.
            let ours = |name: &std::ffi::OsStr| name.to_string_lossy().starts_with(ABOUT);
            let foreign = entries.any(|entry| entry.is_ok_and(|entry| !ours(&entry.file_name())));
            if foreign { Err(not_ours().into()) } else { Ok(None) }
        }
    }
}

fn begin(path: &Path, about: &About) -> Result<(), BatchError> {
    fs::create_dir_all(path).map_err(BatchError::writing(path))?;
    let target = path.join(ABOUT);
    let beside = path.join(format!("{ABOUT}.partial"));
    let text = serde_json::to_string_pretty(about).expect("this holds nothing that JSON cannot") + "\n";
    let write = || {
        let mut file = File::create(&beside)?;
        file.write_all(text.as_bytes())?;
        file.sync_all()?;
        fs::rename(&beside, &target)
    };
    write().map_err(BatchError::writing(&target))
}

/// Whether what is there is what is asked for.
fn same(path: &Path, there: &About, asked: &About) -> Result<(), BatchError> {
    let differs = |what: String| Err(BatchError::Another { path: path.to_path_buf(), what });
    if there.version != asked.version {
        return differs(format!("made by cpdmp {}, this is {}", there.version, asked.version));
    }
    if there.members != asked.members {
        return differs(format!("it has {} members, this one {}", there.members, asked.members));
    }
    if there.sweep_hash != asked.sweep_hash {
        return differs("its scenarios, the files that they use or its time limit are not the same".to_owned());
    }
    if there.shard != asked.shard {
        return differs(format!("it is shard {}, this one {}", there.shard, asked.shard));
    }
    Ok(())
}
