//! Which name was probably meant.

/// Most letters by which a slip differs from what was meant.
const SLIP: usize = 2;

/// The known name that is so near to what was typed that it was probably meant.
#[must_use]
pub fn nearest_name<'a>(typed: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let near = known.into_iter().map(|name| (strsim::damerau_levenshtein(name, typed), name)).min();
    near.filter(|(edits, _)| *edits <= SLIP).map(|(_, name)| name)
}
