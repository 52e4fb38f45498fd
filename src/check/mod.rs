//! Judges a run from what it left behind: step records, contacts, clearances, where things ended. Never asks the engine or the controller.

mod allowed_contact;
mod criterion;
mod door;
mod judge;
mod judge_motion;
mod judge_objects;
mod judge_planar;
mod limit;
mod place;
mod planar_trace;
mod replay_difference;
mod tool_force;
mod windows;

pub use allowed_contact::{AllowedContact, allow};
pub use criterion::{CountsFrom, Criterion, CriterionKind, CriterionSpec, Expectation, Followed, PlanarSettings};
pub use judge::judge;
pub use judge_motion::{judge_motion, not_judged};
pub use judge_planar::judge_planar;
pub use limit::Limit;
pub use place::Place;
pub use planar_trace::planar_traces;
pub use replay_difference::{DifferenceKind, ReplayDifference, exact_difference, first_difference};
pub use windows::{Window, compliance_windows, human_windows};
