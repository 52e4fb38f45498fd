//! A fault as the reader sees it: file, line, column, what is there, what was expected, how to mend it.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use serde::Serialize;

use super::fault::{Code, ENOUGH, Fault, Place, Severity};
use super::source::Sources;

/// One fault of a scenario.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Diagnostic {
    /// What kind of fault.
    pub code: Code,
    /// How bad.
    pub severity: Severity,
    /// The file, as the user named it; `--set` for an override.
    pub file: String,
    /// Line, from 1. Absent when the fault is the file's as a whole.
    pub line: Option<usize>,
    /// Column in characters, from 1.
    pub column: Option<usize>,
    /// The stretch of the file, in bytes.
    pub span: Option<Range<usize>>,
    /// What is wrong.
    pub message: String,
    /// What would have been right.
    pub expected: Option<String>,
    /// How to mend it.
    pub help: Option<String>,
    /// The text of the file, for the snippet.
    #[serde(skip)]
    pub(super) text: Arc<str>,
}

/// Why a scenario cannot be used: all faults that were found, at least one of them an error.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
pub struct InvalidScenario(pub Vec<Diagnostic>);

impl Diagnostic {
    /// A fault at a line of another file, whose `text` shows it. Without a line it is the file's as a whole.
    #[must_use]
    pub fn at_line(
        code: Code,
        severity: Severity,
        file: &str,
        (line, text): (Option<usize>, &Arc<str>),
        message: String,
        help: Option<String>,
    ) -> Self {
        let (mut start, mut here) = (0, "");
        if let Some(number) = line {
            let mut lines = text.split_inclusive('\n');
            start = lines.by_ref().take(number.saturating_sub(1)).map(str::len).sum();
            here = lines.next().unwrap_or_default().trim_end();
        }
        let indent = here.len() - here.trim_start().len();
        let span = (!here.is_empty()).then(|| start + indent..start + here.len());
        let column = line.map(|_| here[..indent].chars().count() + 1);
        Self { code, severity, file: file.to_owned(), line, column, span, message, expected: None, help, text: text.clone() }
    }
}

/// Those of many faults that are told, and how many there are besides; `of` makes a diagnostic of one.
pub fn diagnose_some<T>(found: &[T], of: impl FnMut(&T) -> Diagnostic) -> Vec<Diagnostic> {
    let mut told: Vec<Diagnostic> = found.iter().take(ENOUGH).map(of).collect();
    if let Some(last) = told.last().cloned().filter(|_| found.len() > ENOUGH) {
        let message = format!("and {} more", found.len() - ENOUGH);
        told.push(Diagnostic { code: Code::More, message, help: None, line: None, column: None, span: None, ..last });
    }
    told
}

impl fmt::Display for Diagnostic {
    /// `file:line:column: error[code]: message; expected …; help`, on one line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.file)?;
        if let (Some(line), Some(column)) = (self.line, self.column) {
            write!(f, ":{line}:{column}")?;
        }
        let severity = if self.severity == Severity::Error { "error" } else { "warning" };
        write!(f, ": {severity}[{}]: {}", self.code.describe().0, self.message)?;
        for (label, text) in [("expected ", &self.expected), ("", &self.help)] {
            if let Some(text) = text {
                write!(f, "; {label}{text}")?;
            }
        }
        Ok(())
    }
}

/// Faults as diagnostics, errors before warnings, in the order of the files and the places in them, none twice. Beyond [`ENOUGH`], the
/// rest is counted.
pub(super) fn diagnose(faults: Vec<Fault>, sources: &Sources) -> Vec<Diagnostic> {
    let mut ordered = faults;
    ordered.sort_by_key(|fault| match &fault.place {
        Place::Text(origin) => (fault.severity, Some(origin.source), origin.start),
        Place::File(_) => (fault.severity, None, 0),
    });
    ordered.dedup();
    let more = ordered.len().saturating_sub(ENOUGH);
    if let Some(last) = ordered.get(ENOUGH).cloned() {
        ordered.truncate(ENOUGH);
        ordered.push(Fault { code: Code::More, message: format!("and {more} more faults"), expected: None, help: None, ..last });
    }
    ordered.into_iter().map(|fault| of_fault(fault, sources)).collect()
}

/// Diagnostics of several readings of the same files in the order of [`diagnose`], none twice.
pub(super) fn in_order(mut found: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let place = |found: &Diagnostic| (found.severity, found.file.clone(), found.line, found.column);
    found.sort_by_key(place);
    let mut once: Vec<Diagnostic> = Vec::with_capacity(found.len());
    for diagnostic in found {
        if !once.contains(&diagnostic) {
            once.push(diagnostic);
        }
    }
    once
}

fn of_fault(fault: Fault, sources: &Sources) -> Diagnostic {
    let (file, span, text) = match fault.place {
        Place::Text(origin) => {
            let source = sources.get(origin.source);
            (source.name.clone(), Some(within(&source.text, origin.start..origin.end)), source.text.clone())
        }
        Place::File(path) => (path.display().to_string(), None, Arc::from("")),
    };
    let place = span.as_ref().map(|span| line_and_column(&text, span.start));
    Diagnostic {
        code: fault.code,
        severity: fault.severity,
        file,
        line: place.map(|(line, _)| line),
        column: place.map(|(_, column)| column),
        span,
        message: fault.message,
        expected: fault.expected,
        help: fault.help,
        text,
    }
}

/// The span, moved to where characters begin and the text ends.
fn within(text: &str, span: Range<usize>) -> Range<usize> {
    let floor = |index: usize| (0..=index.min(text.len())).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0);
    let start = floor(span.start);
    start..floor(span.end).max(start)
}

/// Line and column in characters, both from 1, of the byte at `offset`.
pub(super) fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let before = &text[..offset];
    let line_start = before.rfind('\n').map_or(0, |index| index + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_of_another_file_is_shown_without_its_indent() {
        let told =
            |line, text: &str| Diagnostic::at_line(Code::Robot, Severity::Error, "r.urdf", (line, &Arc::from(text)), "m".to_owned(), None);
        let found = told(Some(2), "<a>\n  <bü/>\r\n</a>");
        assert_eq!((found.line, found.column, &found.text[found.span.clone().expect("a span")]), (Some(2), Some(3), "<bü/>"));
        for (line, text) in [(None, "<a/>"), (Some(9), "<a/>"), (Some(1), "")] {
            assert_eq!((told(line, text).line, told(line, text).span), (line, None));
        }
    }

    #[test]
    fn lines_and_columns_count_characters_from_one() {
        assert_eq!(line_and_column("a\nmü = 1", 0), (1, 1));
        assert_eq!(line_and_column("a\nmü = 1", 6), (2, 4));
        assert_eq!(within("mü", 2..9), 1..3);
    }
}
