//! Events that do not interrupt.

use crate::support::build::{actor, computation, guard, plan};
use crate::support::run::{Run, assert_lines};
use crate::support::world::World;

#[test]
fn after_resume_the_other_supervisors_are_polled_and_see_the_write() {
    let plan = plan("p").var("x").with(
        actor("a")
            .live("x")
            .guarded(guard("first", 10).on("E", "resume").writes("E", "x", 3))
            .guarded(guard("second", 10).live("x").on("E", "resume"))
            .on("Done", "a"),
    );
    let world = World::default().says("first", 0, 10..11);
    let mut run = Run::started(plan, world);
    run.trace();
    run.step(10);
    assert_lines(
        &run.trace(),
        "0.010000 a.first polled: E
         0.010000 a.first event E -> resume
         0.010000 a.first commits x: unset -> 3
         0.010000 a resumed by a.first
         0.010000 a.second polled: clear",
    );
    assert_eq!(run.active(), Some("a"));
}

#[test]
fn computations_that_lead_elsewhere_interrupt_after_their_commits() {
    let plan = plan("p")
        .var("x")
        .with(
            actor("a")
                .guarded(guard("first", 10).on("E", "ask"))
                .guarded(guard("second", 10).on("E", "terminate"))
                .on("Done", "a"),
        )
        .with(computation("ask").on("No", "also").on("Yes", "resume").writes("No", "x", 7))
        .with(computation("also").on("No", "b").on_error("ask"))
        .with(actor("b").on("Done", "b"));
    let mut run = Run::started(plan, World::default().says("first", 0, 10..11));
    run.trace();
    run.step(10);
    assert_lines(
        &run.trace(),
        "0.010000 a.first polled: E
         0.010000 a.first event E -> ask
         0.010000 ask finished No -> also
         0.010000 ask commits x: unset -> 7
         0.010000 also finished No -> b
         0.010000 a interrupted
         0.010000 b started",
    );
    assert_eq!(run.active(), Some("b"));
}
