//! Missed deadlines: the verdict, its cause, the event, the look.

use afp_core::trace::Ending;

use crate::support::build::{Builder, actor, guard, plan};
use crate::support::run::{Run, assert_lines};
use crate::support::world::{Phase, World};

fn watched(connected: bool) -> Builder {
    let guard = guard("g", 10).deadline(5).budget(1).on("E", "c");
    let guard = if connected { guard.on_miss("b") } else { guard };
    plan("p")
        .var("x")
        .with(actor("a").guarded(guard.writes("E", "x", 1)).on("Done", "a"))
        .with(actor("b").on("Done", "b"))
        .with(actor("c").on("Done", "c"))
}

fn slow(cost: u64) -> World {
    World::default().costs("g", Phase::Poll, cost, 10..11)
}

#[test]
fn a_poll_that_ends_on_its_deadline_is_in_time() {
    let mut run = Run::started(watched(true), slow(5));
    run.step(10);
    assert_eq!((run.scheduler.misses(), run.active()), (0, Some("a")));
}

#[test]
fn unconnected_a_miss_is_counted_and_traced() {
    let mut run = Run::started(watched(false), slow(6));
    run.trace();
    run.step(10);
    assert_lines(
        &run.trace(),
        "0.010000 a.g polled: clear
         0.010000 a.g missed its deadline by 0.001000 (long poll, 0 skipped)",
    );
    assert_eq!((run.scheduler.misses(), run.active()), (1, Some("a")));
}

#[test]
fn connected_it_is_the_supervisors_event_and_commits_nothing() {
    let mut run = Run::started(watched(true), slow(6));
    run.trace();
    run.step(10);
    assert_lines(
        &run.trace(),
        "0.010000 a.g polled: clear
         0.010000 a.g missed its deadline by 0.001000 (long poll, 0 skipped)
         0.010000 a.g event DeadlineMissed -> b
         0.010000 a interrupted
         0.010000 b started",
    );
    assert_eq!(run.scheduler.misses(), 1);
}

#[test]
fn an_event_of_that_poll_wins_over_the_miss() {
    let mut run = Run::started(watched(true), slow(6).says("g", 0, 10..11));
    run.trace();
    run.step(10);
    assert_lines(
        &run.trace(),
        "0.010000 a.g polled: E
         0.010000 a.g missed its deadline by 0.001000 (long poll, 0 skipped)
         0.010000 a.g event E -> c
         0.010000 a interrupted
         0.010000 a.g commits x: unset -> 1
         0.010000 c started",
    );
}

#[test]
fn an_event_that_is_not_taken_does_not_hide_the_miss() {
    let guard = guard("g", 10).deadline(5).on("E", "a").on_miss("b").writes("E", "x", 1);
    let plan = plan("p")
        .var("x")
        .guarded(guard)
        .with(actor("a").on("Done", "a"))
        .with(actor("b").on("Done", "b"));
    let mut run = Run::started(plan, slow(6).says("g", 0, 10..11));
    run.step(10);
    assert_eq!((run.active(), run.entry("x")), (Some("b"), afp_core::Value::Unset));
}

#[test]
fn a_miss_of_an_earlier_supervisor_comes_before_a_later_event() {
    let plan = plan("p")
        .guarded(guard("first", 10).deadline(5).on("E", "c").on_miss("b"))
        .with(actor("a").guarded(guard("second", 10).on("E", "c")).on("Done", "a"))
        .with(actor("b").on("Done", "b"))
        .with(actor("c").on("Done", "c"));
    let world = World::default().costs("first", Phase::Poll, 6, 10..11).says("second", 0, 10..11);
    let mut run = Run::started(plan, world);
    run.step(10);
    assert_eq!(run.active(), Some("b"));
}

#[test]
fn a_poll_that_began_too_late_for_its_budget_is_not_to_blame() {
    for (cost, cause) in [(4, "long poll"), (5, "late release")] {
        let plan = plan("p").with(
            actor("a")
                .guarded(guard("before", 10).deadline(1).on("E", "a"))
                .guarded(guard("g", 10).deadline(5).budget(1).on("E", "a"))
                .on("Done", "a"),
        );
        let world = World::default().costs("before", Phase::Poll, cost, 10..11).costs(
            "g",
            Phase::Poll,
            2,
            10..11,
        );
        let mut run = Run::started(plan, world);
        run.trace();
        run.step(10);
        let expected =
            format!("a.g missed its deadline by 0.00{}000 ({cause}, 0 skipped)", cost - 3);
        assert!(run.trace().iter().any(|line| line.ends_with(&expected)), "{expected}");
    }
}

#[test]
fn missed_releases_are_skipped_and_counted_once() {
    let mut run = Run::started(watched(true), World::default());
    run.trace();
    run.step(42);
    assert_lines(
        &run.trace(),
        "0.042000 a.g polled: clear
         0.042000 a.g missed its deadline by 0.000000 (late release, 3 skipped)
         0.042000 a.g event DeadlineMissed -> b
         0.042000 a interrupted
         0.042000 b started",
    );
    assert_eq!(run.scheduler.misses(), 3);
}

#[test]
fn the_latest_release_is_served_and_may_be_late_itself() {
    let mut run = Run::started(watched(false), World::default());
    run.trace();
    run.step(38);
    assert_lines(
        &run.trace(),
        "0.038000 a.g polled: clear
         0.038000 a.g missed its deadline by 0.003000 (late release, 2 skipped)",
    );
    assert_eq!(run.scheduler.misses(), 3);
}

#[test]
fn the_look_counts_a_miss_but_never_reports_it() {
    let mut run = Run::started(watched(true), World::default().costs("g", Phase::Poll, 6, 0..1));
    assert_eq!(run.active(), Some("a"));
    assert_lines(
        &run.trace(),
        "0.000000 a.g started
         0.000000 a.g polled: clear
         0.000000 a.g missed its deadline by 0.001000 (long poll, 0 skipped)
         0.000000 a started",
    );
    assert_eq!(run.scheduler.misses(), 1);
}

#[test]
fn time_that_the_actors_poll_took_makes_the_look_a_late_release() {
    let plan = plan("p").with(actor("a").on("Done", "b")).with(
        actor("b").guarded(guard("g", 10).deadline(5).budget(1).on("E", "a")).on("Done", "b"),
    );
    let world = World::default().says("a", 0, 10..11).costs("a", Phase::Poll, 7, 10..11);
    let mut run = Run::started(plan, world);
    run.trace();
    run.step(10);
    assert_lines(
        &run.trace(),
        "0.010000 a finished Done -> b
         0.010000 b.g started
         0.010000 b.g polled: clear
         0.010000 b.g missed its deadline by 0.002000 (late release, 0 skipped)
         0.010000 b started",
    );
}

#[test]
fn an_ignored_miss_is_only_counted() {
    let plan = plan("p").with(
        actor("a")
            .guarded(guard("g", 10).deadline(5).on("E", "a").on_miss("ignore"))
            .on("Done", "a"),
    );
    let mut run = Run::started(plan, slow(6));
    run.step(10);
    assert_eq!((run.scheduler.misses(), run.calls("interrupt").len()), (1, 0));
}

#[test]
fn ending_the_plan_by_a_miss_is_interrupted() {
    let plan = plan("p").with(
        actor("a")
            .guarded(guard("g", 10).deadline(5).on("E", "a").on_miss("terminate"))
            .on("Done", "a"),
    );
    let mut run = Run::started(plan, slow(6));
    run.step(10);
    assert_eq!(run.ending(), Some(Ending::Interrupted));
}

#[test]
fn a_supervisor_that_ended_before_its_poll_has_no_miss() {
    let plan = plan("p")
        .with(
            actor("a")
                .guarded(guard("first", 10).deadline(4).on("E", "b"))
                .guarded(guard("late", 10).deadline(5).on("E", "b"))
                .on("Done", "a"),
        )
        .with(actor("b").on("Done", "b"));
    let mut run = Run::started(plan, World::default().says("first", 0, 19..20));
    run.step(10);
    run.step(19);
    assert_eq!(run.scheduler.misses(), 0);
}

#[test]
fn a_global_miss_to_the_active_element_is_not_taken() {
    let plan = plan("p")
        .guarded(guard("g", 10).deadline(5).on("E", "terminate").on_miss("a"))
        .with(actor("a").on("Done", "a"));
    let mut run = Run::started(plan, slow(6));
    run.trace();
    run.step(10);
    assert_lines(
        &run.trace(),
        "0.010000 g polled: clear
         0.010000 g missed its deadline by 0.001000 (long poll, 0 skipped)
         0.010000 g already there: DeadlineMissed -> a",
    );
}
