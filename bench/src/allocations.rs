//! Counts what a step allocates.

use std::alloc::{GlobalAlloc, Layout};
use std::sync::atomic::{AtomicU64, Ordering};

use afp_core::StillClock;
use afp_core::trace::NoTrace;
use mimalloc::MiMalloc;

use crate::clocks::Ring;
use crate::plans::{loaded_step, loaded_transition, step::Step, transition::Transition};
use crate::report::{Report, Row};
use crate::steps::steps;

/// Steps that are watched.
const STEPS: u64 = 1_000_000;

static ALLOCATIONS: AtomicU64 = AtomicU64::new(0);

/// The allocator of the command line, counting.
struct Counting;

#[allow(unsafe_code, reason = "an allocator cannot be written otherwise")]
// Safety: every call goes to the other allocator as it came.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        // Safety: the caller keeps the contract, which is the same.
        unsafe { MiMalloc.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // Safety: the caller keeps the contract, which is the same.
        unsafe { MiMalloc.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        // Safety: the caller keeps the contract, which is the same.
        unsafe { MiMalloc.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Counts in a million steps each, with nothing happening and with a transition in every step.
pub fn run(_: u32, report: &mut Report) {
    count(report, "generated, step", steps(Step::new(), NoTrace, StillClock));
    count(report, "generated, transition", steps(Transition::new(), Ring::new(), StillClock));
    count(report, "interpreted, step", steps(loaded_step(), NoTrace, StillClock));
    count(report, "interpreted, transition", steps(loaded_transition(), Ring::new(), StillClock));
}

fn count(report: &mut Report, name: &str, mut steps: impl FnMut(u64)) {
    let before = ALLOCATIONS.load(Ordering::Relaxed);
    steps(STEPS);
    let count = ALLOCATIONS.load(Ordering::Relaxed) - before;
    let row = Row::new(format!("allocations in 10^6 steps/{name}"), count as f64, "");
    report.add(row.limit("= 0", count == 0));
}
