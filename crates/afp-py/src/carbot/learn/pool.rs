//! Helper threads for episodes, created on demand and again after a fork.
//!
//! A step of many robots takes a tenth of a millisecond, and waking a thread takes as long as one
//! robot's step. The calling thread therefore takes part in its round. Helpers poll briefly for the
//! next round before they sleep, and a round does not wait for helpers that have not started. On a
//! busy machine a helper can lose its core during an episode, for longer than the whole round.
//! After a round that lost more time by waiting than the helpers saved, some rounds run without
//! helpers.

use std::hint::spin_loop;
use std::io;
use std::num::NonZeroUsize;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::batch::Round;
use crate::forks;

/// The time for which a helper polls before it sleeps, usually longer than Python's work between
/// two rounds.
const AWAKE: Duration = Duration::from_micros(50);
/// The polls between two readings of the clock.
const LOOKS: u32 = 64;

/// The rounds without helpers after a slow one; the number doubles each time, up to a limit.
const ALONE: u32 = 8;
const MOST_ALONE: u32 = 512;

/// The process id with its helpers, if it has a core for any.
type Known = (u32, Option<Arc<Helpers>>);

/// The helpers of this process, created on first use.
static HELPERS: Mutex<Option<Known>> = Mutex::new(None);

/// Threads that take part in the latest round.
#[derive(Default)]
struct Helpers {
    /// The number of the latest round, for polling helpers.
    latest: AtomicU64,
    posted: Mutex<Posted>,
    more: Condvar,
    /// The remaining rounds without helpers, and the number for the next slow round.
    alone: AtomicU32,
    next_alone: AtomicU32,
}

/// The number of the latest round, and the round until it is over.
#[derive(Default)]
struct Posted {
    number: u64,
    round: Option<Arc<Round>>,
    asleep: usize,
}

/// Executes a round on all cores, including this thread's; a panic poisons its place.
///
/// # Errors
/// The system cannot start threads.
pub fn run(round: &Arc<Round>) -> io::Result<()> {
    let helpers = match round.places() {
        0 | 1 => None,
        _ => helpers()?,
    };
    match helpers {
        Some(helpers) if !helpers.rest() => helpers.work(round),
        _ => drop(round.work()),
    }
    Ok(())
}

/// Returns the helpers, one fewer than cores; the system is queried once. `None` on one core.
fn helpers() -> io::Result<Option<Arc<Helpers>>> {
    let mut known = HELPERS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((process, helpers)) = &*known
        && *process == forks::process()
    {
        return Ok(helpers.clone());
    }
    let count = thread::available_parallelism().map_or(1, NonZeroUsize::get) - 1;
    let helpers = (count > 0).then(Arc::<Helpers>::default);
    for helpers in helpers.iter().cycle().take(count) {
        let helpers = Arc::clone(helpers);
        thread::Builder::new().name("afp episodes".to_owned()).spawn(move || helpers.help())?;
    }
    *known = Some((forks::process(), helpers.clone()));
    Ok(helpers)
}

impl Helpers {
    /// Executes a round with this thread and available helpers.
    fn work(&self, round: &Arc<Round>) {
        let begin = Instant::now();
        let number = self.post(round);
        let own = round.work();
        let worked = begin.elapsed().as_secs_f64();
        round.wait();
        let waited = begin.elapsed().as_secs_f64() - worked;
        self.withdraw(number);
        // The average time of this thread also applies to the other places. Waiting for the last
        // one is normal.
        let each = worked / own.max(1) as f64;
        let saved = each * (round.places() - own + 1) as f64;
        let before = self.next_alone.load(Ordering::Relaxed);
        let next = if own > 0 && waited > saved {
            let next = (before * 2).clamp(ALONE, MOST_ALONE);
            self.alone.store(next, Ordering::Relaxed);
            next
        } else {
            before / 2
        };
        self.next_alone.store(next, Ordering::Relaxed);
    }

    /// Whether this round runs without helpers.
    fn rest(&self) -> bool {
        let less = |alone: u32| alone.checked_sub(1);
        self.alone.fetch_update(Ordering::Relaxed, Ordering::Relaxed, less).is_ok()
    }

    /// Publishes a round and returns its number.
    fn post(&self, round: &Arc<Round>) -> u64 {
        let mut posted = self.posted();
        posted.number += 1;
        posted.round = Some(Arc::clone(round));
        self.latest.store(posted.number, Ordering::Release);
        if posted.asleep > 0 {
            self.more.notify_all();
        }
        posted.number
    }

    /// Removes a finished round, so that its episodes are freed.
    fn withdraw(&self, number: u64) {
        let mut posted = self.posted();
        if posted.number == number {
            posted.round = None;
        }
    }

    /// The endless loop of a helper.
    fn help(&self) {
        let mut seen = 0;
        loop {
            if let Some(round) = self.next(&mut seen) {
                // The place itself reports the panic; the helper continues.
                let _ = catch_unwind(AssertUnwindSafe(|| round.work()));
            }
        }
    }

    /// Waits for a round after the last seen one; `None` if it is already over.
    fn next(&self, seen: &mut u64) -> Option<Arc<Round>> {
        let begin = Instant::now();
        while !self.is_there(*seen) && begin.elapsed() < AWAKE {}
        let mut posted = self.posted();
        while posted.number == *seen {
            posted.asleep += 1;
            posted = self.more.wait(posted).unwrap_or_else(PoisonError::into_inner);
            posted.asleep -= 1;
        }
        *seen = posted.number;
        posted.round.clone()
    }

    /// Polls several times for a round after that one, with a pause of the processor in between.
    fn is_there(&self, seen: u64) -> bool {
        (0..LOOKS).any(|_| {
            spin_loop();
            self.latest.load(Ordering::Acquire) != seen
        })
    }

    fn posted(&self) -> MutexGuard<'_, Posted> {
        self.posted.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
