//! The map of the fault table in this folder's documentation is true: it has every row, and every test that it names is there.

use std::fs;
use std::path::Path;

const MAP: &str = include_str!("mod.rs");

/// The rows that the program answers with an exit code and a message; 18 to 22 are about learning, 30 to 32 about the machine.
const ROWS: [std::ops::RangeInclusive<u32>; 3] = [1..=17, 23..=29, 33..=38];

/// Rows and named tests, line by line of the table.
fn table() -> Vec<(Vec<u32>, Vec<String>)> {
    let lines = MAP.lines().filter_map(|line| line.strip_prefix("//! | "));
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(" | ").collect();
        let ends: Vec<u32> = cells[0].split(" – ").map(|number| number.parse().ok()).collect::<Option<_>>()?;
        let tests = cells.last()?.split('`').skip(1).step_by(2).map(str::to_owned).collect();
        Some(((ends[0]..=*ends.last()?).collect(), tests))
    };
    lines.filter_map(row).collect()
}

/// The text of a module of the tests, such as `scenario` of this folder or `cli::check`, if there is one.
fn module(name: &str) -> Option<String> {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let path = name.replace("::", "/");
    [tests.join("faults").join(&path), tests.join(&path)].iter().find_map(|place| fs::read_to_string(place.with_extension("rs")).ok())
}

#[test]
fn every_row_of_the_fault_table_is_held_by_tests_that_are_there() {
    let table = table();
    for row in ROWS.into_iter().flatten() {
        assert!(table.iter().any(|(rows, tests)| rows.contains(&row) && !tests.is_empty()), "row {row} has no test");
    }
    for (rows, tests) in table {
        let mut last = String::new();
        for named in tests {
            if module(&named).is_some() {
                continue;
            }
            // `…name` is a test of the module that was named before.
            let (of, test) = named.rsplit_once("::").unwrap_or((&last, named.trim_start_matches('…')));
            let text = module(of).unwrap_or_else(|| panic!("row {rows:?}: `{named}`: there is no module `{of}`"));
            let start = format!("fn {}", test.trim_end_matches('…'));
            assert!(text.contains(&start), "row {rows:?}: `{named}` is not in `{of}`");
            last = of.to_owned();
        }
    }
}
