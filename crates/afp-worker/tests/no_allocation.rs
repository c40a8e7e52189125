//! Handing jobs over and asking after them allocates nothing.
//!
//! A test binary of its own, because it counts in the global allocator.

use afp_core::{Duration, Fault, Instant, Job, Poll, Worker};
use afp_counting::{Counting, allocations};
use afp_worker::{ThreadWorker, VirtualWorker};

#[global_allocator]
static ALLOCATOR: Counting = Counting::SYSTEM;

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
    let before = allocations();
    let done = [keep_busy(&mut there), keep_busy(&mut thread)];
    assert_eq!(allocations() - before, 0);
    assert!(done[0] == 25_000 && done[1] > 10, "{done:?}");
}
