//! A million steps of a plan without one allocation, in either back end.
//!
//! A test binary of its own, because it counts in the global allocator.
#![allow(unsafe_code, reason = "a global allocator cannot be written without")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use afp_core::rt::Plan;
use afp_core::trace::NoTrace;
use afp_core::{Instant, Scheduler, StillClock, Wake};
use afp_tests::interpret::{graph, load};
use afp_tests::platform::{CostClock, Log, Platform};
use afp_tests::script::Script;

/// The plan as Rust.
mod plans {
    include!(concat!(env!("OUT_DIR"), "/steps.rs"));
}

const STEPS: u64 = 1_000_000;

/// Times change by the millisecond; faults and stops would end the run or need the log.
const SCRIPT: &str = "show nothing
    from 50000 ms to 200000 ms: near Seen
    from 150000 ms to 300000 ms: drive Done
    from 300000 ms to 500000 ms: drive Other
    from 100000 ms to 250000 ms: work Done = 2
    from 250000 ms to 320000 ms: work Other
    from 320000 ms to 400000 ms: work Done = 4
    from 400000 ms to 450000 ms: touch Seen
    from 450000 ms to 900000 ms: work Other = 5
    from 600000 ms to 650000 ms: work fault
    from 700000 ms to 750000 ms: drive start fault
    from 800000 ms to 850000 ms: global First";

thread_local! {
    /// Of this thread alone: the test harness allocates on its own.
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

struct Counting;

// Safety: every call goes to the system's allocator unchanged; counting touches no memory of it.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // Safety: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        // Safety: `at` came from `System` through `alloc`, with this layout.
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Steps a plan each millisecond; how often it allocated, and how often the active element of the
/// outermost plan changed.
fn run<P: Plan<Platform>>(plan: P) -> (u64, u64) {
    let script: Script = SCRIPT.parse().expect("a script that can be read");
    let mut platform = Platform::new(script, Log::default(), CostClock::default());
    let mut scheduler = Scheduler::new(plan);
    let started = scheduler.start(&mut platform, &mut NoTrace, &StillClock, Instant::ZERO);
    assert!(matches!(started, Ok(Wake::At(_))));
    let (before, mut changes) = (ALLOCATIONS.get(), 0);
    for step in 1..=STEPS {
        let active = scheduler.active();
        let now = Instant::from_nanos(step * 1_000_000);
        let wake = scheduler.step(&mut platform, &mut NoTrace, &StillClock, now);
        assert!(matches!(wake, Wake::At(_)), "it ended at {now}");
        changes += u64::from(scheduler.active() != active);
    }
    (ALLOCATIONS.get() - before, changes)
}

#[test]
fn neither_back_end_allocates_after_the_start() {
    let text = include_str!("../plans/steps.afp");
    let graph = graph("steps", text).unwrap_or_else(|errors| panic!("{errors}"));
    let interpreted = run(load(&graph));
    let generated = run(plans::steps::new());
    assert_eq!(interpreted, generated);
    assert_eq!(generated.0, 0);
    assert!(generated.1 > 1000, "only {} transitions", generated.1);
}
