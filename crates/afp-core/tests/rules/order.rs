//! Order and priority of supervisors.

use crate::support::build::{actor, guard, plan};
use crate::support::run::{Run, assert_lines};
use crate::support::world::World;

#[test]
fn shorter_deadline_first_then_global_then_as_written() {
    let plan = plan("p")
        .guarded(guard("g20", 20).on("E", "terminate"))
        .guarded(guard("g10", 10).on("E", "terminate"))
        .with(
            actor("a")
                .guarded(guard("l10", 10).on("E", "terminate"))
                .guarded(guard("m10", 10).on("E", "terminate"))
                .guarded(guard("l5", 20).deadline(5).on("E", "terminate"))
                .on("Done", "a"),
        );
    let mut run = Run::started(plan, World::default());
    run.until(10).trace();
    run.step(20);
    assert_lines(
        &run.trace(),
        "0.020000 a.l5 polled: clear
         0.020000 g10 polled: clear
         0.020000 a.l10 polled: clear
         0.020000 a.m10 polled: clear
         0.020000 g20 polled: clear",
    );
}

#[test]
fn after_the_first_event_no_supervisor_is_polled() {
    let plan = plan("p")
        .guarded(guard("late", 30).on("E", "terminate"))
        .with(
            actor("a")
                .guarded(guard("first", 10).on("E", "b"))
                .guarded(guard("second", 10).on("E", "terminate"))
                .on("Done", "a"),
        )
        .with(actor("b").on("Done", "b"));
    let world = World::default().says("first", 0, 10..11).says("second", 0, 10..11);
    let mut run = Run::started(plan, world);
    run.trace();
    run.step(10);
    assert_lines(
        &run.trace(),
        "0.010000 a.first polled: E
         0.010000 a.first event E -> b
         0.010000 a interrupted
         0.010000 b started",
    );
    assert_eq!(run.active(), Some("b"));
}

#[test]
fn an_event_comes_before_an_actor_that_finishes_at_the_same_instant() {
    let plan = plan("p")
        .var("x")
        .with(
            actor("a").guarded(guard("g", 10).on("E", "b")).on("Done", "a").writes("Done", "x", 7),
        )
        .with(actor("b").on("Done", "b"));
    let world = World::default().says("g", 0, 10..11).says("a", 0, 10..11);
    let mut run = Run::started(plan, world);
    run.step(10);
    assert_eq!(run.calls("interrupt"), ["10 interrupt a"]);
    assert!(!run.calls("poll").contains(&"10 poll a"));
    assert_eq!(run.entry("x"), afp_core::Value::Unset);
}

#[test]
fn an_ignored_event_is_not_wanted_and_hides_no_other_event() {
    let plan = plan("p")
        .var("x")
        .with(
            actor("a")
                .guarded(guard("g", 10).on("Left", "ignore").on("Near", "b").writes("Near", "x", 1))
                .on("Done", "a"),
        )
        .with(actor("b").on("Done", "b"));
    let world = World::default().says("g", 0, 10..50).says("g", 1, 30..50);
    let mut run = Run::started(plan, world);
    run.until(20);
    assert_eq!(run.active(), Some("a"));
    run.until(30);
    assert_eq!(run.active(), Some("b"));
    assert_eq!(run.entry("x"), afp_core::Value::Int(1));
}

#[test]
fn several_events_at_once_give_the_first_declared() {
    let plan = plan("p")
        .with(
            actor("a")
                .guarded(guard("g", 10).on("One", "b").on("Two", "terminate"))
                .on("Done", "a"),
        )
        .with(actor("b").on("Done", "b"));
    let world = World::default().says("g", 1, 10..11).says("g", 0, 10..11);
    let mut run = Run::started(plan, world);
    run.step(10);
    assert_eq!(run.active(), Some("b"));
}
