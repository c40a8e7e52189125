//! Rules 1 to 10, 14, 16 and 19 of `suspend`: setting an element aside and giving it up.

use afp_core::Fault;
use afp_core::trace::Ending;

use crate::support::build::{Builder, actor, computation, guard, plan, sub_plan};
use crate::support::run::{Run, assert_lines};
use crate::support::world::{Phase, SCRIPTED, World};

/// A button pauses `drive` and returns to it.
pub fn paused() -> Builder {
    plan("p")
        .var("x")
        .guarded(guard("button", 10).on("Click", "suspend pause").writes("Click", "x", 1))
        .with(actor("drive").on("Done", "terminate"))
        .with(actor("pause").reacts("button", "Click", "return").on("Done", "return"))
}

#[test]
fn rule_6_suspend_then_commit_then_the_handler_starts() {
    let mut run = Run::started(paused(), World::default().says("button", 0, 30..31));
    run.until(20);
    run.trace();
    run.step(30);
    assert_lines(
        &run.trace(),
        "0.030000 button polled: Click
         0.030000 button event Click -> suspend pause
         0.030000 button commits x: unset -> 1
         0.030000 drive suspended by button
         0.030000 pause started",
    );
    assert_eq!(run.calls("suspend"), ["30 suspend drive"]);
    assert_eq!(run.active(), Some("pause"));
    run.until(100);
    assert_eq!(run.calls("poll").iter().filter(|call| call.ends_with("drive")).count(), 2);
}

#[test]
fn rule_6_computations_commit_before_the_element_is_suspended() {
    let plan = plan("p")
        .var("n")
        .guarded(guard("button", 10).on("Click", "count"))
        .with(actor("drive").on("Done", "terminate"))
        .with(
            computation("count")
                .on("Done", "fail")
                .on("Next", "suspend pause")
                .writes("Next", "n", 1),
        )
        .with(actor("pause").on("Done", "return"));
    let world = World::default()
        .says("button", 0, 10..11)
        .says("button", 0, 30..31)
        .says("count", 1, 10..11)
        .says("pause", 0, 20..21);
    let mut run = Run::started(plan, world);
    run.trace();
    run.step(10);
    assert_lines(
        &run.story(),
        "0.010000 button polled: Click
         0.010000 button event Click -> count
         0.010000 count finished Next -> suspend pause
         0.010000 count commits n: unset -> 1
         0.010000 drive suspended by button
         0.010000 pause started",
    );
    run.until(40);
    assert!(matches!(run.ending(), Some(Ending::Error(fault)) if fault.code() == Fault::FAILED));
    assert_eq!(run.calls("interrupt"), ["30 interrupt drive"]);
}

#[test]
fn rule_7_in_the_look_nothing_is_called() {
    let world = World::default().says("button", 0, 0..1).says("button", 0, 20..21);
    let mut run = Run::started(paused(), world);
    assert_lines(
        &run.story(),
        "0.000000 button started
         0.000000 button polled: Click
         0.000000 button event Click -> suspend pause
         0.000000 button commits x: unset -> 1
         0.000000 drive suspended by button before its start
         0.000000 pause started",
    );
    run.until(20);
    assert_eq!(run.calls("start"), ["0 start button", "0 start pause", "20 start drive"]);
    assert_eq!(run.calls("suspend"), [""; 0]);
}

#[test]
fn rule_8_a_handler_yields_and_the_element_stays_suspended() {
    let plan = plan("p")
        .guarded(guard("first", 10).on("E", "suspend x"))
        .guarded(guard("second", 10).on("E", "suspend y"))
        .with(actor("a").on("Done", "terminate"))
        .with(actor("x").on("Done", "return"))
        .with(actor("y").on("Done", "return"));
    let world =
        World::default().says("first", 0, 10..11).says("second", 0, 30..31).says("y", 0, 50..51);
    let mut run = Run::started(plan, world);
    run.until(50);
    assert_eq!(run.calls("interrupt"), ["30 interrupt x"]);
    assert_eq!(run.calls("suspend"), ["10 suspend a"]);
    // The time counts from the first suspension.
    assert_eq!(run.calls("back"), ["50 back after 40 a"]);
}

#[test]
fn rule_9_a_global_supervisor_does_not_start_its_handler_again() {
    let lasting = plan("p")
        .guarded(guard("g", 10).on("E", "suspend x").on("Worse", "fail"))
        .with(actor("a").on("Done", "terminate"))
        .with(actor("x").on("Done", "return"));
    let world = World::default().says("g", 0, 10..40).says("g", 1, 40..41);
    let mut run = Run::started(lasting, world);
    run.until(35);
    assert_eq!(run.calls("start"), ["0 start g", "0 start a", "10 start x"]);
    assert!(run.trace().iter().any(|line| line == "0.020000 g already there: E -> suspend x"));
    run.until(40);
    assert_eq!(run.calls("interrupt"), ["40 interrupt x", "40 interrupt a"]);
}

#[test]
fn rule_10_a_suspended_element_is_silent() {
    let plan = plan("p")
        .guarded(guard("global", 10).on("E", "suspend x"))
        .with(
            actor("a")
                .guarded(guard("local", 10).on("E", "terminate").on_miss("terminate"))
                .on("Done", "terminate"),
        )
        .with(actor("x").on("Done", "return"));
    let world = World::default().says("global", 0, 10..11).says("local", 0, 15..10_000).says(
        "x",
        0,
        10_010..10_011,
    );
    let mut run = Run::started(plan, world);
    run.until(10_005);
    assert_eq!(run.calls("poll").iter().filter(|call| call.ends_with(" local")).count(), 1);
    run.until(10_010);
    assert_eq!(run.active(), Some("a"));
    assert_eq!(run.scheduler.misses(), 0);
    run.until(10_020);
    assert_eq!(run.ending(), None);
}

#[test]
fn rule_14_another_element_abandons_the_suspended_element() {
    let plan = plan("p")
        .var("v")
        .guarded(guard("button", 10).on("Click", "suspend x"))
        .guarded(guard("low", 10).on("Low", "b").writes("Low", "v", 2))
        .with(actor("a").on("Done", "terminate"))
        .with(actor("x").on("Done", "return"))
        .with(actor("b").on("Done", "terminate"));
    let world = World::default().says("button", 0, 10..11).says("low", 0, 30..31);
    let mut run = Run::started(plan, world);
    run.until(20);
    run.trace();
    run.step(30);
    assert_lines(
        &run.story(),
        "0.030000 low polled: Low
         0.030000 low event Low -> b
         0.030000 x interrupted
         0.030000 low commits v: unset -> 2
         0.030000 a abandoned
         0.030000 b started",
    );
    assert_eq!(run.calls("interrupt"), ["30 interrupt x", "30 interrupt a"]);
}

#[test]
fn rule_14_the_element_itself_is_abandoned_and_entered_again() {
    let plan = plan("p")
        .guarded(guard("button", 10).on("Click", "suspend x"))
        .guarded(guard("again", 10).on("E", "a"))
        .with(actor("a").on("Done", "terminate"))
        .with(actor("x").on("Done", "return"));
    let world = World::default().says("button", 0, 10..11).says("again", 0, 30..31);
    let mut run = Run::started(plan, world);
    run.until(30);
    assert_eq!(run.calls("interrupt"), ["30 interrupt x", "30 interrupt a"]);
    assert_eq!(run.calls("start").last(), Some(&"30 start a"));
}

#[test]
fn rule_14_every_ending_abandons_the_suspended_element() {
    for (to, ending) in [("terminate", "Interrupted"), ("fail", "Error(failed: stuck)")] {
        let plan = plan("p")
            .guarded(guard("button", 10).on("Click", "suspend x"))
            .guarded(guard("end", 10).on("E", to))
            .with(actor("a").on("Done", "terminate"))
            .with(actor("x").on("Done", "return"));
        let world = World::default().says("button", 0, 10..11).says("end", 0, 20..21);
        let mut run = Run::started(plan, world);
        run.until(20);
        assert_eq!(run.calls("interrupt"), ["20 interrupt x", "20 interrupt a"]);
        let trace = run.trace();
        let [.., abandoned, ended] = &*trace else { panic!() };
        assert_eq!(abandoned, "0.020000 a abandoned");
        assert_eq!(*ended, format!("0.020000 p ended {ending}"));
    }
}

#[test]
fn rule_14_a_stop_request_interrupts_the_handler_first() {
    let mut run = Run::started(paused(), World::default().says("button", 0, 10..11));
    run.until(10);
    run.scheduler.request_stop();
    run.step(15);
    assert_eq!(run.calls("interrupt"), ["15 interrupt pause", "15 interrupt drive"]);
    assert_eq!(run.ending(), Some(Ending::Interrupted));
}

#[test]
fn rule_14_an_element_that_did_not_start_is_not_interrupted() {
    let mut run = Run::started(paused(), World::default().says("button", 0, 0..1));
    run.scheduler.request_stop();
    run.step(15);
    assert_eq!(run.calls("interrupt"), ["15 interrupt pause"]);
    assert!(run.trace().contains(&"0.015000 drive abandoned before its start".to_owned()));
}

#[test]
fn rule_14_a_handler_that_fails_ends_the_plan_with_both() {
    let world = World::default().says("button", 0, 10..11).fails("pause", Phase::Poll, 20..21);
    let mut run = Run::started(paused(), world);
    run.until(20);
    assert_eq!(run.calls("interrupt"), ["20 interrupt pause", "20 interrupt drive"]);
    assert_eq!(run.ending(), Some(Ending::Error(SCRIPTED)));
    assert_eq!(run.failure().as_deref(), Some("pause: as the script says"));
}

#[test]
fn rule_14_a_handler_may_return_on_its_error() {
    let plan = plan("p")
        .guarded(guard("button", 10).on("Click", "suspend x"))
        .with(actor("a").on("Done", "terminate"))
        .with(actor("x").on("Done", "return").on_error("return"));
    let world = World::default().says("button", 0, 10..11).fails("x", Phase::Start, 10..11);
    let mut run = Run::started(plan, world);
    run.until(10);
    assert_eq!(run.calls("back"), ["10 back after 0 a"]);
    assert_eq!(run.active(), Some("a"));
}

#[test]
fn rule_16_a_failed_suspend_interrupts_once_and_commits_nothing() {
    let plan = plan("p")
        .var("x")
        .guarded(guard("button", 10).on("Click", "suspend pause").writes("Click", "x", 1))
        .with(actor("drive").on("Done", "terminate").on_error("b"))
        .with(actor("pause").on("Done", "return"))
        .with(actor("b").on("Done", "terminate"));
    let world = World::default().says("button", 0, 10..11).fails("drive", Phase::Suspend, 10..11);
    let mut run = Run::started(plan, world);
    run.trace();
    run.step(10);
    assert_lines(
        &run.story(),
        "0.010000 button polled: Click
         0.010000 button event Click -> suspend pause
         0.010000 drive fault scripted: as the script says -> b
         0.010000 drive interrupted
         0.010000 b started",
    );
    assert_eq!(run.calls("interrupt"), ["10 interrupt drive"]);
}

#[test]
fn rule_16_three_levels_down_the_event_selects_the_error_edge() {
    let inner = plan("inner").with(actor("act").on("Done", "terminate").on_error("act"));
    let middle = plan("middle").with(sub_plan("in", inner).on("OK", "terminate"));
    let plan = plan("p")
        .guarded(guard("button", 10).on("Click", "suspend pause"))
        .with(sub_plan("mid", middle).on("OK", "terminate").on_error("b"))
        .with(actor("pause").on("Done", "return"))
        .with(actor("b").on("Done", "terminate"));
    let world = World::default().says("button", 0, 10..11).fails("act", Phase::Suspend, 10..11);
    let mut run = Run::started(plan, world);
    run.until(10);
    assert_eq!(run.calls("interrupt"), ["10 interrupt act"]);
    assert_eq!(run.active(), Some("b"));
}

#[test]
fn rule_16_the_failed_actor_is_named_from_three_levels_down() {
    let inner = plan("inner").with(actor("act").on("Done", "terminate"));
    let plan = plan("p")
        .guarded(guard("button", 10).on("Click", "suspend pause"))
        .with(sub_plan("in", inner).on("OK", "terminate"))
        .with(actor("pause").on("Done", "return"));
    let world = World::default().says("button", 0, 10..11).fails("act", Phase::Suspend, 10..11);
    let mut run = Run::started(plan, world);
    run.until(10);
    assert_eq!(run.failure().as_deref(), Some("in.act: as the script says"));
    assert_eq!(run.ending(), Some(Ending::Error(SCRIPTED)));
}

#[test]
fn rule_16_a_failed_interrupt_ends_the_run_and_calls_nothing() {
    let world = World::default().says("button", 0, 10..11).fails("pause", Phase::Interrupt, 20..21);
    let mut run = Run::started(paused(), world);
    run.until(10);
    run.scheduler.request_stop();
    run.step(20);
    assert_eq!(run.emergency_stops(), 1);
    assert_eq!(run.calls("interrupt"), ["20 interrupt pause"]);
}

#[test]
fn rule_16_a_failed_interrupt_of_the_suspended_element_ends_the_run() {
    let world = World::default()
        .says("button", 0, 10..11)
        .fails("drive", Phase::Interrupt, 20..21)
        .fails("pause", Phase::Poll, 20..21);
    let mut run = Run::started(paused(), world);
    run.until(20);
    assert_eq!(run.emergency_stops(), 1);
    assert_eq!(run.failure().as_deref(), Some("drive: as the script says"));
}

#[test]
fn rule_1_a_missed_deadline_may_suspend() {
    let plan = plan("p")
        .with(actor("a").guarded(guard("slow", 10).on_miss("suspend x")).on("Done", "terminate"))
        .with(actor("x").on("Done", "return"));
    let world = World::default().costs("slow", Phase::Poll, 20, 10..11).says("x", 0, 40..41);
    let mut run = Run::started(plan, world);
    run.until(60);
    assert_eq!(run.calls("suspend"), ["10 suspend a"]);
    assert_eq!(run.calls("back").len(), 1);
    assert_eq!(run.active(), Some("a"));
}
