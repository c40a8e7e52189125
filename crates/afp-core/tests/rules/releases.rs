//! Due times of supervisors and actors, and the wake time of a step.

use afp_core::Wake;
use afp_core::trace::Ending;

use crate::support::build::{actor, guard, plan};
use crate::support::ms;
use crate::support::run::{Run, assert_lines};
use crate::support::world::{Phase, World};

#[test]
fn supervisors_stay_on_their_grid_after_late_steps() {
    let plan =
        plan("p").with(actor("a").every(1000).guarded(guard("g", 10).on("E", "a")).on("Done", "a"));
    let mut run = Run::started(plan, World::default());
    assert_eq!(run.wake, Wake::At(ms(10)));
    assert_eq!(run.step(13), Wake::At(ms(20)));
    assert_eq!(run.step(20), Wake::At(ms(30)));
    assert_eq!(run.step(57), Wake::At(ms(60)));
    assert_eq!(run.step(60), Wake::At(ms(70)));
    let polls = ["0 poll g", "13 poll g", "20 poll g", "57 poll g", "60 poll g"];
    assert_eq!(run.calls("poll"), polls);
}

#[test]
fn local_supervisors_count_from_the_step_that_entered_their_actor() {
    let plan = plan("p")
        .guarded(guard("global", 20).on("E", "terminate"))
        .with(actor("a").every(7).on("Done", "b"))
        .with(actor("b").every(1000).guarded(guard("local", 20).on("E", "a")).on("Done", "b"));
    let mut run = Run::started(plan, World::default().says("a", 0, 7..8));
    run.until(60);
    let polls: Vec<&str> =
        run.calls("poll").into_iter().filter(|call| !call.ends_with('a')).collect();
    assert_eq!(
        polls,
        [
            "0 poll global",
            "7 poll local",
            "20 poll global",
            "27 poll local",
            "40 poll global",
            "47 poll local",
            "60 poll global",
        ]
    );
}

#[test]
fn a_global_supervisor_keeps_its_grid_across_actors() {
    let plan = plan("p")
        .guarded(guard("g", 10).on("E", "terminate"))
        .with(actor("a").every(4).on("Done", "b"))
        .with(actor("b").every(4).on("Done", "a"));
    let world = World::default().says("a", 0, 0..100).says("b", 0, 0..100);
    let mut run = Run::started(plan, world);
    run.until(32);
    let polls: Vec<&str> =
        run.calls("poll").into_iter().filter(|call| call.ends_with('g')).collect();
    assert_eq!(polls, ["0 poll g", "10 poll g", "20 poll g", "30 poll g"]);
    assert_eq!(run.calls("start")[..2], ["0 start g", "0 start a"]);
    assert!(!run.calls("start")[2..].iter().any(|call| call.ends_with('g')));
}

#[test]
fn an_actor_is_first_polled_one_period_after_its_start_and_then_on_its_grid() {
    let plan = plan("p").with(actor("a").on("Done", "a"));
    let mut run = Run::started(plan, World::default());
    assert_eq!(run.wake, Wake::At(ms(10)));
    assert_eq!(run.step(9), Wake::At(ms(10)));
    assert_eq!(run.step(12), Wake::At(ms(20)));
    assert_eq!(run.step(55), Wake::At(ms(60)));
    assert_eq!(run.step(60), Wake::At(ms(70)));
    assert_eq!(run.calls("poll"), ["12 poll a", "55 poll a", "60 poll a"]);
}

#[test]
fn actors_have_no_deadline() {
    let plan = plan("p").with(actor("a").on("Done", "a"));
    let mut run = Run::started(plan, World::default().costs("a", Phase::Poll, 50, 10..11));
    run.trace();
    run.step(10);
    run.step(200);
    assert_eq!((run.scheduler.misses(), run.trace()), (0, Vec::new()));
}

#[test]
fn waking_early_does_nothing() {
    let plan = plan("p").with(actor("a").guarded(guard("g", 10).on("E", "a")).on("Done", "a"));
    let mut run = Run::started(plan, World::default());
    run.trace();
    for at in 1..10 {
        assert_eq!(run.step(at), Wake::At(ms(10)));
    }
    assert_eq!(run.trace(), [""; 0]);
}

#[test]
fn a_second_step_at_one_instant_does_only_what_is_still_due() {
    let plan = plan("p")
        .with(
            actor("a")
                .guarded(guard("one", 10).on("E", "b"))
                .guarded(guard("two", 10).on("E", "a"))
                .on("Done", "a"),
        )
        .with(actor("b").guarded(guard("three", 10).on("E", "a")).on("Done", "b"));
    let mut run = Run::started(plan, World::default().says("one", 0, 10..11));
    run.step(10);
    run.world.calls.clear();
    assert_eq!(run.step(10), Wake::At(ms(20)));
    assert_eq!(run.world.calls, [""; 0]);
}

#[test]
fn a_time_before_the_last_step_counts_as_that_one_and_is_traced() {
    let plan = plan("p").with(actor("a").on("Done", "a"));
    let mut run = Run::started(plan, World::default());
    run.step(25);
    run.trace();
    assert_eq!(run.step(7), Wake::At(ms(30)));
    assert_lines(&run.trace(), "0.025000 clock went back to 0.007000");
    assert_eq!(run.calls("poll"), ["25 poll a"]);
}

#[test]
fn after_terminate_nothing_is_polled() {
    let plan = plan("p")
        .guarded(guard("late", 10).deadline(9).on("E", "a"))
        .guarded(guard("first", 10).deadline(8).on("E", "terminate"))
        .with(actor("a").on("Done", "a"));
    let world = World::default().says("first", 0, 10..11).says("late", 0, 10..11);
    let mut run = Run::started(plan, world);
    run.world.calls.clear();
    run.step(10);
    assert_eq!(run.world.calls, ["10 poll first", "10 interrupt a"]);
    assert_eq!(run.step(20), Wake::Ended(Ending::Interrupted));
    assert_eq!(run.world.calls.len(), 2);
}
