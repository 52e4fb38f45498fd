//! Where a run is: a bar on a terminal, lines in a log.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use super::terminal::Terminal;
use crate::simulation::Progress;

/// Shows the progress of one run on stderr.
pub(super) struct Shown<'a> {
    terminal: &'a Terminal,
    bar: Mutex<Option<ProgressBar>>,
    clock: Clock,
}

impl<'a> Shown<'a> {
    /// For a run that may take that long.
    pub fn new(terminal: &'a Terminal, limit: Option<Duration>) -> Self {
        Self { terminal, bar: Mutex::new(None), clock: Clock::with_limit(limit) }
    }

    fn current(&self) -> Option<ProgressBar> {
        self.bar.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    fn replace(&self, bar: Option<ProgressBar>) {
        let before = std::mem::replace(&mut *self.bar.lock().unwrap_or_else(PoisonError::into_inner), bar);
        if let Some(before) = before {
            before.finish_and_clear();
        }
    }
}

impl Progress for Shown<'_> {
    fn phase(&self, name: &str, steps: u64) {
        if self.terminal.bars {
            let bar = if steps == 0 { ProgressBar::new_spinner() } else { ProgressBar::new(steps) };
            let template = if steps == 0 { "{prefix:>8}  {spinner} {elapsed}" } else { "{prefix:>8}  {bar:40} {percent:>3} %  {eta} left" };
            if let Ok(style) = ProgressStyle::with_template(template) {
                bar.set_style(style.progress_chars("##-").tick_chars("|/-\\ "));
            }
            bar.set_prefix(name.to_owned());
            bar.enable_steady_tick(Duration::from_millis(200));
            self.replace(Some(bar));
        }
    }

    fn advance(&self, steps: u64) {
        if let Some(bar) = self.current() {
            bar.inc(steps);
        }
    }

    fn note(&self, text: &str) {
        match self.current() {
            Some(bar) => bar.suspend(|| self.terminal.note(&format!("{text}\n"))),
            None => self.terminal.note(&format!("{text}\n")),
        }
    }

    fn elapsed_s(&self) -> f64 {
        self.clock.elapsed_s()
    }

    fn may_go_on(&self) -> bool {
        self.clock.may_go_on()
    }
}

impl Drop for Shown<'_> {
    fn drop(&mut self) {
        self.replace(None);
    }
}

/// Progress of one of many runs at the same time: nothing is shown of it but how long it takes.
pub(super) struct Clock {
    started: Instant,
    limit: Option<Duration>,
}

impl Clock {
    pub fn start() -> Self {
        Self::with_limit(None)
    }

    /// For a run that may take that long.
    pub fn with_limit(limit: Option<Duration>) -> Self {
        Self { started: Instant::now(), limit }
    }
}

impl Progress for Clock {
    fn phase(&self, _name: &str, _steps: u64) {}
    fn advance(&self, _steps: u64) {}
    fn note(&self, _text: &str) {}
    fn elapsed_s(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }

    fn may_go_on(&self) -> bool {
        self.limit.is_none_or(|limit| self.started.elapsed() < limit)
    }
}
