//! The tables of keys of `[[sweep]]`, what varies from run to run, and `[[beside]]`, what varies beside one run.

use super::key::Kind::{Count, Name, Ranges, Tag, Text, Texts, Values};
use super::key::{Key, Shape, Variant};

/// Most values of one entry of a sweep.
const MOST: i64 = 1_000_000;

const RANGES: Key = Key::new("ranges", Ranges, "keys of the scenario, each with [min, max]");

/// One entry of a sweep. Entries are combined each with each; the last one varies fastest.
pub(super) const SWEEP: Shape = Shape {
    keys: &[Key::new("kind", Tag, "how values are chosen")],
    variants: &[
        Variant {
            kind: "grid",
            keys: &[
                Key::new("key", Text, "the key of the scenario that varies, as `--set` names it"),
                Key::new("values", Values, "its values, one after the other"),
            ],
        },
        Variant { kind: "uniform", keys: &[RANGES, Key::new("count", Count(1, MOST), "how many points are drawn, each on its own")] },
        Variant {
            kind: "latin_hypercube",
            keys: &[RANGES, Key::new("count", Count(1, MOST), "how many points are drawn, one in each slice of every range")],
        },
        Variant { kind: "repeat", keys: &[Key::new("count", Count(1, MOST), "how many seeds, from the scenario's seed on")] },
    ],
};

/// One execution beside that of the scenario.
pub(super) const BESIDE: Shape = Shape::plain(&[
    Key::new("name", Name, "its name in report, recording and figures"),
    Key::new("set", Texts, "what it changes: KEY=VALUE each, as for `--set`, of learning, coupling, execution and human.help"),
]);
