//! The numbers that a key takes: their unit and their range.

/// The numbers that a key takes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measure {
    /// The unit; empty for a plain number.
    pub unit: &'static str,
    pub min: f64,
    pub max: f64,
    /// Whether `min` itself is refused.
    pub open: bool,
    /// Whether `inf` is taken, which then stands for "none".
    pub infinite: bool,
}

/// Numbers from `min` to `max`, both included.
pub(super) const fn within(unit: &'static str, min: f64, max: f64) -> Measure {
    Measure { unit, min, max, open: false, infinite: false }
}

/// Numbers above `min`, up to `max`.
pub(super) const fn above(unit: &'static str, min: f64, max: f64) -> Measure {
    Measure { unit, min, max, open: true, infinite: false }
}

impl Measure {
    /// The same numbers, and `inf`.
    pub const fn or_infinite(self) -> Self {
        Self { infinite: true, ..self }
    }

    /// Whether `number` is one of them.
    pub fn accepts(&self, number: f64) -> bool {
        let above_min = if self.open { number > self.min } else { number >= self.min };
        (above_min && number <= self.max) || (self.infinite && number == f64::INFINITY)
    }

    /// Any finite number: for a name that the scenario chooses, nothing more is known.
    pub const ANY: Self = within("", f64::MIN, f64::MAX);

    /// The range in words: `0.0001 … 0.002 s`.
    pub fn describe(&self) -> String {
        if self.max == f64::MAX {
            return "a finite number".to_owned();
        }
        let above = if self.open { "above " } else { "" };
        let infinite = if self.infinite { ", or inf for none" } else { "" };
        let space = if self.unit.is_empty() { "" } else { " " };
        format!("{above}{} … {}{space}{}{infinite}", plain(self.min), plain(self.max), self.unit)
    }
}

/// A number as a person writes it.
pub(super) fn plain(number: f64) -> String {
    if number.fract() == 0.0 && number.abs() < 1e6 { format!("{number:.0}") } else { format!("{number:?}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_measure_refuses_what_is_not_a_number_in_its_range() {
        let step = above("s", 0.0, 1.0);
        assert!(step.accepts(1.0) && step.accepts(1e-300));
        for number in [0.0, -1.0, 1.1, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(!step.accepts(number), "{number}");
        }
        assert!(step.or_infinite().accepts(f64::INFINITY) && !step.or_infinite().accepts(f64::NAN));
        assert_eq!(step.describe(), "above 0 … 1 s");
    }
}
