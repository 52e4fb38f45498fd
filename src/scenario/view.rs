//! Typed access to a filled tree. A value that is missing because of a fault reads as a placeholder: the scenario is then refused anyway.

use std::path::PathBuf;

use nalgebra::Vector2;

use super::tree::{Node, Value};
use crate::world::Quantity;

impl Node {
    /// The value of a key of the shape.
    fn filled(&self, key: &str) -> Option<&Self> {
        debug_assert!(self.value == Value::Missing || self.entry(key).is_some(), "`{key}` is not a key of this table");
        self.get(key)
    }

    /// A table within this one; an empty stand-in if it is missing.
    pub fn section(&self, key: &str) -> Self {
        self.filled(key).cloned().unwrap_or(Self::missing(self.origin))
    }

    /// The tables of a list.
    pub fn tables(&self, key: &str) -> &[Self] {
        self.filled(key).map_or(&[], Self::items)
    }

    /// A number.
    pub fn number(&self, key: &str) -> f64 {
        self.optional_number(key).unwrap_or(f64::NAN)
    }

    /// A number that may be absent.
    pub fn optional_number(&self, key: &str) -> Option<f64> {
        self.filled(key).and_then(Self::as_number)
    }

    /// A whole number.
    pub fn count(&self, key: &str) -> u64 {
        match self.filled(key).map(|node| &node.value) {
            Some(Value::Integer(count)) => u64::try_from(*count).unwrap_or(0),
            _ => 0,
        }
    }

    /// A whole number that counts things in memory.
    pub fn size(&self, key: &str) -> usize {
        usize::try_from(self.count(key)).unwrap_or(usize::MAX)
    }

    /// A flag.
    pub fn flag(&self, key: &str) -> bool {
        self.filled(key).is_some_and(|node| node.value == Value::Flag(true))
    }

    /// A text; empty if it is missing.
    pub fn text(&self, key: &str) -> &str {
        self.filled(key).and_then(Self::as_text).unwrap_or_default()
    }

    /// A text that may be absent.
    pub fn optional_text(&self, key: &str) -> Option<String> {
        self.filled(key).and_then(Self::as_text).map(str::to_owned)
    }

    /// A list of texts.
    pub fn texts(&self, key: &str) -> Vec<String> {
        let items = self.filled(key).map_or(&[][..], Self::items);
        items.iter().filter_map(Self::as_text).map(str::to_owned).collect()
    }

    /// A path that may be absent.
    pub fn optional_path(&self, key: &str) -> Option<PathBuf> {
        self.filled(key).and_then(Self::as_text).map(PathBuf::from)
    }

    /// A list of numbers.
    pub fn numbers(&self, key: &str) -> Vec<f64> {
        self.filled(key).map_or(Vec::new(), Self::as_numbers)
    }

    /// A list of exactly `N` numbers.
    pub fn array<const N: usize>(&self, key: &str) -> [f64; N] {
        self.numbers(key).try_into().unwrap_or([f64::NAN; N])
    }

    /// A pair of horizontal coordinates.
    pub fn vector2(&self, key: &str) -> Vector2<f64> {
        Vector2::from(self.array::<2>(key))
    }

    /// A number, or the name of a parameter.
    pub fn quantity(&self, key: &str) -> Quantity {
        match self.optional_text(key) {
            Some(name) => Quantity::Parameter(name),
            None => Quantity::Value(self.number(key)),
        }
    }

    /// The lists of a list.
    pub fn windows(&self, key: &str) -> Vec<[f64; 2]> {
        let items = self.filled(key).map_or(&[][..], Self::items);
        items.iter().filter_map(|item| item.as_numbers().try_into().ok()).collect()
    }
}
