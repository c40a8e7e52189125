//! Repeats steps of a plan like a driver.

use std::hint::black_box;

use afp_core::rt::{NamedPlan, Plan};
use afp_core::trace::Sink;
use afp_core::{Clock, Instant, Scheduler};
use afp_session::{AnySession, Keep, Open, Session};

use crate::board::Board;

/// The time between two steps in nanoseconds, which is also the period of all guards.
pub const PERIOD: u64 = 10_000_000;

/// Starts a plan and returns a function that repeats its step, with everything due every time.
pub fn steps<P, S, C>(plan: P, mut sink: S, clock: C) -> impl FnMut(u64)
where
    P: Plan<Board>,
    S: Sink,
    C: Clock,
{
    let mut board = Board::quiet();
    let mut plan = Scheduler::new(plan);
    let mut last = 0;
    let started = plan.start((&mut board, &mut sink, &clock), Instant::ZERO);
    assert!(started.is_ok(), "all inputs have defaults");
    move |count| {
        let mut at = last;
        for _ in 0..count {
            at += PERIOD;
            let (plan, board) = (black_box(&mut plan), black_box(&mut board));
            let now = Instant::from_nanos(black_box(at));
            // By reference: a copy of freshly written parts would stall for longer than the step.
            black_box(&plan.step((&mut *board, &mut sink, &clock), now));
        }
        last = at;
        assert!(plan.ending().is_none(), "nothing happens that could end it");
    }
}

/// The same steps in a session without observers.
pub fn session_steps<P, S>(plan: P, sink: S) -> impl FnMut(u64)
where
    P: NamedPlan + Plan<Board>,
    S: Keep,
{
    let mut session = Session::with_sink(plan, Board::quiet(), sink);
    let mut last = 0;
    run(&mut session, last);
    move |count| {
        last += count * PERIOD;
        run(black_box(&mut session), black_box(last));
    }
}

fn run<P: NamedPlan + Plan<Board>, S: Keep>(session: &mut Session<P, Board, S>, until: u64) {
    let went = session.run(Instant::from_nanos(until), &mut Open, &mut []);
    assert!(went.is_ok() && session.ending().is_none(), "nothing happens that could end it");
}

/// The same steps in a type-erased session.
pub fn any_session_steps<P>(plan: P) -> impl FnMut(u64)
where
    P: NamedPlan + Plan<Board>,
    Session<P, Board>: AnySession + 'static,
{
    let mut session: Box<dyn AnySession> = Box::new(Session::new(plan, Board::quiet()));
    let mut last = 0;
    move |count| {
        last += count * PERIOD;
        let until = Instant::from_nanos(black_box(last));
        let went = black_box(&mut session).run(until, &mut Open, &mut []);
        assert!(went.is_ok() && session.ending().is_none(), "nothing happens that could end it");
    }
}
