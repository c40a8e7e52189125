//! Handing jobs over and asking after them allocates nothing.
//!
//! A test binary of its own, because it counts in the global allocator.
#![allow(unsafe_code, reason = "a global allocator cannot be written without")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use afp_core::{Duration, Fault, Instant, Job, Poll, Worker};
use afp_worker::{ThreadWorker, VirtualWorker};

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

struct Reverse([u8; 256]);

impl Job for Reverse {
    const TAKES: Duration = Duration::from_millis(3);

    fn run(&mut self) -> Result<(), Fault> {
        self.0.reverse();
        Ok(())
    }
}

/// Keeps a worker busy for a while; what it had done.
fn keep_busy(worker: &mut dyn Worker<Reverse>) -> u64 {
    let (mut ticket, mut done) = (None, 0);
    for millis in 0..100_000 {
        let now = Instant::ZERO + Duration::from_millis(millis);
        match ticket {
            None => ticket = worker.begin(now, &mut |job| job.0[0] = 7).unwrap(),
            Some(under_way) => match worker.poll(under_way, now).unwrap() {
                Poll::Pending => {}
                Poll::Ready(job) => {
                    assert_eq!(job.0[255], 7);
                    (ticket, done) = (None, done + 1);
                }
            },
        }
    }
    done
}

#[test]
fn workers_allocate_nothing_once_they_are_made() {
    let mut there = VirtualWorker::new([Reverse([0; 256]), Reverse([0; 256])]);
    let mut thread = ThreadWorker::new("reverse", [Reverse([0; 256])]).unwrap();
    let before = ALLOCATIONS.get();
    let done = [keep_busy(&mut there), keep_busy(&mut thread)];
    assert_eq!(ALLOCATIONS.get() - before, 0);
    assert!(done[0] == 25_000 && done[1] > 10, "{done:?}");
}
