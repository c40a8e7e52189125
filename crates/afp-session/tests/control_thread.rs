//! The control thread of a real robot allocates nothing, whether its observers read or not.
//!
//! A separate test binary, because it counts in the global allocator.

#[allow(dead_code, reason = "other tests use more of it")]
mod support;

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

use afp_core::{Duration, Instant};
use afp_counting::{Counting, allocations};
use afp_session::{
    AnySession, Counts, NamedRecord, Observer, Open, SAMPLE, Sampling, Session, queue,
};
use support::{Toy, plan};

#[global_allocator]
static ALLOCATOR: Counting = Counting::SYSTEM;

/// Supervisors, commits and an actor that starts repeatedly.
const PLAN: &str = "use toy
use std
plan Rounds {
    var round: int = 0
    start go
    supervise late: After(duration = 3600 s) { Elapsed -> terminate }
    actor go: Wait(duration = 20 ms) {
        supervise touch: CheckBumper { Pressed -> terminate }
        Elapsed -> count
    }
    computation count: Count(value = round, limit = 1000000, next => round) {
        Again -> go
        Done -> terminate
    }
}";

/// Wants all signals, like a log.
struct Everything(Arc<AtomicU64>);

impl Observer for Everything {
    fn on_record(&mut self, _: &NamedRecord<'_>) {
        self.0.fetch_add(1, Ordering::Relaxed);
    }

    fn wants_clear_polls(&self) -> bool {
        true
    }

    fn sampling(&self) -> Sampling {
        Sampling::Every(SAMPLE)
    }
}

/// Runs the plan for a minute; returns the allocations of this thread and the records that were
/// read.
fn run(reads: bool) -> (u64, u64) {
    let mut session = Session::on_hardware(plan(PLAN), Toy::new());
    let seen: Arc<AtomicU64> = Arc::default();
    let mut everything = Everything(seen.clone());
    let mut counts = Counts::new(AnySession::names(&session));
    let names = session.owned_names();
    let (mut writer, mut reader) =
        queue(names, AnySession::devices(&session), &[&mut everything, &mut counts]);
    let reading = reads.then(|| {
        thread::spawn(move || {
            while reader.read(&mut [&mut everything, &mut counts]) {
                thread::yield_now();
            }
        })
    });
    session.run(Instant::ZERO, &mut Open, &mut [&mut writer]).unwrap();
    let before = allocations();
    session.run(Instant::ZERO + Duration::from_secs(60), &mut Open, &mut [&mut writer]).unwrap();
    let allocated = allocations() - before;
    assert_eq!(session.ending(), None);
    drop(writer);
    reading.into_iter().for_each(|thread| thread.join().unwrap());
    (allocated, seen.load(Ordering::Relaxed))
}

#[test]
fn the_control_thread_allocates_nothing_while_others_read() {
    let (allocated, read) = run(true);
    assert_eq!(allocated, 0);
    assert!(read > 6000, "{read}");
    // A queue that is not read overflows without an allocation.
    assert_eq!(run(false), (0, 0));
}
