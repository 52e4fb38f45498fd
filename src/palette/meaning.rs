//! What the colours mean, in figures and recordings alike.

use super::{BLUE, BROWN, GREEN, GREY, LIME, MAGENTA, MAROON, ORANGE, PURPLE, Rgb, SKY_BLUE, VERMILION, VIOLET, YELLOW};

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
pub const COMPLIES: Rgb = PURPLE;
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

/// Changes to a run's scenario, as `KEY=VALUE`, that have a colour of their own: another method to learn, and an arm that yields to nothing.
const OWN: [(&str, &str, Named); 2] = [("learning.shaping", "lwr", BESIDE[2]), ("coupling.enabled", "false", BESIDE[3])];

/// The colours of what was executed beside a run, by what each of them changes in its scenario: what is the same has the same colour in every
/// scenario. Up to four are told apart, which is more than stand beside any run.
#[must_use]
pub fn beside<'a>(changes: impl IntoIterator<Item = &'a [String]>) -> Vec<Named> {
    let mut colors: Vec<Option<Named>> = Vec::new();
    for changes in changes {
        let own = own_color(changes).filter(|own| !colors.contains(&Some(*own)));
        colors.push(own);
    }
    let mut free: Vec<Named> = BESIDE.into_iter().filter(|color| !colors.contains(&Some(*color))).rev().collect();
    colors.into_iter().map(|own| own.or_else(|| free.pop()).unwrap_or(BESIDE[0])).collect()
}

/// The colour that one of some changes has for its own.
fn own_color(changes: &[String]) -> Option<Named> {
    let says = |change: &String, key: &str, value: &str| {
        let (said, to) = change.split_once('=').unwrap_or_default();
        said.trim() == key && to.trim().trim_matches(['"', '\'']) == value
    };
    OWN.into_iter().find(|(key, value, _)| changes.iter().any(|change| says(change, key, value))).map(|(.., color)| color)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The names of the colours of what changes so.
    fn names(changes: &[&[&str]]) -> Vec<&'static str> {
        let changes: Vec<Vec<String>> = changes.iter().map(|one| one.iter().map(|change| (*change).to_owned()).collect()).collect();
        beside(changes.iter().map(Vec::as_slice)).into_iter().map(|(_, name)| name).collect()
    }

    /// Contract: the baseline's method and an arm without coupling have their colours wherever they stand, however their change is written.
    #[test]
    fn what_is_the_same_has_the_same_colour() {
        let (lwr, stiff) = (["learning.lwr_ends=regression", "learning.shaping = \"lwr\""], ["coupling.enabled=false"]);
        assert_eq!(names(&[&lwr, &stiff]), ["lime", "magenta"]);
        assert_eq!(names(&[&stiff, &["learning.theta_f=[]"], &lwr]), ["magenta", "brown", "lime"]);
        assert_eq!(names(&[&["seed=1"], &stiff]), ["brown", "magenta"]);
        assert_eq!(names(&[&["coupling.enabled=true"]]), ["brown"]);
    }

    /// Contract: no two of up to four have one colour, and none has that of anything else.
    #[test]
    fn what_differs_has_different_colours() {
        let stiff: &[&str] = &["coupling.enabled=false"];
        for changes in [[&["seed=1"][..]; 4], [stiff; 4], [stiff, &["seed=1"], stiff, &["seed=2"]]] {
            let mut found = names(&changes);
            found.sort_unstable();
            assert_eq!(found, ["brown", "lime", "magenta", "maroon"]);
        }
        let others = [TAUGHT, PLANNED, EXECUTED, STIFF, COMPLIES, MINIMISES, MEASURED, EXPECTED, PERSON];
        assert!(BESIDE.iter().all(|(color, _)| !others.contains(color)));
    }
}
