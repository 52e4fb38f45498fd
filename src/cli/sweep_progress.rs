//! Where a sweep is: a bar on a terminal, a line now and then in a log, with rate and time left.

use std::cell::Cell;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use super::terminal::Terminal;
use crate::batch::{Pace, Row};

/// Time between two lines of a log.
const QUIET: Duration = Duration::from_secs(10);

/// Shows the progress of a sweep on stderr.
pub(super) struct SweepProgress<'a> {
    terminal: &'a Terminal,
    bar: Option<ProgressBar>,
    started: Instant,
    told: Cell<Instant>,
}

impl<'a> SweepProgress<'a> {
    /// Of a sweep of `of` runs, `before` of which are done.
    pub fn new(terminal: &'a Terminal, before: u64, of: u64) -> Self {
        let bar = terminal.bars.then(|| ProgressBar::new(of).with_position(before));
        if let (Some(bar), Ok(style)) = (&bar, ProgressStyle::with_template("{bar:40} {msg}")) {
            bar.set_style(style.progress_chars("##-"));
            bar.enable_steady_tick(Duration::from_millis(200));
        }
        if before > 0 {
            terminal.note(&format!("{before} of {of} runs are done already\n"));
        }
        Self { terminal, bar, started: Instant::now(), told: Cell::new(Instant::now()) }
    }

    /// A run ended. `each` tells those that did not pass.
    pub fn row(&self, row: &Row, pace: Pace, each: bool) {
        let told = words(pace, self.started.elapsed().as_secs_f64());
        if let Some(bar) = &self.bar {
            bar.set_position(pace.done);
            bar.set_message(told.clone());
        } else if self.told.get().elapsed() >= QUIET {
            self.told.set(Instant::now());
            self.terminal.note(&format!("{told}\n"));
        }
        if let Some(reason) = row.failure_reason.as_ref().filter(|_| each) {
            let line = format!("member {}: {}: {reason}\n", row.index, row.outcome);
            match &self.bar {
                Some(bar) => bar.suspend(|| self.terminal.note(&line)),
                None => self.terminal.note(&line),
            }
        }
    }
}

impl Drop for SweepProgress<'_> {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// `12 of 200 runs, 1.3 per second, 2 min 24 s left`.
fn words(pace: Pace, elapsed_s: f64) -> String {
    let rate = (pace.done - pace.before) as f64 / elapsed_s.max(1e-9);
    let left = ((pace.of - pace.done) as f64 / rate).round() as u64;
    let left = match (left / 3600, left / 60 % 60, left % 60) {
        (0, 0, s) => format!("{s} s"),
        (0, min, s) => format!("{min} min {s} s"),
        (h, min, _) => format!("{h} h {min} min"),
    };
    let rate = if rate >= 1.0 { format!("{rate:.1} per second") } else { format!("{:.1} per minute", rate * 60.0) };
    format!("{} of {} runs, {rate}, {left} left", pace.done, pace.of)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rate_and_time_left_count_this_session_only() {
        assert_eq!(words(Pace { done: 110, before: 100, of: 200 }, 5.0), "110 of 200 runs, 2.0 per second, 45 s left");
        assert_eq!(words(Pace { done: 1, before: 0, of: 301 }, 30.0), "1 of 301 runs, 2.0 per minute, 2 h 30 min left");
    }
}
