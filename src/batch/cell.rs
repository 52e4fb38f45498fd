//! What a cell of a table holds.

use serde::{Deserialize, Serialize};

use crate::scenario::Setting;

/// One cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Cell {
    /// Nothing.
    Null,
    /// True or false.
    Flag(bool),
    /// A whole number.
    Whole(i64),
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
}

/// What the cells of a column hold, besides nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CellKind {
    /// True or false.
    Flag,
    /// Whole numbers.
    Whole,
    /// Numbers.
    Number,
    /// Texts.
    Text,
}

impl Cell {
    /// A number that may not exist. What is not finite does not exist.
    pub fn number(number: Option<f64>) -> Self {
        number.filter(|number| number.is_finite()).map_or(Self::Null, Self::Number)
    }

    /// A text that may not exist.
    pub fn text(text: Option<&str>) -> Self {
        text.map_or(Self::Null, |text| Self::Text(text.to_owned()))
    }

    /// What it holds; nothing is of every kind.
    pub fn kind(&self) -> Option<CellKind> {
        match self {
            Self::Null => None,
            Self::Flag(_) => Some(CellKind::Flag),
            Self::Whole(_) => Some(CellKind::Whole),
            Self::Number(_) => Some(CellKind::Number),
            Self::Text(_) => Some(CellKind::Text),
        }
    }

    /// The same in a column of that kind: whole numbers among numbers are numbers, and anything among texts is text.
    pub fn among(self, kind: CellKind) -> Self {
        match (kind, self) {
            (CellKind::Number, Self::Whole(whole)) => Self::Number(whole as f64),
            (CellKind::Text, Self::Flag(flag)) => Self::Text(flag.to_string()),
            (CellKind::Text, Self::Whole(whole)) => Self::Text(whole.to_string()),
            (CellKind::Text, Self::Number(number)) => Self::Text(format!("{number:?}")),
            (_, cell) => cell,
        }
    }
}

impl CellKind {
    /// The kind of a column that holds cells of both kinds.
    pub fn with(self, other: Self) -> Self {
        match (self, other) {
            (a, b) if a == b => a,
            (Self::Whole, Self::Number) | (Self::Number, Self::Whole) => Self::Number,
            _ => Self::Text,
        }
    }
}

impl From<&Setting> for Cell {
    fn from(setting: &Setting) -> Self {
        match setting {
            Setting::Flag(flag) => Self::Flag(*flag),
            Setting::Whole(whole) => Self::Whole(*whole),
            Setting::Number(number) => Self::Number(*number),
            Setting::Text(text) => Self::Text(text.clone()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_survives_json_with_its_kind_and_its_bits() {
        for cell in [Cell::Null, Cell::Flag(true), Cell::Whole(3), Cell::Number(3.0), Cell::Number(0.1 + 0.2), Cell::Text("3".to_owned())] {
            let text = serde_json::to_string(&cell).expect("JSON");
            assert_eq!(serde_json::from_str::<Cell>(&text).expect("a cell"), cell, "{text}");
        }
    }

    #[test]
    fn mixed_columns_take_the_narrowest_kind_that_holds_all() {
        assert_eq!(CellKind::Whole.with(CellKind::Number), CellKind::Number);
        assert_eq!(CellKind::Flag.with(CellKind::Whole), CellKind::Text);
        assert_eq!(Cell::Whole(2).among(CellKind::Number), Cell::Number(2.0));
        assert_eq!(Cell::Flag(true).among(CellKind::Text), Cell::Text("true".to_owned()));
    }
}
