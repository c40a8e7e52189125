//! Consequences of a failing component, in the order of the table of faults.

use afp_core::trace::Ending;
use afp_core::{Fault, Value};

use crate::support::build::{Builder, actor, computation, guard, plan};
use crate::support::run::{Run, assert_lines};
use crate::support::world::{Phase, SCRIPTED, World};

/// An actor with a local supervisor and an `Error` edge to another actor.
fn guarded_actor() -> Builder {
    plan("p")
        .var("x")
        .guarded(guard("global", 100).on("E", "b"))
        .with(
            actor("a")
                .guarded(guard("g", 10).on("E", "terminate").writes("E", "x", 1))
                .on("Done", "terminate")
                .writes("Done", "x", 1)
                .on_error("b"),
        )
        .with(actor("b").on("Done", "b"))
}

/// The stop and interrupt calls.
fn stops(run: &Run) -> Vec<&str> {
    let is_stop = |call: &&str| call.contains("interrupt") || call.contains("stop");
    run.world.calls.iter().map(String::as_str).filter(is_stop).collect()
}

#[test]
fn start_of_an_actor_stops_the_platform_and_takes_the_error_edge() {
    let mut run = Run::started(guarded_actor(), World::default().fails("a", Phase::Start, 0..1));
    assert_eq!(stops(&run), ["0 stop"]);
    assert_eq!(run.active(), Some("b"));
    assert_lines(
        &run.story(),
        "0.000000 global started
         0.000000 a.g started
         0.000000 a fault scripted: as the script says -> b
         0.000000 b started",
    );
}

#[test]
fn poll_of_an_actor_interrupts_it_once_and_takes_the_error_edge() {
    let mut run = Run::started(guarded_actor(), World::default().fails("a", Phase::Poll, 10..11));
    run.trace();
    run.step(10);
    assert_eq!(stops(&run), ["10 interrupt a"]);
    assert_lines(
        &run.story(),
        "0.010000 a fault scripted: as the script says -> b
         0.010000 a interrupted
         0.010000 b started",
    );
}

#[test]
fn output_of_an_actor_commits_nothing_and_interrupts_it() {
    let world = World::default().says("a", 0, 10..11).fails("a", Phase::Output, 10..11);
    let mut run = Run::started(guarded_actor(), world);
    run.step(10);
    assert_eq!(stops(&run), ["10 interrupt a"]);
    assert_eq!((run.active(), run.entry("x")), (Some("b"), Value::Unset));
}

#[test]
fn values_of_a_failed_commit_are_not_part_of_the_next_commit() {
    let plan = plan("p")
        .var("x")
        .var("y")
        .with(actor("a").on("Done", "a").writes("Done", "x", 1).on_error("b"))
        .with(actor("b").on("Done", "b").writes("Done", "y", 2));
    let world = World::default().says("a", 0, 10..11).fails("a", Phase::Output, 10..11).says(
        "b",
        0,
        20..21,
    );
    let mut run = Run::started(plan, world);
    run.until(20);
    assert_eq!((run.entry("x"), run.entry("y")), (Value::Unset, Value::Int(2)));
}

#[test]
fn start_of_a_local_supervisor_takes_its_actors_error_edge_without_a_stop() {
    let run = Run::started(guarded_actor(), World::default().fails("g", Phase::Start, 0..1));
    assert_eq!(stops(&run), [""; 0]);
    assert_eq!(run.active(), Some("b"));
    assert_eq!(run.calls("start"), ["0 start global", "0 start g", "0 start b"]);
}

#[test]
fn look_of_a_local_supervisor_takes_its_actors_error_edge() {
    let run = Run::started(guarded_actor(), World::default().fails("g", Phase::Poll, 0..1));
    assert_eq!(stops(&run), [""; 0]);
    assert_eq!(run.active(), Some("b"));
}

#[test]
fn poll_of_a_local_supervisor_interrupts_its_actor_and_takes_its_error_edge() {
    let mut run = Run::started(guarded_actor(), World::default().fails("g", Phase::Poll, 10..11));
    run.trace();
    run.step(10);
    assert_eq!(stops(&run), ["10 interrupt a"]);
    assert_lines(
        &run.trace(),
        "0.010000 a.g polled: fault scripted
         0.010000 a.g fault scripted: as the script says
         0.010000 a interrupted
         0.010000 b started",
    );
}

#[test]
fn output_of_a_local_supervisor_commits_nothing() {
    let world = World::default().says("g", 0, 10..11).fails("g", Phase::Output, 10..11);
    let mut run = Run::started(guarded_actor(), world);
    run.trace();
    run.step(10);
    assert_lines(
        &run.trace(),
        "0.010000 a.g polled: E
         0.010000 a.g fault scripted: as the script says
         0.010000 a interrupted
         0.010000 b started",
    );
    assert_eq!(run.entry("x"), Value::Unset);
}

#[test]
fn output_of_an_event_that_is_not_taken_does_not_matter() {
    let world = World::default().says("global", 0, 100..101).fails("global", Phase::Output, 0..200);
    let plan =
        plan("p").guarded(guard("global", 100).on("E", "a")).with(actor("a").on("Done", "a"));
    let mut run = Run::started(plan, world);
    run.until(100);
    assert_eq!(run.active(), Some("a"));
}

#[test]
fn start_of_a_global_supervisor_ends_its_plan() {
    let run = Run::started(guarded_actor(), World::default().fails("global", Phase::Start, 0..1));
    assert_eq!(run.ending(), Some(Ending::Error(SCRIPTED)));
    assert_eq!(run.world.calls, ["0 start global"]);
}

#[test]
fn poll_of_a_global_supervisor_interrupts_and_ends_its_plan() {
    let world = World::default().fails("global", Phase::Poll, 100..101);
    let mut run = Run::started(guarded_actor(), world);
    run.until(99).trace();
    run.step(100);
    assert_eq!(run.ending(), Some(Ending::Error(SCRIPTED)));
    assert_lines(
        &run.story(),
        "0.100000 global polled: fault scripted
         0.100000 global fault scripted: as the script says
         0.100000 a interrupted
         0.100000 p ended Error(scripted)",
    );
}

#[test]
fn a_global_supervisor_that_fails_in_the_look_ends_its_plan() {
    let run = Run::started(guarded_actor(), World::default().fails("global", Phase::Poll, 0..1));
    assert_eq!(run.ending(), Some(Ending::Error(SCRIPTED)));
    assert_eq!(stops(&run), [""; 0]);
}

#[test]
fn a_computation_takes_its_error_edge() {
    for phase in [Phase::Start, Phase::Output] {
        let plan = plan("p")
            .var("x")
            .with(computation("c").on("Done", "terminate").writes("Done", "x", 1).on_error("b"))
            .with(actor("b").on("Done", "b"));
        let run = Run::started(plan, World::default().fails("c", phase, 0..1));
        assert_eq!((run.active(), run.entry("x")), (Some("b"), Value::Unset), "{phase:?}");
        assert_eq!(stops(&run), [""; 0]);
    }
}

#[test]
fn unconnected_the_plan_ends_in_error() {
    let plan = plan("p").with(actor("a").on("Done", "a"));
    let mut run = Run::started(plan, World::default().fails("a", Phase::Poll, 10..11));
    run.step(10);
    assert_eq!(run.ending(), Some(Ending::Error(SCRIPTED)));
    assert_eq!((stops(&run), run.emergency_stops()), (vec!["10 interrupt a"], 0));
}

#[test]
fn an_error_edge_to_terminate_ends_the_plan_ok() {
    let plan = plan("p").with(actor("a").on("Done", "a").on_error("terminate"));
    let run = Run::started(plan, World::default().fails("a", Phase::Start, 0..1));
    assert_eq!(run.ending(), Some(Ending::Ok));
}

#[test]
fn a_failed_interrupt_ends_the_run_despite_an_error_edge() {
    for (who, phase) in [("g", Phase::Poll), ("a", Phase::Poll)] {
        let world = World::default().fails(who, phase, 10..11).fails("a", Phase::Interrupt, 10..11);
        let mut run = Run::started(guarded_actor(), world);
        run.step(10);
        assert_eq!(run.ending(), Some(Ending::Error(SCRIPTED)));
        assert_eq!(stops(&run), ["10 interrupt a", "emergency stop"]);
        assert_eq!(run.calls("start").last(), Some(&"0 start a"));
    }
}

#[test]
fn an_event_whose_interrupt_fails_commits_nothing() {
    let world = World::default().says("g", 0, 10..11).fails("a", Phase::Interrupt, 10..11);
    let mut run = Run::started(guarded_actor(), world);
    run.trace();
    run.step(10);
    assert_eq!(run.entry("x"), Value::Unset);
    assert_lines(
        &run.trace(),
        "0.010000 a.g polled: E
         0.010000 a.g event E -> terminate
         0.010000 a fault scripted: as the script says -> b
         0.010000 p fault scripted: as the script says
         0.010000 p ended Error(scripted)",
    );
}

#[test]
fn an_initial_value_that_cannot_be_computed_ends_the_plan() {
    let plan = plan("p").broken("x").with(actor("a").on("Done", "a"));
    let mut run = Run::started(plan, World::default());
    assert_eq!(run.ending(), Some(Ending::Error(Fault::ARITHMETIC)));
    assert_eq!(run.world.calls, [""; 0]);
    assert_lines(
        &run.trace(),
        "0.000000 p fault arithmetic: a formula overflowed, divided by zero, or has no finite value
         0.000000 p ended Error(arithmetic)",
    );
}

#[test]
fn a_panic_ends_the_run_with_an_emergency_stop() {
    let mut run = Run::started(guarded_actor(), World::default());
    run.abort();
    assert_eq!(run.ending(), Some(Ending::Error(Fault::PANIC)));
    assert_eq!(stops(&run), ["emergency stop"]);
    assert_eq!(run.step(10), afp_core::Wake::Ended(Ending::Error(Fault::PANIC)));
}
