//! A million steps with transitions and commits, without one allocation.
//!
//! The test is a separate binary, because it counts in the global allocator.

mod support;

use afp_core::trace::NoTrace;
use afp_core::{Scheduler, StillClock, Wake};
use afp_counting::{Counting, allocations};

use support::build::{actor, computation, guard, plan, sub_plan};
use support::ms;
use support::scripted::Scripted;
use support::world::World;

#[global_allocator]
static ALLOCATOR: Counting = Counting::SYSTEM;

#[test]
fn a_million_steps_allocate_nothing() {
    let inner = plan("Inner")
        .guarded(guard("inner", 10).on("E", "terminate"))
        .with(actor("work").on("Done", "terminate"));
    let plan = plan("p")
        .var("x")
        .guarded(guard("global", 10).on("E", "terminate"))
        .with(
            actor("a").guarded(guard("local", 5).on("E", "c").writes("E", "x", 1)).on("Done", "c"),
        )
        .with(computation("c").on("Done", "s").writes("Done", "x", 2))
        .with(sub_plan("s", inner).on("OK", "a").on("Interrupted", "a"));
    let mut world = World::quiet()
        .says("local", 0, 100_000..200_000)
        .says("a", 0, 200_000..300_000)
        .says("work", 0, 100_000..250_000)
        .says("inner", 0, 250_000..300_000);
    let mut scheduler = Scheduler::new(Scripted::new(plan.build()));
    let started = scheduler.start((&mut world, &mut NoTrace, &StillClock), ms(0));
    assert!(started.is_ok());
    let before = allocations();
    for at in 1..=1_000_000 {
        let wake = scheduler.step((&mut world, &mut NoTrace, &StillClock), ms(at));
        assert!(matches!(wake, Wake::At(_)));
    }
    assert_eq!(allocations() - before, 0);
}
