//! The members of a sweep on several threads: one world per thread, one row per member.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{SyncSender, sync_channel};

use super::{BatchError, Plan, Row, Shard, SweepFolder};
use crate::report::{Outcome, RunReport};
use crate::scenario::{InvalidMember, Member, Scenario};

/// What is done with each member.
pub struct Runner<'a> {
    /// Runs a scenario and judges it.
    pub run: &'a (dyn Fn(&Scenario) -> RunReport + Sync),
    /// The command that does the same.
    pub command: &'a (dyn Fn(&Member) -> String + Sync),
}

/// Where a sweep is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pace {
    /// Members that have their row.
    pub done: u64,
    /// How many of them had it when this began.
    pub before: u64,
    /// Members in all.
    pub of: u64,
}

/// Runs the members of `shard` that have no row yet, on `threads` threads, and appends each row to the folder's log before `told` hears of it.
///
/// Every run has one thread to itself, so the threads never wait for each other.
///
/// # Errors
/// When a row cannot be written, or a file that a member needs has gone.
pub fn execute(
    plan: &Plan,
    shard: Shard,
    folder: &mut SweepFolder,
    runner: &Runner<'_>,
    threads: usize,
    told: &mut dyn FnMut(&Row, Pace),
) -> Result<(), BatchError> {
    let before = folder.log.rows;
    let mut pace = Pace { done: before, before, of: shard.size(plan.members) };
    let missing: Vec<u64> = shard.indices(plan.members).filter(|index| !folder.log.holds(*index)).collect();
    let queue = Queue { plan, runner, missing: &missing, next: AtomicU64::new(0), stopped: AtomicBool::new(false) };
    let (sender, rows) = sync_channel(threads.max(1));
    std::thread::scope(|scope| {
        for _ in 0..threads.clamp(1, missing.len().max(1)) {
            let (queue, sender) = (&queue, sender.clone());
            scope.spawn(move || queue.work(&sender));
        }
        drop(sender);
        for row in rows {
            let written = row.map_err(BatchError::Gone).and_then(|row| {
                folder.log.append(&row)?;
                pace.done += 1;
                told(&row, pace);
                Ok(())
            });
            if written.is_err() {
                queue.stopped.store(true, Ordering::Relaxed);
                return written;
            }
        }
        Ok(())
    })
}

/// The members that are still to be run.
struct Queue<'a> {
    plan: &'a Plan,
    runner: &'a Runner<'a>,
    missing: &'a [u64],
    next: AtomicU64,
    stopped: AtomicBool,
}

impl Queue<'_> {
    /// Runs one member after the other until none is left, or nobody listens any more.
    fn work(&self, sender: &SyncSender<Result<Row, Box<InvalidMember>>>) {
        // Teaching and learning use the pool of the thread that they run on: here a pool of this thread alone.
        let alone = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
        while !self.stopped.load(Ordering::Relaxed) {
            let place = self.next.fetch_add(1, Ordering::Relaxed) as usize;
            let Some(&index) = self.missing.get(place) else { return };
            let run = || self.plan.member(index).map(|member| self.row(&member));
            let row = match &alone {
                Ok(pool) => pool.install(run),
                Err(_) => run(),
            };
            if sender.send(row).is_err() {
                return;
            }
        }
    }

    /// Runs a member. A bug in the program ends this run, not the sweep.
    fn row(&self, member: &Member) -> Row {
        let report = catch_unwind(AssertUnwindSafe(|| (self.runner.run)(&member.scenario))).unwrap_or_else(|panic| {
            let what = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
            let message = format!("internal error: {}", what.unwrap_or("no message"));
            RunReport::failed(member.scenario.work.name(), member.scenario.work.seed(), Outcome::InternalError, &message)
        });
        Row::of(member, &report, (self.runner.command)(member))
    }
}
