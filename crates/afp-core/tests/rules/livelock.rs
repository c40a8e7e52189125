//! Edges without a passing of time.

use afp_core::trace::Ending;
use afp_core::{Fault, MAX_TRANSITIONS_PER_STEP};

use crate::support::build::{Builder, actor, computation, guard, plan, sub_plan};
use crate::support::run::Run;
use crate::support::world::{Phase, World};

/// A computation in a loop.
fn spinning() -> Builder {
    plan("p").with(computation("c").on("Again", "c").on("Done", "terminate"))
}

fn assert_livelock(run: &Run) {
    assert_eq!(run.ending(), Some(Ending::Error(Fault::LIVELOCK)));
    assert_eq!(run.emergency_stops(), 1);
}

#[test]
fn a_thousand_edges_in_a_step_and_no_more() {
    assert_eq!(MAX_TRANSITIONS_PER_STEP, 1000);
    let mut run = Run::started(spinning(), World::default());
    assert_livelock(&run);
    // The first run needs no edge; the last edge starts nothing.
    assert_eq!(run.calls("start").len(), 1001);
    let trace = run.trace();
    assert_eq!(trace[trace.len() - 1], "0.000000 p ended Error(livelock)");
}

#[test]
fn each_step_counts_from_zero() {
    let plan = plan("p").with(actor("a").on("Done", "b")).with(actor("b").on("Done", "a"));
    let mut run =
        Run::started(plan, World::default().says("a", 0, 0..30_000).says("b", 0, 0..30_000));
    run.until(20_000);
    assert_eq!(run.ending(), None);
}

#[test]
fn an_actor_that_started_always_takes_time() {
    let plan = plan("p").with(actor("a").on("Done", "a"));
    let mut run = Run::started(plan, World::default().says("a", 0, 0..1000));
    run.until(100);
    assert_eq!(run.calls("start").len(), 11);
}

#[test]
fn look_edges_count() {
    let plan = plan("p")
        .with(actor("a").guarded(guard("t", 10).on("E", "b")).on("Done", "a"))
        .with(actor("b").guarded(guard("u", 10).on("E", "a")).on("Done", "a"));
    let run = Run::started(plan, World::default().says("t", 0, 0..1).says("u", 0, 0..1));
    assert_livelock(&run);
    assert_eq!(run.calls("start").len(), 1001);
}

#[test]
fn error_edges_count() {
    let plan = plan("p").with(actor("a").on("Done", "a").on_error("a"));
    let run = Run::started(plan, World::default().fails("a", Phase::Start, 0..1));
    assert_livelock(&run);
}

#[test]
fn edges_of_all_levels_count_together_and_no_error_edge_catches_it() {
    let inner = plan("Inner").with(computation("c").on("Done", "terminate"));
    let plan = plan("p")
        .with(sub_plan("s", inner).on("OK", "s").on_error("b"))
        .with(actor("b").on("Done", "b"));
    let run = Run::started(plan, World::default());
    assert_livelock(&run);
    // Each round takes an inner and an outer edge.
    assert_eq!(run.calls("start").len(), 501);
}

#[test]
fn an_inner_livelock_ends_the_whole_run() {
    let plan = plan("p")
        .with(actor("a").on("Done", "s"))
        .with(sub_plan("s", spinning()).on("OK", "a").on_error("b"))
        .with(actor("b").on("Done", "b"));
    let mut run = Run::started(plan, World::default().says("a", 0, 10..11));
    run.step(10);
    assert_livelock(&run);
}
