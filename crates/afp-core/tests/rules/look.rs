//! The look before a start.

use afp_core::Value;
use afp_core::trace::Ending;

use crate::support::build::{actor, computation, guard, plan};
use crate::support::run::{Run, assert_lines};
use crate::support::world::World;

#[test]
fn local_supervisors_start_and_look_before_the_actor() {
    let plan = plan("p").with(actor("a").guarded(guard("g", 10).on("E", "a")).on("Done", "a"));
    let run = Run::started(plan, World::default());
    assert_eq!(run.world.calls, ["0 start g", "0 poll g", "0 start a"]);
}

#[test]
fn an_event_in_the_look_diverts_without_interrupt() {
    let plan = plan("p")
        .var("x")
        .with(
            actor("a")
                .guarded(guard("g", 10).on("E", "b").writes("E", "x", 3))
                .reads("x")
                .on("Done", "a"),
        )
        .with(actor("b").on("Done", "b"));
    let mut run = Run::started(plan, World::default().says("g", 0, 0..1));
    assert_lines(
        &run.trace(),
        "0.000000 a.g started
         0.000000 a.g polled: E
         0.000000 a.g event E -> b
         0.000000 a diverted by a.g
         0.000000 a.g commits x: unset -> 3
         0.000000 b started",
    );
    assert_eq!(run.world.calls, ["0 start g", "0 poll g", "0 start b"]);
}

#[test]
fn an_unasked_global_supervisor_looks_before_the_next_actor_starts() {
    let plan = plan("p")
        .guarded(guard("escape", 50).on("Pressed", "terminate"))
        .with(actor("a").guarded(guard("touch", 1).on("Hit", "b")).on("Done", "a"))
        .with(actor("b").on("Done", "b"));
    let world = World::default().says("touch", 0, 50..51).says("escape", 0, 50..51);
    let mut run = Run::started(plan, world);
    run.until(49).trace();
    run.step(50);
    assert_lines(
        &run.trace(),
        "0.050000 a.touch polled: Hit
         0.050000 a.touch event Hit -> b
         0.050000 a interrupted
         0.050000 escape polled: Pressed
         0.050000 escape event Pressed -> terminate
         0.050000 b diverted by escape
         0.050000 p ended Interrupted",
    );
    assert_eq!(run.calls("start"), ["0 start escape", "0 start touch", "0 start a"]);
}

#[test]
fn global_supervisors_look_before_local_supervisors_for_all_deadlines() {
    let plan = plan("p")
        .guarded(guard("slow", 100).on("E", "terminate"))
        .with(actor("a").guarded(guard("fast", 1).on("E", "terminate")).on("Done", "a"));
    let run = Run::started(plan, World::default());
    assert_eq!(run.calls("poll"), ["0 poll slow", "0 poll fast"]);
}

#[test]
fn a_supervisor_is_polled_once_in_a_step() {
    let plan = plan("p")
        .guarded(guard("global", 10).on("E", "terminate"))
        .with(actor("a").on("Done", "b"))
        .with(actor("b").on("Done", "b"));
    let mut run = Run::started(plan, World::default().says("a", 0, 10..11));
    run.world.calls.clear();
    run.step(10);
    assert_eq!(run.world.calls, ["10 poll global", "10 poll a", "10 start b"]);
}

#[test]
fn a_computation_and_terminate_have_no_look() {
    let plan = plan("p")
        .guarded(guard("g", 10).on("E", "terminate"))
        .with(computation("c").on("Done", "terminate"));
    let mut run = Run::started(plan, World::default().says("g", 0, 0..1));
    assert_eq!(run.world.calls, ["0 start g", "0 start c"]);
    assert_eq!(run.ending(), Some(Ending::Ok));
    assert_lines(
        &run.trace(),
        "0.000000 g started
         0.000000 c finished Done -> terminate
         0.000000 p ended OK",
    );
}

#[test]
fn after_an_event_at_plan_start_no_actor_starts() {
    let plan =
        plan("p").guarded(guard("g", 10).on("E", "terminate")).with(actor("a").on("Done", "a"));
    let run = Run::started(plan, World::default().says("g", 0, 0..1));
    assert_eq!(run.world.calls, ["0 start g", "0 poll g"]);
    assert_eq!(run.ending(), Some(Ending::Interrupted));
}

#[test]
fn inputs_are_read_after_the_look() {
    let plan = plan("p")
        .var("x")
        .with(computation("c").on("Done", "a").writes("Done", "x", 1))
        .with(actor("a").guarded(guard("g", 10).on("E", "b").writes("E", "x", 2)).on("Done", "a"))
        .with(actor("b").reads("x").on("Done", "b"));
    let run = Run::started(plan, World::default().says("g", 0, 0..1));
    assert_eq!(run.calls("see"), ["0 see 2 b"]);
    assert_eq!(run.entry("x"), Value::Int(2));
}
