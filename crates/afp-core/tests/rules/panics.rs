//! Panics of a component: no component is called again, and the platform stops.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};

use afp_core::trace::{Ending, Observe, Record};
use afp_core::{Clock, Fault, Instant, StillClock, Wake, WriteError};

use crate::support::build::{Builder, actor, computation, guard, plan, sub_plan};
use crate::support::ms;
use crate::support::run::{Run, assert_lines};
use crate::support::world::{Phase, World};

const ENDED: Wake = Wake::Ended(Ending::Error(Fault::PANIC));

/// A global supervisor, an actor with a local supervisor, a computation, and a sub-plan with the
/// same.
fn everything() -> Builder {
    let inner = plan("Inner")
        .guarded(guard("watch", 30).on("E", "terminate"))
        .with(actor("deep").guarded(guard("near", 30).on("E", "deep")).on("Done", "deep"));
    plan("p")
        .var("x")
        .guarded(guard("global", 20).on("E", "s"))
        .with(actor("a").guarded(guard("g", 20).on("E", "c")).on("Done", "s").on_error("a"))
        .with(computation("c").on("Done", "s").on_error("a"))
        .with(sub_plan("s", inner).on("OK", "a").on("Interrupted", "a").on_error("a"))
}

/// Steps until a call panics.
fn broken(world: World) -> Run {
    let mut run = Run::ready(everything(), world);
    let caught = catch_unwind(AssertUnwindSafe(|| {
        run.start().expect("it can start");
        run.until(200);
    }));
    assert!(caught.is_err(), "nobody panicked: {:?}", run.world.calls);
    run
}

#[test]
fn a_panic_anywhere_breaks_the_plan() {
    let quiet = World::default;
    let into_s = || World::default().says("a", 0, 10..11);
    let cases = [
        ("a", quiet().panics("a", Phase::Start, 0..1)),
        ("a", quiet().panics("a", Phase::Poll, 10..11)),
        ("a", quiet().says("g", 0, 20..21).panics("a", Phase::Interrupt, 20..21)),
        ("a.g", quiet().panics("g", Phase::Start, 0..1)),
        ("a.g", quiet().panics("g", Phase::Poll, 20..21)),
        ("global", quiet().panics("global", Phase::Start, 0..1)),
        ("global", quiet().panics("global", Phase::Poll, 20..21)),
        ("c", quiet().says("g", 0, 20..21).panics("c", Phase::Start, 20..21)),
        ("s.deep", into_s().panics("deep", Phase::Start, 10..11)),
        ("s.deep", into_s().panics("deep", Phase::Poll, 20..21)),
        ("s.deep.near", into_s().panics("near", Phase::Poll, 40..41)),
        ("s.watch", into_s().panics("watch", Phase::Poll, 40..41)),
    ];
    for (who, world) in cases {
        let mut run = broken(world);
        run.trace();
        let before = run.world.calls.len();
        assert_eq!(run.write("x", 1), Err(WriteError::Ended), "{who}");
        assert_eq!(run.step(300), ENDED, "{who}");
        assert_eq!(run.world.calls[before..], ["emergency stop"], "{who}");
        let lines = run.trace();
        let fault = format!("{who} fault panic: a component panicked");
        assert!(lines[0].contains(&fault), "{who}: {lines:?}");
        assert!(lines[1].ends_with("p ended Error(panic)") && lines.len() == 2, "{lines:?}");
        assert_eq!(run.ending(), Some(Ending::Error(Fault::PANIC)), "{who}");
        assert_eq!((run.step(400), run.trace().len()), (ENDED, 0), "{who}");
        assert_eq!(run.emergency_stops(), 1, "{who}");
    }
}

#[test]
fn until_the_platform_is_stopped_a_broken_plan_has_not_ended() {
    let run = broken(World::default().panics("a", Phase::Poll, 10..11));
    assert_eq!((run.ending(), run.emergency_stops()), (None, 0));
}

#[test]
fn start_and_abort_end_a_broken_plan_too() {
    let mut run = broken(World::default().panics("a", Phase::Start, 0..1));
    assert_eq!(run.start(), Ok(ENDED));
    assert_eq!(run.emergency_stops(), 1);
    let mut run = broken(World::default().panics("a", Phase::Poll, 10..11));
    run.trace();
    run.abort();
    assert_lines(
        &run.trace(),
        "0.010000 a fault panic: a component panicked -> a
         0.010000 p ended Error(panic)",
    );
    assert_eq!((run.ending(), run.emergency_stops()), (Some(Ending::Error(Fault::PANIC)), 1));
}

#[test]
fn a_panic_while_the_plan_is_stopped_breaks_it() {
    let mut run =
        Run::started(everything(), World::default().panics("a", Phase::Interrupt, 15..16));
    run.scheduler.request_stop();
    assert!(catch_unwind(AssertUnwindSafe(|| run.step(15))).is_err());
    assert_eq!(run.step(16), ENDED);
    assert_eq!(run.world.calls.last().map(String::as_str), Some("emergency stop"));
}

/// Panics at its n-th reading from now on.
struct BreakingClock(Cell<u32>);

impl Clock for BreakingClock {
    fn now(&self, step: Instant) -> Instant {
        self.0.set(self.0.get().checked_sub(1).expect("the clock is broken"));
        step
    }
}

#[test]
fn a_panic_of_the_sink_or_the_clock_belongs_to_no_component() {
    let of_sink = |run: &mut Run| {
        let mut sink = Observe(|_: Instant, record: &Record<'_>| {
            assert!(!matches!(record, Record::Polled { .. }), "the disk is full");
        });
        run.scheduler.step((&mut run.world, &mut sink, &StillClock), ms(20));
    };
    // The first reading begins the step, the second follows a poll.
    let of_clock = |run: &mut Run, readings: u32| {
        let clock = BreakingClock(Cell::new(readings));
        let mut sink = Observe(|_: Instant, _: &Record<'_>| {});
        run.scheduler.step((&mut run.world, &mut sink, &clock), ms(20));
    };
    let cases: [&dyn Fn(&mut Run); 3] =
        [&of_sink, &|run| of_clock(run, 0), &|run| of_clock(run, 1)];
    for (n, case) in cases.iter().enumerate() {
        let mut run = Run::started(everything(), World::default());
        run.until(10);
        run.trace();
        let caught = catch_unwind(AssertUnwindSafe(|| case(&mut run)));
        assert!(caught.is_err(), "case {n}");
        assert_eq!(run.step(300), Wake::Ended(Ending::Error(Fault::PANIC_OUTSIDE)), "case {n}");
        assert_lines(
            &run.trace(),
            "0.020000 p fault panic-outside: the sink or the clock of the run panicked
             0.020000 p ended Error(panic-outside)",
        );
        assert_eq!(run.failure().as_deref(), Some("p: the sink or the clock of the run panicked"));
        assert_eq!(run.emergency_stops(), 1);
    }
}
