//! Numbers at the ticks of an axis.

/// A tick's value, as short as the ticks' distance allows: `0.5`, `-12`, `1e-5`.
pub(super) fn tick(value: f64, range: [f64; 2]) -> String {
    let width = range[1] - range[0];
    // What rounding has left of a zero.
    let value = if value.abs() < width * 1e-9 { 0.0 } else { value };
    let largest = range[0].abs().max(range[1].abs());
    if value != 0.0 && !(1e-4..1e6).contains(&largest) {
        return format!("{value:.1e}");
    }
    // Ticks are at least a fiftieth of the range apart.
    let decimals = (2.0 - width.log10().floor()).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::tick;

    #[test]
    fn ticks_are_short() {
        for (value, range, shown) in [
            (0.30000000000000004, [0.0, 1.0], "0.3"),
            (-12.0, [-20.0, 20.0], "-12"),
            (1e-17, [-1.0, 1.0], "0"),
            (1200.0, [0.0, 5000.0], "1200"),
            (2e-5, [0.0, 5e-5], "2.0e-5"),
        ] {
            assert_eq!(tick(value, range), shown);
        }
    }
}
