//! Repeats steps of a plan as a driver would.

use std::hint::black_box;

use afp_core::rt::Plan;
use afp_core::trace::Sink;
use afp_core::{Clock, Instant, Scheduler};

use crate::board::Board;

/// The time from one step to the next, in nanoseconds, and the period of everything.
pub const PERIOD: u64 = 10_000_000;

/// Starts a plan; what comes back repeats its step, everything due every time.
pub fn steps<P, S, C>(plan: P, mut sink: S, clock: C) -> impl FnMut(u64)
where
    P: Plan<Board>,
    S: Sink,
    C: Clock,
{
    let mut board = Board::quiet();
    let mut plan = Scheduler::new(plan);
    let mut last = 0;
    let started = plan.start(&mut board, &mut sink, &clock, Instant::ZERO);
    assert!(started.is_ok(), "all inputs have defaults");
    move |count| {
        let mut at = last;
        for _ in 0..count {
            at += PERIOD;
            let (plan, board) = (black_box(&mut plan), black_box(&mut board));
            let now = Instant::from_nanos(black_box(at));
            black_box(plan.step(board, &mut sink, &clock, now));
        }
        last = at;
        assert!(plan.ending().is_none(), "nothing happens that could end it");
    }
}
