//! The order of records within a step.

use afp_core::Value;
use afp_core::trace::EntryKind;

use crate::support::build::{actor, guard, plan, sub_plan};
use crate::support::run::{Run, assert_lines};
use crate::support::world::{Phase, World};

#[test]
fn the_trace_has_outside_writes_polls_the_event_interrupts_commits_and_starts() {
    let inner = plan("Inner").with(actor("work").on("Done", "terminate"));
    let plan = plan("p")
        .entry("x", EntryKind::Var, Value::Int(0))
        .var("y")
        .guarded(guard("first", 10).deadline(1).on("E", "a"))
        .guarded(guard("second", 10).deadline(2).on("E", "a").writes("E", "y", 8))
        .with(sub_plan("s", inner).on("OK", "s"))
        .with(actor("a").guarded(guard("eye", 10).on("E", "b")).on("Done", "a"))
        .with(actor("b").guarded(guard("ear", 10).on("E", "a")).on("Done", "b"));
    let world = World::default()
        .costs("first", Phase::Poll, 2, 10..11)
        .says("second", 0, 10..11)
        .says("eye", 0, 10..11);
    let mut run = Run::started(plan, world);
    run.trace();
    run.write("x", 1).expect("it fits");
    run.step(10);
    assert_lines(
        &run.trace(),
        "0.010000 outside commits x: 0 -> 1
         0.010000 first polled: clear
         0.010000 first missed its deadline by 0.001000 (long poll, 0 skipped)
         0.010000 second polled: E
         0.010000 second event E -> a
         0.010000 s.work interrupted
         0.010000 s interrupted
         0.010000 second commits y: unset -> 8
         0.010000 a.eye started
         0.010000 a.eye polled: E
         0.010000 a.eye event E -> b
         0.010000 a diverted by a.eye
         0.010000 b.ear started
         0.010000 b.ear polled: clear
         0.010000 b started",
    );
}
