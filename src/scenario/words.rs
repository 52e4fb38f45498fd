//! What keys take, in the words of messages.

use super::key::{Kind, Length, PathTo, To};
use super::measure::Measure;
use super::suggest::name_list;

impl Kind {
    /// What a key of this kind takes, in words.
    pub fn describe(&self) -> String {
        match self {
            Self::Flag => "true or false".to_owned(),
            Self::Count(min, max) if min == max => format!("{min}"),
            Self::Count(min, i64::MAX) => format!("a whole number from {min}"),
            Self::Count(min, max) => format!("a whole number, {min} … {max}"),
            Self::Number(measure) => format!("a number{}", in_range(measure)),
            Self::Quantity(measure) => format!("a number{}, or the name of a parameter", in_range(measure)),
            Self::NumberOrWord(measure, word) => format!("a number{}, or \"{word}\"", in_range(measure)),
            Self::CountOrWord(min, max, word) => format!("{}, or \"{word}\"", Self::Count(*min, *max).describe()),
            Self::Vector(measure, length) => format!("{}{}", length.describe(), in_range(measure)),
            Self::Windows(measure) => format!("a list of [start, end]{}", in_range(measure)),
            Self::Text => "text".to_owned(),
            Self::Texts => "a list of texts".to_owned(),
            Self::Name => "a name of letters, digits, `_` and `-`, at most 64".to_owned(),
            Self::Path(PathTo::Robot) => "a URDF file, or \"builtin:baxter\"".to_owned(),
            Self::Path(PathTo::Dataset) => "the folder of a dataset".to_owned(),
            Self::Path(PathTo::Folder) => "a folder".to_owned(),
            Self::Folders => "a list of folders".to_owned(),
            Self::Tag => "a kind, as text".to_owned(),
            Self::Choice(choices) => format!("one of {}", name_list(choices.iter().copied())),
            Self::Reference(to) => format!("the name of {}", to.describe()),
            Self::References(to) => format!("a list of names, each of {}", to.describe()),
            Self::Section(_) => "a table".to_owned(),
            Self::List(_) => "a list of tables".to_owned(),
            Self::Numbers => "a table of names, each with a number".to_owned(),
            Self::Grid => "a table of parameter names, each with a list of numbers".to_owned(),
            Self::Values => "a list of one value or more".to_owned(),
            Self::Ranges => "a table of keys, each with [min, max]".to_owned(),
        }
    }
}

impl Length {
    /// The length in words.
    pub fn describe(self) -> String {
        match self {
            Self::Exactly(count) => format!("a list of {count} numbers"),
            Self::AtLeast(count) => format!("a list of at least {count} numbers"),
        }
    }
}

impl To {
    /// The key of the scenario under which such things are listed.
    pub fn list(self) -> &'static str {
        match self {
            Self::Object | Self::ObjectOfKind(_) | Self::MovableObject => "object",
            Self::Parameter => "parameters",
        }
    }

    /// What is referred to, in words.
    pub fn describe(self) -> String {
        match self {
            Self::Object => "an object".to_owned(),
            Self::ObjectOfKind(kind) => format!("an object of kind `{kind}`"),
            Self::MovableObject => "an object that can be moved (a ball, a box or a cylinder)".to_owned(),
            Self::Parameter => "a parameter".to_owned(),
        }
    }
}

fn in_range(measure: &Measure) -> String {
    if measure.max == f64::MAX { String::new() } else { format!(", {}", measure.describe()) }
}
