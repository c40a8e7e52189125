//! Threads that help to step episodes, made when they are needed and again in a process that was forked.
//!
//! A step of many robots takes a tenth of a millisecond, and waking a thread as long as one of them. So who asks for a round
//! takes part in it, helpers look for the next one for a moment before they sleep, and nobody waits for a helper that comes late.
//! Where the cores are busy with others, a helper loses its core in the midst of an episode, for longer than all of them take: after
//! a round in which more time was lost by waiting for helpers than they saved, some are done without them.

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

/// How long a helper looks for the next round before it sleeps: what Python does between two of them takes less as a rule.
const AWAKE: Duration = Duration::from_micros(50);
/// The clock is read once for so many looks.
const LOOKS: u32 = 64;

/// So many rounds are done without helpers after one in which they cost time, twice as many the next time, up to a bound.
const ALONE: u32 = 8;
const MOST_ALONE: u32 = 512;

/// The helpers of a process, if it has a core for any.
type Known = (u32, Option<Arc<Helpers>>);

/// Those of this process, once they were needed.
static HELPERS: Mutex<Option<Known>> = Mutex::new(None);

/// Threads that take part in the latest round.
#[derive(Default)]
struct Helpers {
    /// The number of the latest round, for those that are awake.
    latest: AtomicU64,
    posted: Mutex<Posted>,
    more: Condvar,
    /// How many rounds are done without helpers, and how many will be when one is late again.
    alone: AtomicU32,
    next_alone: AtomicU32,
}

/// The latest round and its number; none once it is over.
#[derive(Default)]
struct Posted {
    number: u64,
    round: Option<Arc<Round>>,
    asleep: usize,
}

/// Does a round on all cores, this thread's among them; whoever panics in it poisons the place.
///
/// # Errors
/// The system gives no threads.
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

/// One helper less than there are cores, of which the system is asked once; none on one core.
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
    /// Does a round with this thread and those that come.
    fn work(&self, round: &Arc<Round>) {
        let begin = Instant::now();
        let number = self.post(round);
        let own = round.work();
        let worked = begin.elapsed().as_secs_f64();
        round.wait();
        let waited = begin.elapsed().as_secs_f64() - worked;
        self.withdraw(number);
        // Whoever did so many takes as long for each of the others. To wait for the last one is no loss.
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

    /// Whether this round is one of those that are done without helpers.
    fn rest(&self) -> bool {
        let less = |alone: u32| alone.checked_sub(1);
        self.alone.fetch_update(Ordering::Relaxed, Ordering::Relaxed, less).is_ok()
    }

    /// Lets helpers see a round; its number.
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

    /// Takes a round away that is over, so that its episodes are not kept.
    fn withdraw(&self, number: u64) {
        let mut posted = self.posted();
        if posted.number == number {
            posted.round = None;
        }
    }

    /// What a helper does, for ever.
    fn help(&self) {
        let mut seen = 0;
        loop {
            if let Some(round) = self.next(&mut seen) {
                // The place that broke says so itself; the helper goes on.
                let _ = catch_unwind(AssertUnwindSafe(|| round.work()));
            }
        }
    }

    /// Waits for a round after the one that was seen last; none where that is over already.
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

    /// Whether there is a round after that one, at one of some looks: each takes as long as a processor rests between two.
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
