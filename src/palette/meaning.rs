//! What the colours mean, in figures and recordings alike.

use super::{BLUE, BROWN, GREEN, GREY, LIME, MAGENTA, MAROON, ORANGE, PINK, Rgb, SKY_BLUE, VERMILION, VIOLET, YELLOW};

/// What was taught.
pub const TAUGHT: Rgb = GREY;
/// What the skill generates for a setting without any force.
pub const PLANNED: Rgb = SKY_BLUE;
/// What the baseline generates for it: as what it executes beside a run.
pub const BASELINE: Rgb = LIME;
/// What was executed.
pub const EXECUTED: Rgb = ORANGE;
/// A stiff state.
pub const STIFF: Rgb = GREEN;
/// A state that complies.
pub const COMPLIES: Rgb = PINK;
/// A state that minimises the force error.
pub const MINIMISES: Rgb = VIOLET;
/// A force as it is measured.
pub const MEASURED: Rgb = BLUE;
/// A force as it is expected.
pub const EXPECTED: Rgb = YELLOW;
/// What the person does.
pub const PERSON: Rgb = VERMILION;

/// A colour with its name.
pub type Named = (Rgb, &'static str);

/// The colours of what was executed beside a run. Those of changes that are made again and again come last: others take them when nothing else
/// is left.
const BESIDE: [Named; 4] = [(BROWN, "brown"), (MAROON, "maroon"), (LIME, "lime"), (MAGENTA, "magenta")];

/// What makes an execution beside a run another one than the run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Difference {
    /// The baseline's method to learn.
    Method,
    /// An arm that yields to nothing.
    Coupling,
    /// Anything else.
    Other,
}

impl Difference {
    /// Those that are made again and again have a colour of their own.
    fn own_color(self) -> Option<Named> {
        match self {
            Self::Method => Some(BESIDE[2]),
            Self::Coupling => Some(BESIDE[3]),
            Self::Other => None,
        }
    }
}

/// The colours of what was executed beside a run, by what makes each of them another: what is the same has the same colour in every scenario. Up to
/// four are told apart, which is more than stand beside any run.
#[must_use]
pub fn beside(differences: impl IntoIterator<Item = Difference>) -> Vec<Named> {
    let mut colors: Vec<Option<Named>> = Vec::new();
    for difference in differences {
        let own = difference.own_color().filter(|own| !colors.contains(&Some(*own)));
        colors.push(own);
    }
    let mut free: Vec<Named> = BESIDE.into_iter().filter(|color| !colors.contains(&Some(*color))).rev().collect();
    colors.into_iter().map(|own| own.or_else(|| free.pop()).unwrap_or(BESIDE[0])).collect()
}

#[cfg(test)]
mod tests {
    use super::Difference::{Coupling, Method, Other};
    use super::*;

    fn names(differences: &[Difference]) -> Vec<&'static str> {
        beside(differences.iter().copied()).into_iter().map(|(_, name)| name).collect()
    }

    /// Contract: the baseline's method and an arm without coupling have their colours wherever they stand.
    #[test]
    fn what_is_the_same_has_the_same_colour() {
        assert_eq!(names(&[Method, Coupling]), ["lime", "magenta"]);
        assert_eq!(names(&[Coupling, Other, Method]), ["magenta", "brown", "lime"]);
        assert_eq!(names(&[Other, Coupling]), ["brown", "magenta"]);
    }

    /// Contract: no two of up to four have one colour, and none has that of anything else.
    #[test]
    fn what_differs_has_different_colours() {
        for differences in [[Other; 4], [Coupling; 4], [Coupling, Other, Coupling, Other]] {
            let mut found = names(&differences);
            found.sort_unstable();
            assert_eq!(found, ["brown", "lime", "magenta", "maroon"]);
        }
        let others = [TAUGHT, PLANNED, EXECUTED, STIFF, COMPLIES, MINIMISES, MEASURED, EXPECTED, PERSON];
        assert!(BESIDE.iter().all(|(color, _)| !others.contains(color)));
    }
}
