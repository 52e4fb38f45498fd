//! The traces of a run: of every world that was simulated, and of what was learned in between.

use std::ops::RangeInclusive;

use twox_hash::XxHash3_64;

use crate::world::StateTrace;

/// What is kept of the states of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TraceSettings {
    /// Steps between two hashes; 0 keeps none. Default 100.
    pub every_steps: u64,
    /// Steps of the execution between two snapshots, from which it can be taken up; 0 makes none. Default 5000.
    pub snapshot_every_steps: u64,
    /// A stretch of which whole states are kept.
    pub detail: Option<TraceDetail>,
}

/// A stretch of steps of one world.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TraceDetail {
    /// The phase.
    pub phase: String,
    /// The world's number in it.
    pub number: u64,
    /// The steps.
    pub steps: RangeInclusive<u64>,
}

/// The trace of one world, or of something else that a run made.
#[derive(Clone, Debug, PartialEq)]
pub struct WorldTrace {
    /// `teach`, `replay`, `learn` or `execute`; for planar experiments `show`, `learn` or `move`.
    pub phase: String,
    /// Its number in the phase.
    pub number: u64,
    /// What was kept.
    pub trace: StateTrace,
}

impl Default for TraceSettings {
    fn default() -> Self {
        Self { every_steps: 100, snapshot_every_steps: 5000, detail: None }
    }
}

impl TraceSettings {
    /// The steps of that world of which whole states are kept.
    pub(super) fn detail_of(&self, phase: &str, number: u64) -> Option<RangeInclusive<u64>> {
        self.detail.as_ref().filter(|detail| detail.phase == phase && detail.number == number).map(|detail| detail.steps.clone())
    }
}

impl WorldTrace {
    /// The trace of a world, unless nothing was kept.
    pub(super) fn of(phase: &str, number: u64, trace: StateTrace) -> Option<Self> {
        (!trace.steps.is_empty()).then(|| Self { phase: phase.to_owned(), number, trace })
    }

    /// The part that comes after `step` of the execution; of anything else nothing.
    #[must_use]
    pub fn after(&self, step: u64) -> Option<Self> {
        (self.phase == "execute").then(|| Self { trace: self.trace.after(step), ..self.clone() })
    }

    /// The trace of a text that a run made.
    pub(super) fn of_text(phase: &str, name: &str, text: &str) -> Self {
        let hash = XxHash3_64::oneshot(text.as_bytes());
        let mut trace = StateTrace { bodies: vec![name.to_owned()], ..StateTrace::default() };
        trace.push(0, hash, std::iter::once([hash as u32, 0, 0, 0]));
        Self { phase: phase.to_owned(), number: 0, trace }
    }
}
