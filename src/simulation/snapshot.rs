//! Snapshots of an execution: everything that the next step depends on, so that a run can be taken up in the middle.

use serde::{Deserialize, Serialize};
use twox_hash::XxHash3_64;

use super::SimulationError;
use super::execution::Sums;
use super::person::PersonSnapshot;
use crate::control::ControllerSnapshot;
use crate::world::{WorldSnapshot, WorldState};

/// An execution between two steps. What is inside is understood by the program that made it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Snapshot {
    /// Steps that the engine had made.
    pub step: u64,
    bytes: Vec<u8>,
}

/// The snapshots of one execution, in the order of their steps.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Snapshots {
    /// Version of the program that made them.
    version: String,
    /// The snapshots.
    pub all: Vec<Snapshot>,
}

/// What a snapshot is made of, borrowed from what runs.
#[derive(Serialize)]
pub(super) struct Kept<'a> {
    pub world: WorldState<'a>,
    pub rest: Rest,
}

/// What an execution goes on from.
#[derive(Deserialize)]
pub(super) struct TakenUp {
    pub world: WorldSnapshot,
    pub rest: Rest,
}

/// What an execution goes on from, beside the world.
#[derive(Serialize, Deserialize)]
pub(super) struct Rest {
    pub controller: ControllerSnapshot,
    pub person: PersonSnapshot,
    /// How far the stream of the sensors' noise has been used (words).
    pub noise_words: u128,
    pub sums: Sums,
}

impl Snapshot {
    /// Keeps what there is after `step` steps.
    pub(super) fn of(step: u64, kept: &Kept) -> Result<Self, SimulationError> {
        let bytes = postcard::to_allocvec(kept).map_err(|error| SimulationError::Snapshot(error.to_string()))?;
        Ok(Self { step, bytes })
    }

    /// What was kept.
    pub(super) fn open(&self) -> Result<TakenUp, SimulationError> {
        postcard::from_bytes(&self.bytes).map_err(|error| SimulationError::Snapshot(error.to_string()))
    }
}

/// Length of the checksum in front of the rest (bytes).
const CHECKSUM: usize = 8;

impl Snapshots {
    /// None yet.
    #[must_use]
    pub fn new() -> Self {
        Self { version: env!("CARGO_PKG_VERSION").to_owned(), all: Vec::new() }
    }

    /// As bytes: XXH3 (64 bits, little-endian) of what follows, then everything in postcard's format.
    ///
    /// # Errors
    /// When the serializer refuses.
    pub fn to_bytes(&self) -> Result<Vec<u8>, SimulationError> {
        let body = postcard::to_allocvec(self).map_err(|error| SimulationError::Snapshot(error.to_string()))?;
        Ok([&XxHash3_64::oneshot(&body).to_le_bytes(), body.as_slice()].concat())
    }

    /// From those bytes.
    ///
    /// # Errors
    /// When they are damaged, or another version of the program made them.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, SimulationError> {
        let refused = |what: &str| SimulationError::Snapshot(what.to_owned());
        let (checksum, body) = bytes.split_at_checked(CHECKSUM).ok_or_else(|| refused("the file is cut short"))?;
        if XxHash3_64::oneshot(body).to_le_bytes() != checksum {
            return Err(refused("the file is damaged: its checksum is another one"));
        }
        let read: Self = postcard::from_bytes(body).map_err(|error| refused(&error.to_string()))?;
        if read.version != env!("CARGO_PKG_VERSION") {
            return Err(refused(&format!("made by cpdmp {}, which keeps states in its own way", read.version)));
        }
        Ok(read)
    }

    /// The last one that was made up to `step`.
    #[must_use]
    pub fn up_to(&self, step: u64) -> Option<&Snapshot> {
        self.all.iter().rev().find(|snapshot| snapshot.step <= step)
    }
}
