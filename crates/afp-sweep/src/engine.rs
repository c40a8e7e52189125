//! Runs on all cores, with outcomes in order of completion.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::thread;
use std::time::Instant as Wall;

use afp_core::{Fault, Instant};
use afp_run::RunError;
use afp_run::panics::{Caught, caught};
use afp_session::{AnySession, Observer};

use crate::attend;
use crate::grid::{Row, Sweep};
use crate::outcome::{Ending, Outcome};

/// The most outcomes in the queue.
const WAITING: usize = 64;

/// Makes the session of a row, with its inputs set, and always the same one. An error ends only
/// this run.
pub type Maker<'a> = &'a (dyn Fn(&Row<'_>) -> Result<Box<dyn AnySession>, RunError> + Sync);

/// Drives a session to the end of its run with additional observers; returns `None` after a
/// cancellation.
pub type Drive<'a> =
    &'a mut dyn FnMut(&mut dyn AnySession, &mut [&mut dyn Observer]) -> Option<Outcome>;

/// An observer of runs, for data beyond their outcomes.
pub trait Watch: Sync {
    /// Drives a run with additional observers, and keeps data of the run and its session. The
    /// engine calls it on its worker threads.
    fn run(&self, row: &Row<'_>, session: Box<dyn AnySession>, drive: Drive<'_>)
    -> Option<Outcome>;
}

/// Executes runs of a sweep.
#[derive(Clone, Copy)]
pub struct Engine<'a> {
    pub sweep: &'a Sweep,
    pub maker: Maker<'a>,
    /// The number of threads, at least one.
    pub jobs: usize,
    /// Cancels all runs when true; a cancelled run has no outcome.
    pub stop: &'a AtomicBool,
    /// The observer of all runs, if any.
    pub watch: Option<&'a dyn Watch>,
}

impl Engine<'_> {
    /// Executes the numbered runs in roughly that order, and passes each outcome to `each` on the
    /// calling thread. The engine stops if `each` breaks.
    pub fn run(&self, runs: &[u64], mut each: impl FnMut(Outcome) -> bool) {
        let next = AtomicUsize::new(0);
        let enough = AtomicBool::new(false);
        let (send, outcomes) = sync_channel(WAITING);
        thread::scope(|scope| {
            for _ in 0..self.jobs.clamp(1, runs.len().max(1)) {
                let (send, next, enough) = (send.clone(), &next, &enough);
                scope.spawn(move || self.work(runs, next, enough, &send));
            }
            drop(send);
            for outcome in outcomes {
                if !enough.load(Ordering::Relaxed) && !each(outcome) {
                    enough.store(true, Ordering::Relaxed);
                }
            }
        });
    }

    /// Executes runs until none is left.
    fn work(
        &self,
        runs: &[u64],
        next: &AtomicUsize,
        enough: &AtomicBool,
        send: &SyncSender<Outcome>,
    ) {
        while !self.stop.load(Ordering::Relaxed) && !enough.load(Ordering::Relaxed) {
            let Some(run) = runs.get(next.fetch_add(1, Ordering::Relaxed)) else { return };
            let Some(outcome) = self.one(*run) else { return };
            if send.send(outcome).is_err() {
                return;
            }
        }
    }

    /// Executes one run on this thread; `None` after a cancellation. A panic becomes an outcome.
    pub fn one(&self, run: u64) -> Option<Outcome> {
        let begun = Wall::now();
        let row = self.sweep.row(run);
        let Caught { done, said } = caught(|| self.drive(&row));
        let mut outcome =
            done.unwrap_or_else(|| Some(Outcome::failed(run, Ending::Panicked, said.clone())))?;
        if outcome.ending == Ending::Error && outcome.why == Fault::PANIC.code() && !said.is_empty()
        {
            outcome.why = format!("{}: {said}", outcome.why);
        }
        outcome.took_s = begun.elapsed().as_secs_f64();
        Some(outcome)
    }

    fn drive(&self, row: &Row<'_>) -> Option<Outcome> {
        let mut session = match (self.maker)(row) {
            Ok(session) => session,
            Err(error) => {
                return Some(Outcome::failed(row.run, Ending::NotStarted, first_line(&error)));
            }
        };
        let until = Instant::ZERO + self.sweep.until;
        let mut drive = |session: &mut dyn AnySession, more: &mut [&mut dyn Observer]| {
            attend::drive(row.run, session, until, self.stop, more)
        };
        match self.watch {
            Some(watch) => watch.run(row, session, &mut drive),
            None => drive(&mut *session, &mut []),
        }
    }
}

/// The error without its place and help.
fn first_line(error: &RunError) -> String {
    let text = error.to_string();
    let line = text.lines().next().unwrap_or_default();
    line.strip_prefix("error: ").unwrap_or(line).to_owned()
}
