//! Stdout and stderr: colour where it is wanted, ASCII where nothing else is understood, no panic when nobody listens any more.

use std::io::{ErrorKind, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};

use anstream::{AutoStream, ColorChoice};
use serde::Serialize;

use super::args::{Colour, Format, Global};
use crate::report::Outcome;
use crate::scenario::{Diagnostic, render};

/// The two streams of the program.
pub(super) struct Terminal {
    choice: ColorChoice,
    unicode: bool,
    width: usize,
    /// Nothing but results and errors.
    pub quiet: bool,
    /// For whom results are.
    pub format: Format,
    /// Whether stderr shows bars that move.
    pub bars: bool,
    /// Whether stdout could not be written, for another reason than a reader who left.
    failed: AtomicBool,
}

impl Terminal {
    pub fn new(global: &Global) -> Self {
        Self {
            choice: match global.color {
                Colour::Auto => ColorChoice::Auto,
                Colour::Always => ColorChoice::Always,
                Colour::Never => ColorChoice::Never,
            },
            unicode: unicode(),
            width: std::env::var("COLUMNS").ok().and_then(|columns| columns.parse().ok()).unwrap_or(120).clamp(40, 200),
            quiet: global.quiet,
            format: global.format.format(),
            bars: !global.no_progress && !global.quiet && std::io::stderr().is_terminal(),
            failed: AtomicBool::new(false),
        }
    }

    /// Prints a result.
    pub fn result(&self, text: &str) {
        let mut stream = AutoStream::new(std::io::stdout().lock(), self.choice);
        let written = stream.write_all(self.readable(text).as_bytes()).and_then(|()| stream.flush());
        if written.is_err_and(|error| error.kind() != ErrorKind::BrokenPipe) {
            self.failed.store(true, Ordering::Relaxed);
        }
    }

    /// Prints a result for programs, on a line of its own.
    pub fn json(&self, value: &impl Serialize) {
        let line = serde_json::to_string(value).expect("results hold nothing that JSON cannot");
        self.result(&(line + "\n"));
    }

    /// Says something by the way, unless nobody wants to hear it.
    pub fn note(&self, text: &str) {
        if !self.quiet {
            self.error(text);
        }
    }

    /// Says something that must be heard.
    pub fn error(&self, text: &str) {
        // There is nobody left to tell when stderr fails.
        _ = AutoStream::new(std::io::stderr().lock(), self.choice).write_all(self.readable(text).as_bytes());
    }

    /// Shows faults of a scenario with their snippets.
    pub fn faults(&self, diagnostics: &[Diagnostic]) {
        if !diagnostics.is_empty() {
            self.error(&(render(diagnostics, true, self.unicode, self.width) + "\n"));
        }
    }

    /// How the program ends as far as its own output is concerned.
    pub fn outcome(&self) -> Outcome {
        if self.failed.load(Ordering::Relaxed) { Outcome::OutputFailed } else { Outcome::Passed }
    }

    fn readable(&self, text: &str) -> String {
        if self.unicode { text.to_owned() } else { ascii(text) }
    }
}

/// Writes to stderr when there is no [`Terminal`].
pub(super) fn complain(text: &str) {
    // There is nobody left to tell when stderr fails.
    _ = std::io::stderr().write_all(text.as_bytes());
}

/// Whether the locale is known to understand more than ASCII; one that says nothing is trusted.
fn unicode() -> bool {
    let locale = ["LC_ALL", "LC_CTYPE", "LANG"].iter().find_map(|name| std::env::var(name).ok().filter(|value| !value.is_empty()));
    locale.is_none_or(|locale| locale.to_lowercase().replace('-', "").contains("utf8"))
}

/// The text in ASCII, as well as it goes.
fn ascii(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            c if c.is_ascii() => plain.push(c),
            '…' => plain.push_str("..."),
            '²' => plain.push('2'),
            '–' | '—' => plain.push('-'),
            _ => plain.push('?'),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::ascii;

    #[test]
    fn nothing_but_ascii_is_left() {
        assert_eq!(ascii("0 … 5 m², wörtlich"), "0 ... 5 m2, w?rtlich");
    }
}
