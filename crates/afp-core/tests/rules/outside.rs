//! Writes and stop requests from outside.

use afp_core::trace::{Ending, EntryKind};
use afp_core::{EntryId, MAX_WRITES_PER_STEP, StartError, Value, Wake, WriteError};

use crate::support::build::{Builder, actor, guard, plan};
use crate::support::run::{Run, assert_lines};
use crate::support::world::{Phase, SCRIPTED, World};

fn watched() -> Builder {
    plan("p")
        .entry("size", EntryKind::In, Value::Int(1))
        .var("x")
        .var("y")
        .entry("fixed", EntryKind::Const, Value::Int(1))
        .entry("result", EntryKind::Out, Value::Unset)
        .with(actor("a").guarded(guard("g", 10).on("E", "a").live("x")).live("x").on("Done", "a"))
}

#[test]
fn writes_are_one_commit_at_the_start_of_the_next_step_and_the_last_one_wins() {
    let mut run = Run::started(watched(), World::default());
    run.trace();
    assert_eq!(run.write("y", 5), Ok(()));
    assert_eq!(run.write("x", 6), Ok(()));
    assert_eq!(run.write("x", 7), Ok(()));
    assert_eq!(run.entry("x"), Value::Unset);
    run.step(10);
    assert_lines(
        &run.trace(),
        "0.010000 outside commits x: unset -> 7
         0.010000 outside commits y: unset -> 5
         0.010000 a.g polled: clear",
    );
    assert_eq!(run.calls("see"), ["0 see unset g", "10 see 7 g", "10 see 7 a"]);
}

#[test]
fn a_write_is_committed_even_if_no_component_is_due() {
    let mut run = Run::started(watched(), World::default());
    run.write("size", 5).expect("it fits");
    assert_eq!(run.step(3), Wake::At(crate::support::ms(10)));
    assert_eq!(run.entry("size"), Value::Int(5));
}

#[test]
fn an_invalid_write_is_the_writers_error() {
    let mut run = Run::started(watched(), World::default());
    assert_eq!(run.write("fixed", 2), Err(WriteError::ReadOnly));
    assert_eq!(run.write("result", 2), Err(WriteError::ReadOnly));
    assert_eq!(run.scheduler.write(EntryId(99), Value::Int(1)), Err(WriteError::Unknown));
    assert_eq!(run.scheduler.write(EntryId(1), Value::Bool(true)), Err(WriteError::Type));
    run.trace();
    run.step(5);
    assert_eq!(run.trace(), [""; 0]);
}

#[test]
fn a_full_queue_is_the_writers_error() {
    let mut run = Run::started(watched(), World::default());
    for value in 0..MAX_WRITES_PER_STEP {
        assert_eq!(run.write("x", value as i64), Ok(()));
    }
    assert_eq!(run.write("x", 99), Err(WriteError::QueueFull));
    run.step(5);
    assert_eq!(run.entry("x"), Value::Int(MAX_WRITES_PER_STEP as i64 - 1));
    assert_eq!(run.write("x", 99), Ok(()));
}

#[test]
fn an_ended_plan_takes_no_writes() {
    let mut run = Run::started(watched(), World::default());
    run.scheduler.request_stop();
    run.step(5);
    assert_eq!(run.write("x", 1), Err(WriteError::Ended));
}

#[test]
fn a_stop_request_comes_before_the_writes_and_interrupts() {
    let mut run = Run::started(watched(), World::default().says("g", 0, 10..11));
    run.trace();
    run.write("x", 1).expect("it fits");
    run.scheduler.request_stop();
    assert_eq!(run.step(10), Wake::Ended(Ending::Interrupted));
    assert_lines(
        &run.trace(),
        "0.010000 stop requested
         0.010000 a interrupted
         0.010000 p ended Interrupted",
    );
    assert_eq!((run.entry("x"), run.emergency_stops()), (Value::Unset, 0));
}

#[test]
fn after_a_stop_request_before_the_start_nothing_runs() {
    let mut run = Run::ready(watched(), World::default());
    run.scheduler.request_stop();
    assert_eq!(run.start(), Ok(Wake::Ended(Ending::Interrupted)));
    assert_lines(&run.trace(), "0.000000 stop requested\n0.000000 p ended Interrupted");
    assert_eq!(run.calls("start"), [""; 0]);
}

#[test]
fn aborting_a_plan_that_has_ended_stops_the_platform_and_changes_nothing_else() {
    let mut run = Run::started(watched(), World::default());
    run.scheduler.request_stop();
    run.step(10);
    run.trace();
    run.abort();
    assert_eq!((run.ending(), run.emergency_stops()), (Some(Ending::Interrupted), 1));
    assert_eq!(run.trace(), [""; 0]);
}

#[test]
fn a_stop_request_whose_interrupt_fails_is_an_emergency() {
    let mut run = Run::started(watched(), World::default().fails("a", Phase::Interrupt, 0..100));
    run.scheduler.request_stop();
    assert_eq!(run.step(10), Wake::Ended(Ending::Error(SCRIPTED)));
    assert_eq!(run.emergency_stops(), 1);
}

#[test]
fn a_plan_with_a_missing_input_does_not_start() {
    let build = || {
        plan("p")
            .entry("size", EntryKind::In, Value::Unset)
            .with(actor("a").reads("size").on("Done", "a"))
    };
    let mut run = Run::ready(build(), World::default());
    assert_eq!(run.start(), Err(StartError::InputMissing(EntryId(0))));
    assert_eq!((run.world.calls.len(), run.trace().len()), (0, 0));
    run.scheduler.plan_mut().expect("not started").set("size", Value::Int(4));
    run.start().expect("the input is set");
    assert_eq!(run.calls("see"), ["0 see 4 a"]);
    assert_eq!(run.start(), Err(StartError::AlreadyStarted));
}

#[test]
fn a_write_before_the_start_sets_an_input_without_a_commit() {
    let build = plan("p")
        .entry("size", EntryKind::In, Value::Unset)
        .var("x")
        .with(actor("a").reads("size").on("Done", "a"));
    let mut run = Run::ready(build, World::default());
    assert_eq!(run.write("x", 3), Err(WriteError::NotStarted), "its initial value comes later");
    assert_eq!(run.write("size", 3), Ok(()));
    assert_eq!(run.entry("size"), Value::Int(3));
    run.start().expect("the input is set");
    assert_eq!(run.calls("see"), ["0 see 3 a"]);
    run.trace();
    run.step(10);
    assert_lines(&run.trace(), "");
}

#[test]
fn a_running_plan_can_only_be_changed_by_commits() {
    let mut run = Run::started(watched(), World::default());
    assert!(run.scheduler.plan_mut().is_none());
    run.scheduler.request_stop();
    run.step(10);
    assert!(run.scheduler.plan_mut().is_none(), "nor one that has ended");
}

#[test]
fn a_step_before_the_start_does_nothing_and_reports_it() {
    let mut run = Run::ready(watched(), World::default());
    assert_eq!(run.step(10), Wake::NotStarted);
    assert_eq!((run.world.calls.len(), run.trace().len()), (0, 0));
    assert!(matches!(run.start(), Ok(Wake::At(_))));
}

#[test]
fn a_missing_input_is_named() {
    let build = plan("p").entry("size", EntryKind::In, Value::Unset).with(actor("a").on("D", "a"));
    let mut run = Run::ready(build, World::default());
    let why = run.start().expect_err("an input is missing");
    let named = why.named(run.names()).to_string();
    assert_eq!(named, "the input 'size' has no value: set it before the start");
}
