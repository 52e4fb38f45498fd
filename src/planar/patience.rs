//! How long an experiment may go on.

use crate::learning::LearningError;

/// Says whether an experiment may go on; asked from several threads.
pub type MayGoOn<'a> = &'a (dyn Fn() -> bool + Sync);

/// Stops the experiment before its next part, unless it may go on.
pub(super) fn go_on(may_go_on: MayGoOn, next: impl FnOnce() -> String) -> Result<(), LearningError> {
    if may_go_on() { Ok(()) } else { Err(LearningError::Stopped { next: next() }) }
}
