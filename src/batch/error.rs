//! Why a sweep or a merge cannot go on.

use std::io;
use std::path::{Path, PathBuf};

use crate::report::{Outcome, OutputError};
use crate::scenario::InvalidMember;

/// Why a sweep or a merge cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum BatchError {
    /// The output cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// There is a sweep already, and nobody said that it should go on.
    #[error("{} holds a sweep already: --resume goes on with it; otherwise move it away, or choose another --out", .0.display())]
    Begun(PathBuf),
    /// There is nothing to go on with: the sweep that is there is another one.
    #[error("{} holds another sweep ({what}): go on with the scenario and flags that it began with, or choose another --out", path.display())]
    Another {
        /// The folder.
        path: PathBuf,
        /// In what it differs.
        what: String,
    },
    /// A file cannot be read.
    #[error("{} cannot be read: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A table is not one of ours, or was cut short.
    #[error("{} is not a table of a sweep: {what}", path.display())]
    NotATable {
        /// The file.
        path: PathBuf,
        /// What is odd about it.
        what: String,
    },
    /// Tables do not make a whole.
    #[error("the tables do not make one sweep: {0}")]
    NotAWhole(String),
    /// A member that was good when the sweep began is not any more.
    #[error("{0}: a file that it needs has changed since the sweep began")]
    Gone(Box<InvalidMember>),
    /// A table cannot be written.
    #[error("{} cannot be written: {source}", path.display())]
    Table {
        /// The file.
        path: PathBuf,
        /// What the library said.
        source: parquet::errors::ParquetError,
    },
}

impl BatchError {
    /// How a command ends that meets this error.
    pub fn outcome(&self) -> Outcome {
        match self {
            Self::Output(error) => error.outcome(),
            Self::Begun(_) | Self::Table { .. } => Outcome::OutputFailed,
            Self::Another { .. } | Self::Read { .. } | Self::NotATable { .. } | Self::NotAWhole(_) | Self::Gone(_) => Outcome::InvalidInput,
        }
    }

    pub(super) fn reading(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_path_buf();
        move |source| Self::Read { path, source }
    }

    pub(super) fn writing(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_path_buf();
        move |source| Self::Output(OutputError::Io { path, source })
    }
}
