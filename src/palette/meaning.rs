//! What the colours mean, in figures and recordings alike.

use super::{BLACK, BLUE, BROWN, GREEN, GREY, MAGENTA, ORANGE, PURPLE, Rgb, SKY_BLUE, VERMILION, VIOLET, YELLOW};

/// What was taught.
pub const TAUGHT: Rgb = GREY;
/// What the skill generates for a setting without any force.
pub const PLANNED: Rgb = SKY_BLUE;
/// What the baseline generates for it.
pub const BASELINE: Rgb = BLACK;
/// What was executed.
pub const EXECUTED: Rgb = ORANGE;
/// What was executed beside it, in order, with the colours' names.
pub const BESIDE: [(Rgb, &str); 2] = [(MAGENTA, "magenta"), (BROWN, "brown")];
/// A stiff state.
pub const STIFF: Rgb = GREEN;
/// A state that complies.
pub const COMPLIES: Rgb = PURPLE;
/// A state that minimises the force error.
pub const MINIMISES: Rgb = VIOLET;
/// A force as it is measured.
pub const MEASURED: Rgb = BLUE;
/// A force as it is expected.
pub const EXPECTED: Rgb = YELLOW;
/// What the person does.
pub const PERSON: Rgb = VERMILION;
