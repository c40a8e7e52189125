//! Submitting and fetching jobs allocates nothing.
//!
//! The test is a separate binary, because it counts in the global allocator.

use afp_core::{Duration, Fault, Instant, Job, Poll, Worker};
use afp_counting::{Counting, allocations};
use afp_platform::{ThreadWorker, VirtualWorker};

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

/// Timeout for a thread's jobs, on any machine.
const PATIENCE: std::time::Duration = std::time::Duration::from_secs(60);

/// Keeps a worker busy for this many jobs.
fn keep_busy(worker: &mut dyn Worker<Reverse>, jobs: u32) {
    let begin = std::time::Instant::now();
    let (mut ticket, mut done) = (None, 0);
    for millis in 0.. {
        let now = Instant::ZERO + Duration::from_millis(millis);
        match ticket {
            None if done == jobs => return,
            None => ticket = worker.begin(now, &mut |job| job.0[0] = 7).unwrap(),
            Some(under_way) => match worker.poll(under_way, now).unwrap() {
                Poll::Pending => std::thread::yield_now(),
                Poll::Ready(job) => {
                    assert_eq!(job.0[255], 7);
                    (ticket, done) = (None, done + 1);
                }
            },
        }
        assert!(begin.elapsed() < PATIENCE, "{done} of {jobs} jobs are done");
    }
}

#[test]
fn workers_do_not_allocate_after_their_creation() {
    let mut there = VirtualWorker::new([Reverse([0; 256]), Reverse([0; 256])]);
    let mut thread = ThreadWorker::new("reverse", [Reverse([0; 256])]).unwrap();
    let before = allocations();
    keep_busy(&mut there, 25_000);
    keep_busy(&mut thread, 100);
    assert_eq!(allocations() - before, 0);
}
