//! Many runs: the members of a sweep on several threads, one row per member, resumable at any moment.
//!
//! A [`Plan`] is a sweep whose every member was checked; its hash says which sweep it is. [`execute()`] runs the members of one [`Shard`] and
//! appends a checked line per finished member to the row log, on the disk before the next one is counted, so that a killed sweep loses what was
//! running and nothing else. [`SweepFolder::finish`] writes the table from the log, in the order of the members: it does not depend on the
//! number of threads, on interruptions, or (after [`merge()`]) on how the members were dealt out to machines.

mod cell;
mod error;
mod execute;
mod folder;
mod merge;
mod plan;
mod row;
mod row_log;
mod shard;
mod summary;
mod table;
mod table_file;

pub use cell::{Cell, CellKind};
pub use error::BatchError;
pub use execute::{Pace, Runner, execute};
pub use folder::SweepFolder;
pub use merge::{MergedRows, merge};
pub use plan::{NotReady, Plan, Terms};
pub use row::{CriterionCell, Row};
pub use shard::Shard;
pub use summary::{CriterionSummary, FirstFailure, Summary};
pub use table::{Column, columns};
