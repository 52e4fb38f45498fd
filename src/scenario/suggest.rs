//! Guesses at what was meant.

use super::measure::{Measure, plain};

/// `did you mean ...`, when one of the known names is close to what was typed.
pub fn did_you_mean<'a>(typed: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    nearest(typed, known).map(|name| format!("did you mean `{name}`?"))
}

/// Most names that are compared.
const MAX_NAMES: usize = 200;

/// The known name that is closest to what was typed, if it is close.
fn nearest<'a>(typed: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let lower = typed.to_lowercase();
    known
        .into_iter()
        .take(MAX_NAMES)
        .map(|name| (closeness(&lower, name), name))
        .filter(|(score, _)| *score >= 0.65)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name)
}

/// 0 … 1; a key whose unit was left off (`stiffness` for `stiffness_n_per_m`) counts as close.
fn closeness(typed: &str, name: &str) -> f64 {
    let stem = name.strip_prefix(typed).is_some_and(|rest| rest.starts_with('_'));
    let score = strsim::normalized_damerau_levenshtein(typed, name).max(stem_closeness(typed, name));
    if stem { score.max(0.95) } else { score }
}

/// Closeness of `typed` to `name` with its last words (the unit) left off.
fn stem_closeness(typed: &str, name: &str) -> f64 {
    let stems = name.match_indices('_').map(|(end, _)| &name[..end]).filter(|stem| stem.len() >= 4);
    stems.map(|stem| 0.98 * strsim::normalized_damerau_levenshtein(typed, stem)).fold(0.0, f64::max)
}

/// At most a dozen names, quoted and separated by commas.
pub(super) fn name_list<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let quoted: Vec<String> = names.into_iter().map(|name| format!("`{name}`")).collect();
    match quoted.len() {
        0 => "nothing".to_owned(),
        1..=40 => quoted.join(", "),
        more => format!("{}, … ({} in all)", quoted[..40].join(", "), more),
    }
}

/// Help for a number outside its range: perhaps it was meant in another unit.
pub(super) fn other_unit(number: f64, measure: &Measure) -> Option<String> {
    let candidates: &[(&str, f64)] = match measure.unit {
        "m" => &[("cm", 0.01), ("mm", 0.001)],
        "s" => &[("ms", 0.001)],
        "rad" => &[("degrees", std::f64::consts::PI / 180.0)],
        "kg" => &[("g", 0.001)],
        _ => &[],
    };
    let (unit, factor) = candidates.iter().find(|(_, factor)| measure.accepts(number * factor))?;
    Some(format!("if {} {unit} was meant, write {}", plain(number), plain(rounded(number * factor))))
}

/// Help for a number that was typed as text, such as `"23.5 cm"`.
pub(super) fn typed_with_unit(text: &str, measure: &Measure) -> Option<String> {
    let split = text.find(|c: char| c.is_alphabetic() && c != 'e' && c != 'E').unwrap_or(text.len());
    let number: f64 = text[..split].trim().parse().ok()?;
    let unit = text[split..].trim();
    let factor = match (unit, measure.unit) {
        (same, key) if same == key || same.is_empty() => 1.0,
        ("cm", "m") => 0.01,
        ("mm", "m") | ("ms", "s") | ("g", "kg") => 0.001,
        ("km", "m") | ("kHz", "Hz") => 1000.0,
        ("min", "s") => 60.0,
        ("deg" | "°", "rad") => std::f64::consts::PI / 180.0,
        _ => return None,
    };
    let in_unit = if measure.unit.is_empty() { String::new() } else { format!(", in {}", measure.unit) };
    Some(format!("write {} without quotes{in_unit}", plain(rounded(number * factor))))
}

/// Without the last digits that a change of unit leaves behind.
fn rounded(number: f64) -> f64 {
    format!("{number:.9e}").parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::super::measure::within;
    use super::*;

    #[test]
    fn a_slip_of_the_finger_and_a_missing_unit_are_recognised() {
        let keys = ["stiffness_n_per_m", "damping_ns_per_m", "teaching_force_max_n"];
        assert_eq!(did_you_mean("stifness_n_per_m", keys).as_deref(), Some("did you mean `stiffness_n_per_m`?"));
        assert_eq!(did_you_mean("stiffness", keys).as_deref(), Some("did you mean `stiffness_n_per_m`?"));
        assert_eq!(did_you_mean("stifness", keys).as_deref(), Some("did you mean `stiffness_n_per_m`?"));
        assert_eq!(did_you_mean("colour", keys), None);
    }

    #[test]
    fn units_are_converted_in_the_help() {
        let metres = within("m", 0.0, 3.0);
        assert_eq!(other_unit(23.5, &metres).as_deref(), Some("if 23.5 cm was meant, write 0.235"));
        assert_eq!(typed_with_unit("23.5 cm", &metres).as_deref(), Some("write 0.235 without quotes, in m"));
        assert_eq!(typed_with_unit("tall", &metres), None);
    }
}
