//! `--grid KEY=a,b,c` and `--repeat N`: directions of a sweep that are typed on the command line.

use super::fault::{Code, Fault};
use super::overrides::{of_command_line, value};
use super::source::{Origin, Sources};
use super::sweep_axis::Axis;

/// Reads one grid as typed.
pub(super) fn grid(typed: &str, sources: &mut Sources, faults: &mut Vec<Fault>) -> Option<Axis> {
    let source = sources.add(of_command_line("--grid", typed));
    let place = |start: usize, end: usize| Origin { source, start, end };
    let Some((key, list)) = typed.split_once('=').filter(|(key, _)| !key.trim().is_empty()) else {
        let fault = Fault::at(Code::Override, place(0, typed.len()), "this grid has no key and `=`");
        faults.push(fault.expected("KEY=a,b,c, such as parameters.block_height_m=0.18,0.2"));
        return None;
    };
    let mut values = Vec::new();
    let mut start = key.len() + 1;
    for part in parts(list) {
        match value(part, source, start, faults) {
            Ok(node) => values.push(node),
            Err(fault) => faults.push(fault),
        }
        start += part.len() + 1;
    }
    Some(Axis::listed(key.trim(), place(0, key.len()), values))
}

/// Reads the number of repetitions.
pub(super) fn repeat(count: u64, first_seed: u64, sources: &mut Sources) -> Axis {
    let typed = count.to_string();
    let source = sources.add(of_command_line("--repeat", &typed));
    Axis::seeds(first_seed, count, Origin { source, start: 0, end: typed.len() })
}

/// The parts between commas that stand in no list, table or quotes. Nothing has no parts.
fn parts(list: &str) -> Vec<&str> {
    if list.trim().is_empty() {
        return Vec::new();
    }
    let mut parts = Vec::new();
    let (mut start, mut depth, mut quote) = (0, 0_usize, None);
    for (index, c) in list.char_indices() {
        match (quote, c) {
            (Some(open), c) if c == open => quote = None,
            (Some(_), _) => {}
            (None, '"' | '\'') => quote = Some(c),
            (None, '[' | '{') => depth += 1,
            (None, ']' | '}') => depth = depth.saturating_sub(1),
            (None, ',') if depth == 0 => {
                parts.push(&list[start..index]);
                start = index + 1;
            }
            _ => {}
        }
    }
    parts.push(&list[start..]);
    parts
}

#[cfg(test)]
mod tests {
    use super::parts;

    #[test]
    fn commas_in_lists_and_quotes_do_not_separate() {
        assert_eq!(parts("0.1, 0.2"), ["0.1", " 0.2"]);
        assert_eq!(parts("[1,2],[3,4]"), ["[1,2]", "[3,4]"]);
        assert_eq!(parts(r#""a,b",c"#), [r#""a,b""#, "c"]);
        assert_eq!(parts("1,"), ["1", ""]);
        assert!(parts(" ").is_empty());
    }
}
