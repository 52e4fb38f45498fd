//! The vocabulary in which the table of keys is written (see [`super::schema`]).
//!
//! One table drives everything that knows keys: reading, ranges, defaults, unknown keys, references by name, the resolved scenario.

use super::measure::Measure;

/// One key of a table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Key {
    pub name: &'static str,
    pub kind: Kind,
    pub preset: Preset,
    /// What it means, in one line; the unit is told by [`Measure`].
    pub meaning: &'static str,
}

/// What a key takes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Kind {
    /// `true` or `false`.
    Flag,
    /// A whole number between two bounds.
    Count(i64, i64),
    /// A number.
    Number(Measure),
    /// A number, or the name of a parameter that gives it.
    Quantity(Measure),
    /// A number, or one word.
    NumberOrWord(Measure, &'static str),
    /// A whole number between two bounds, or one word.
    CountOrWord(i64, i64, &'static str),
    /// A list of numbers.
    Vector(Measure, Length),
    /// A list of `[start, end]`.
    Windows(Measure),
    /// Free text.
    Text,
    /// A list of texts.
    Texts,
    /// A name: letters, digits, `_` and `-`.
    Name,
    /// A file or folder.
    Path(PathTo),
    /// A list of folders.
    Folders,
    /// Which variant of its table's shape the table is.
    Tag,
    /// One of some words.
    Choice(&'static [&'static str]),
    /// The name of something in this scenario.
    Reference(To),
    /// A list of such names.
    References(To),
    /// A table.
    Section(Shape),
    /// A list of tables.
    List(Shape),
    /// A table of names that the scenario chooses, each with a number.
    Numbers,
    /// A table of parameter names, each with a list of numbers.
    Grid,
    /// A list of values of another key.
    Values,
    /// A table of keys, each with `[min, max]`.
    Ranges,
}

/// How many entries a list has.
#[derive(Clone, Copy, Debug)]
pub(super) enum Length {
    Exactly(usize),
    AtLeast(usize),
}

/// What a path leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PathTo {
    /// A URDF file, or `builtin:NAME`.
    Robot,
    /// A file or a folder with demonstrations.
    Dataset,
    /// A folder.
    Folder,
}

/// What a name refers to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum To {
    /// An object of the scene.
    Object,
    /// An object of the scene, of one kind.
    ObjectOfKind(&'static str),
    /// An object of the scene that can be moved.
    MovableObject,
    /// A task parameter.
    Parameter,
}

/// The keys of a table: some always, others according to its `kind`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    pub keys: &'static [Key],
    /// Empty when the table has no `kind`.
    pub variants: &'static [Variant],
}

/// One `kind` of a table, with the keys that only it has.
#[derive(Clone, Copy, Debug)]
pub(super) struct Variant {
    pub kind: &'static str,
    pub keys: &'static [Key],
}

/// What stands for a key that is not typed.
#[derive(Clone, Copy, Debug)]
pub(super) enum Preset {
    /// Nothing: it must be typed.
    Required,
    /// Nothing: it may be absent.
    Optional,
    Flag(bool),
    Count(i64),
    Number(f64),
    Vector(&'static [f64]),
    Text(&'static str),
    /// A table or list without entries.
    Empty,
}

impl Key {
    /// A key that must be typed.
    pub const fn new(name: &'static str, kind: Kind, meaning: &'static str) -> Self {
        Self { name, kind, preset: Preset::Required, meaning }
    }

    /// The same key with something that stands for it.
    pub const fn or(self, preset: Preset) -> Self {
        Self { preset, ..self }
    }

    /// The same key with a number that stands for it.
    pub const fn or_number(self, number: f64) -> Self {
        self.or(Preset::Number(number))
    }

    /// The same key, which may be absent.
    pub const fn optional(self) -> Self {
        self.or(Preset::Optional)
    }

    /// The same key, whose table is complete without anything typed.
    pub const fn or_empty(self) -> Self {
        self.or(Preset::Empty)
    }
}

impl Shape {
    /// A table without a `kind`.
    pub const fn plain(keys: &'static [Key]) -> Self {
        Self { keys, variants: &[] }
    }

    /// The variant of that name.
    pub fn variant(&self, kind: &str) -> Option<&'static Variant> {
        self.variants.iter().find(|variant| variant.kind == kind)
    }

    /// The keys of a table of this shape and, if it has one, this `kind`.
    pub fn keys_of(&self, kind: Option<&str>) -> impl Iterator<Item = &'static Key> + use<> {
        let special = kind.and_then(|kind| self.variant(kind)).map_or(&[][..], |variant| variant.keys);
        self.keys.iter().chain(special)
    }
}
