//! Why a recording or a step log could not be written or read.

use std::path::PathBuf;

/// Why a recording or a step log could not be written or read. The run itself is not affected.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    /// The file system refused.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The Parquet library failed.
    #[error("{}: {source}", path.display())]
    Parquet {
        /// The file.
        path: PathBuf,
        /// What it said.
        source: parquet::errors::ParquetError,
    },
    /// The file is no step log that can be read.
    #[error("{}: {message}", path.display())]
    StepLog {
        /// The file.
        path: PathBuf,
        /// What is wrong, and what was expected.
        message: String,
    },
    /// The rerun writer failed.
    #[error("{}: {source}", path.display())]
    Rerun {
        /// The file.
        path: PathBuf,
        /// What the writer said.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
}
