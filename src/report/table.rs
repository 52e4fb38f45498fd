//! Tables for people.

/// Rows as lines, every column as wide as its widest cell: the first to the left, the others to the right. Two blanks in front.
#[must_use]
pub fn table(rows: &[Vec<String>]) -> Vec<String> {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |j: usize| rows.iter().filter_map(|row| row.get(j)).map(|cell| cell.chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).enumerate();
        let cells: Vec<String> = cells.map(|(j, (cell, &w))| if j == 0 { format!("{cell:<w$}") } else { format!("{cell:>w$}") }).collect();
        format!("  {}", cells.join("  ")).trim_end().to_owned()
    };
    rows.iter().map(line).collect()
}

/// A number with three digits that count.
#[must_use]
pub fn figure(number: f64) -> String {
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
    use super::*;

    #[test]
    fn figures_are_short_and_keep_three_digits() {
        for (number, shown) in
            [(0.0, "0"), (0.012, "0.012"), (0.0123456, "0.0123"), (-14.2, "-14.2"), (1e-7, "1.00e-7"), (298000.0, "298000")]
        {
            assert_eq!(figure(number), shown);
        }
    }

    #[test]
    fn columns_stand_under_each_other() {
        let rows = [vec!["a".to_owned(), "long".to_owned()], vec!["name".to_owned(), "1".to_owned()]];
        assert_eq!(table(&rows), ["  a     long", "  name     1"]);
    }
}
