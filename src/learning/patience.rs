//! How long learning may go on.

use super::LearningError;

/// Says whether to go on; asked from several threads, before every part of the work and every iteration of a model. Once it has said no, it
/// says no.
pub type MayGoOn<'a> = &'a (dyn Fn() -> bool + Sync);

/// For those who wait as long as it takes.
pub(crate) const FOR_EVER: MayGoOn<'static> = &|| true;

/// Stops before the next part, unless it may go on.
pub(crate) fn go_on(may_go_on: MayGoOn, next: impl FnOnce() -> String) -> Result<(), LearningError> {
    if may_go_on() { Ok(()) } else { Err(LearningError::Stopped { next: next() }) }
}
