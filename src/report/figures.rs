//! Numbers as people read them.

/// Three significant figures, without an exponent where none is needed.
pub(super) fn figure(number: f64) -> String {
    let magnitude = number.abs();
    if number == 0.0 {
        "0".to_owned()
    } else if (1e-4..1e6).contains(&magnitude) {
        let decimals = (2 - magnitude.log10().floor() as i32).clamp(0, 6) as usize;
        let fixed = format!("{number:.decimals$}");
        if fixed.contains('.') { fixed.trim_end_matches('0').trim_end_matches('.').to_owned() } else { fixed }
    } else {
        format!("{number:.2e}")
    }
}

#[cfg(test)]
mod tests {
    use super::figure;

    #[test]
    fn figures_are_short_and_keep_three_digits() {
        for (number, shown) in
            [(0.0, "0"), (0.012, "0.012"), (0.0123456, "0.0123"), (-14.2, "-14.2"), (1e-7, "1.00e-7"), (298000.0, "298000")]
        {
            assert_eq!(figure(number), shown);
        }
    }
}
