//! Interrupting, finishing, committing.

use afp_core::Value;
use afp_core::trace::{Ending, EntryKind};

use crate::support::build::{actor, computation, guard, plan};
use crate::support::run::{Run, assert_lines};
use crate::support::world::World;

#[test]
fn interrupt_is_called_once_and_before_anything_else_starts() {
    let plan = plan("p")
        .with(actor("a").guarded(guard("g", 10).on("E", "b")).on("Done", "a"))
        .with(actor("b").guarded(guard("h", 10).on("E", "a")).on("Done", "b"));
    let mut run = Run::started(plan, World::default().says("g", 0, 10..11));
    run.world.calls.clear();
    run.step(10);
    assert_eq!(
        run.world.calls,
        ["10 poll g", "10 interrupt a", "10 start h", "10 poll h", "10 start b"]
    );
}

#[test]
fn an_actor_that_finished_is_not_interrupted() {
    let plan = plan("p").with(actor("a").on("Done", "b")).with(actor("b").on("Done", "terminate"));
    let world = World::default().says("a", 0, 10..11).says("b", 0, 20..21);
    let mut run = Run::started(plan, world);
    run.until(100);
    assert_eq!(run.calls("interrupt"), [""; 0]);
    assert_eq!(run.ending(), Some(Ending::Ok));
}

#[test]
fn outputs_are_one_commit_with_old_and_new_values() {
    let plan = plan("p")
        .entry("x", EntryKind::Var, Value::Int(1))
        .var("y")
        .with(actor("a").on("Done", "a").writes("Done", "y", 5).writes("Done", "x", 4));
    let mut run = Run::started(plan, World::default().says("a", 0, 10..11));
    assert_lines(
        &run.trace(),
        "0.000000 p commits x: unset -> 1
         0.000000 a started",
    );
    run.step(10);
    assert_lines(
        &run.trace(),
        "0.010000 a finished Done -> a
         0.010000 a commits x: 1 -> 4
         0.010000 a commits y: unset -> 5
         0.010000 a started",
    );
}

#[test]
fn only_the_outputs_of_the_state_reached_are_written() {
    let plan = plan("p")
        .var("x")
        .with(computation("c").on("One", "terminate").on("Two", "terminate").writes("One", "x", 1));
    let run = Run::started(plan, World::default().says("c", 1, 0..1));
    assert_eq!((run.entry("x"), run.ending()), (Value::Unset, Some(Ending::Ok)));
}

#[test]
fn an_event_edge_to_an_actor_that_then_terminates_is_ok() {
    let plan = plan("p")
        .with(actor("a").guarded(guard("g", 10).on("E", "b")).on("Done", "a"))
        .with(actor("b").on("Done", "terminate"));
    let world = World::default().says("g", 0, 10..11).says("b", 0, 20..21);
    let mut run = Run::started(plan, world);
    run.until(20);
    assert_eq!(run.ending(), Some(Ending::Ok));
}

#[test]
fn live_inputs_see_committed_entries_at_each_poll() {
    let plan = plan("p")
        .entry("limit", EntryKind::Var, Value::Int(10))
        .guarded(guard("near", 10).on("E", "a").live("limit"))
        .with(actor("a").on("Done", "b").writes("Done", "limit", 20))
        .with(actor("b").on("Done", "b"));
    let mut run = Run::started(plan, World::default().says("a", 0, 10..11));
    run.until(20);
    assert_eq!(run.calls("see"), ["0 see 10 near", "10 see 10 near", "20 see 20 near"]);
}
