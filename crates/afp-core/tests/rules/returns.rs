//! Rules 11 to 19 of `return`: continuing the element that was set aside.

use afp_core::trace::Ending;
use afp_core::{Fault, Instant};

use super::suspend::paused;
use crate::support::build::{Builder, actor, computation, guard, plan, sub_plan};
use crate::support::run::{Run, assert_lines};
use crate::support::world::{Phase, World};

/// `a` has a supervisor that suspends it, and one that continues.
fn local() -> Builder {
    plan("p")
        .var("v")
        .with(
            actor("a")
                .guarded(guard("first", 10).on("E", "suspend x"))
                .guarded(guard("other", 10).on("E", "terminate").continues())
                .on("Done", "terminate")
                .on_error("b"),
        )
        .with(actor("x").on("Done", "return").writes("Done", "v", 3))
        .with(actor("b").on("Done", "terminate"))
}

#[test]
fn rule_11_the_element_continues_at_its_place() {
    let world = World::default().says("button", 0, 30..31).says("button", 0, 70..71).says(
        "drive",
        0,
        200..201,
    );
    let mut run = Run::started(paused(), world);
    run.until(60);
    run.trace();
    run.step(70);
    assert_lines(
        &run.story(),
        "0.070000 button polled: Click
         0.070000 button event Click -> return
         0.070000 pause interrupted
         0.070000 button commits x: 1 -> 1
         0.070000 drive returned after 0.040000",
    );
    run.until(200);
    assert_eq!(run.ending(), Some(Ending::Ok));
    assert_eq!(run.calls("start"), ["0 start button", "0 start drive", "30 start pause"]);
    assert_eq!(run.calls("back"), ["70 back after 40 drive"]);
    // The first poll follows one period later.
    let polls: Vec<_> =
        run.calls("poll").into_iter().filter(|call| call.ends_with("drive")).collect();
    assert_eq!(polls[..3], ["10 poll drive", "20 poll drive", "80 poll drive"]);
}

#[test]
fn rule_11_supervisors_continue_or_start_and_look_first() {
    let world = World::default().says("first", 0, 30..31).says("x", 0, 90..91);
    let mut run = Run::started(local(), world);
    run.until(80);
    run.trace();
    run.step(90);
    assert_lines(
        &run.trace(),
        "0.090000 x finished Done -> return
         0.090000 x commits v: unset -> 3
         0.090000 a.first started
         0.090000 a.other returned after 0.060000
         0.090000 a.first polled: clear
         0.090000 a.other polled: clear
         0.090000 a returned after 0.060000",
    );
}

#[test]
fn rule_11_a_lasting_condition_suspends_again_in_the_look() {
    let world =
        World::default().says("first", 0, 30..300).says("x", 0, 90..91).says("x", 0, 190..191);
    let mut run = Run::started(local(), world);
    run.until(80);
    run.trace();
    run.step(90);
    assert_lines(
        &run.story(),
        "0.090000 x finished Done -> return
         0.090000 x commits v: unset -> 3
         0.090000 a.first started
         0.090000 a.other returned after 0.060000
         0.090000 a.first polled: E
         0.090000 a.first event E -> suspend x
         0.090000 x started",
    );
    run.until(190);
    // Silent since the look.
    let back = ["90 back after 60 other", "190 back after 100 other"];
    assert_eq!(run.calls("back"), back);
    assert_eq!(run.calls("suspend"), ["30 suspend a"]);
    assert_eq!(run.calls("resume"), ["90 resume other", "190 resume other"]);
}

#[test]
fn rule_11_an_element_that_did_not_start_starts_with_new_inputs() {
    let plan = plan("p")
        .var("v")
        .with(
            actor("a")
                .reads("v")
                .guarded(guard("g", 10).on("E", "suspend x"))
                .on("Done", "terminate"),
        )
        .with(actor("x").on("Done", "return").writes("Done", "v", 3));
    let world = World::default().says("g", 0, 0..60).says("x", 0, 20..100);
    let mut run = Run::started(plan, world);
    run.until(100);
    // Handler after handler while the condition lasts: time passes.
    assert_eq!(run.calls("see"), ["60 see 3 a"]);
    assert_eq!(run.calls("suspend"), [""; 0]);
    assert_eq!(run.calls("resume"), [""; 0]);
    assert_eq!(run.ending(), None);
}

#[test]
fn rule_12_a_handler_does_not_return_in_its_look() {
    let plan = plan("p")
        .guarded(guard("button", 10).on("Click", "suspend x"))
        .with(actor("a").on("Done", "terminate"))
        .with(
            actor("x")
                .guarded(guard("back", 10).on("E", "return"))
                .guarded(guard("count", 10).on("E", "c"))
                .on("Done", "return"),
        )
        .with(computation("c").on("Done", "return"));
    let world =
        World::default().says("button", 0, 10..11).says("count", 0, 10..11).says("back", 0, 10..30);
    let mut run = Run::started(plan, world);
    run.until(10);
    assert_eq!(run.active(), Some("x"));
    run.until(20);
    assert_eq!(run.active(), Some("a"));
    assert_eq!(run.calls("back"), ["20 back after 10 a"]);
}

#[test]
fn rule_12_a_global_reaction_may_return_in_the_look() {
    let plan = plan("p")
        .guarded(guard("button", 10).on("Click", "suspend x"))
        .guarded(guard("also", 20).on("E", "terminate"))
        .with(actor("a").on("Done", "terminate"))
        .with(actor("x").reacts("also", "E", "return").on("Done", "return"));
    let world = World::default().says("button", 0, 20..21).says("also", 0, 20..21);
    let mut run = Run::started(plan, world);
    run.until(20);
    assert_eq!(run.calls("start"), ["0 start button", "0 start also", "0 start a"]);
    assert_eq!(run.calls("back"), ["20 back after 0 a"]);
}

/// Three levels; each has a global supervisor, and the innermost actor a local one.
fn nested() -> Builder {
    let inner = plan("inner")
        .guarded(guard("g3", 10).on("E", "terminate"))
        .with(actor("act").guarded(guard("l3", 10).on("E", "terminate")).on("Done", "terminate"));
    let middle = plan("middle")
        .guarded(guard("g2", 10).on("E", "terminate").continues())
        .with(sub_plan("in", inner).on("OK", "terminate").on("Interrupted", "terminate"));
    plan("p")
        .guarded(guard("button", 10).on("Click", "suspend x"))
        .with(
            sub_plan("mid", middle)
                .guarded(guard("l1", 10).on("E", "terminate"))
                .on("OK", "terminate")
                .on("Interrupted", "terminate")
                .on_error("b"),
        )
        .with(actor("x").on("Done", "return"))
        .with(actor("b").on("Done", "terminate"))
}

#[test]
fn rule_13_sub_plans_return_outer_first_and_every_level_looks() {
    let world = World::default().says("button", 0, 10..11).says("x", 0, 50..51);
    let mut run = Run::started(nested(), world);
    run.until(40);
    run.trace();
    run.step(50);
    assert_lines(
        &run.trace(),
        "0.050000 button polled: clear
         0.050000 x finished Done -> return
         0.050000 mid.l1 started
         0.050000 mid.l1 polled: clear
         0.050000 mid returned after 0.040000
         0.050000 mid.g2 returned after 0.040000
         0.050000 mid.g2 polled: clear
         0.050000 mid.in returned after 0.040000
         0.050000 mid.in.g3 started
         0.050000 mid.in.act.l3 started
         0.050000 mid.in.g3 polled: clear
         0.050000 mid.in.act.l3 polled: clear
         0.050000 mid.in.act returned after 0.040000",
    );
    assert_eq!(run.calls("suspend"), ["10 suspend act"]);
    assert_eq!(run.calls("refresh"), ["50 refresh mid", "50 refresh in"]);
}

#[test]
fn rule_13_an_event_of_an_inner_look_interrupts_what_was_suspended() {
    let world =
        World::default().says("button", 0, 10..11).says("x", 0, 50..51).says("l3", 0, 50..51);
    let mut run = Run::started(nested(), world);
    run.until(50);
    assert_eq!(run.calls("interrupt"), ["50 interrupt act"]);
    assert_eq!(run.ending(), Some(Ending::Ok));
}

/// An inner plan with a handler of its own.
fn two_handlers() -> Builder {
    let inner = plan("inner")
        .guarded(guard("beep", 10).on("E", "suspend sound"))
        .with(actor("act").on("Done", "terminate"))
        .with(actor("sound").on("Done", "return"));
    plan("p")
        .guarded(guard("button", 10).on("Click", "suspend x").on("Off", "terminate"))
        .with(sub_plan("in", inner).on("OK", "terminate").on_error("b"))
        .with(actor("x").on("Done", "return"))
        .with(actor("b").on("Done", "terminate"))
}

#[test]
fn rule_13_an_inner_handler_is_suspended_with_its_plan() {
    let world = World::default()
        .says("beep", 0, 10..11)
        .says("button", 0, 20..21)
        .says("x", 0, 50..51)
        .says("sound", 0, 80..81);
    let mut run = Run::started(two_handlers(), world);
    run.until(80);
    assert_eq!(run.calls("suspend"), ["10 suspend act", "20 suspend sound"]);
    assert_eq!(run.calls("back"), ["50 back after 30 sound", "80 back after 70 act"]);
}

#[test]
fn rule_13_an_inner_look_may_suspend_what_is_still_suspended() {
    let world = World::default()
        .says("button", 0, 20..21)
        .says("x", 0, 50..51)
        .says("beep", 0, 50..51)
        .says("sound", 0, 80..81);
    let mut run = Run::started(two_handlers(), world);
    run.until(80);
    assert_eq!(run.calls("suspend"), ["20 suspend act"]);
    assert_eq!(run.calls("back"), ["80 back after 60 act"]);
}

#[test]
fn rule_14_an_outer_ending_interrupts_the_inner_handler_and_its_suspended_element() {
    let world = World::default().says("beep", 0, 10..11).says("button", 1, 20..21);
    let mut run = Run::started(two_handlers(), world);
    run.until(20);
    assert_eq!(run.calls("interrupt"), ["20 interrupt sound", "20 interrupt act"]);
}

#[test]
fn rule_15_the_look_at_return_may_lead_elsewhere() {
    let world =
        World::default().says("first", 0, 30..31).says("x", 0, 90..91).says("other", 0, 90..91);
    let mut run = Run::started(local(), world);
    run.until(80);
    run.trace();
    run.step(90);
    let trace = run.story();
    assert_lines(
        &trace[4..],
        "0.090000 a.other polled: E
         0.090000 a.other event E -> terminate
         0.090000 a diverted by a.other
         0.090000 a abandoned
         0.090000 p ended Interrupted",
    );
    assert_eq!(run.calls("interrupt"), ["90 interrupt a"]);
}

#[test]
fn rule_16_a_failed_resume_interrupts_once_and_takes_the_error_edge() {
    let world = World::default().says("first", 0, 30..31).says("x", 0, 90..91).fails(
        "a",
        Phase::Resume,
        90..91,
    );
    let mut run = Run::started(local(), world);
    run.until(80);
    run.trace();
    run.step(90);
    assert_eq!(run.calls("interrupt"), ["90 interrupt a"]);
    assert_lines(
        &run.story()[4..],
        "0.090000 a fault scripted: as the script says -> b
         0.090000 a abandoned
         0.090000 b started",
    );
}

#[test]
fn rule_16_a_failed_resume_takes_the_error_edge_of_its_level() {
    let inner = plan("inner")
        .with(actor("act").on("Done", "terminate").on_error("then"))
        .with(actor("then").on("Done", "terminate"));
    let plan = plan("p")
        .guarded(guard("button", 10).on("Click", "suspend x"))
        .with(sub_plan("in", inner).on("OK", "terminate"))
        .with(actor("x").on("Done", "return"));
    let world = World::default().says("button", 0, 10..11).says("x", 0, 50..51).fails(
        "act",
        Phase::Resume,
        50..51,
    );
    let mut run = Run::started(plan, world);
    run.until(50);
    assert_eq!(run.calls("interrupt"), ["50 interrupt act"]);
    assert_eq!(run.calls("start").last(), Some(&"50 start then"));
    assert_eq!(run.active(), Some("in"));
}

#[test]
fn rule_16_a_failed_supervisor_at_return_takes_the_error_edge() {
    for (phase, guard) in
        [(Phase::Start, "first"), (Phase::Resume, "other"), (Phase::Poll, "other")]
    {
        let world = World::default().says("first", 0, 30..31).says("x", 0, 90..91).fails(
            guard,
            phase,
            90..91,
        );
        let mut run = Run::started(local(), world);
        run.until(90);
        assert_eq!(run.calls("interrupt"), ["90 interrupt a"]);
        assert_eq!(run.calls("start").last(), Some(&"90 start b"));
    }
}

#[test]
fn rule_16_live_inputs_that_fail_at_return_take_the_error_edge() {
    let world = World::default().says("button", 0, 10..11).says("x", 0, 50..51).fails(
        "in",
        Phase::Refresh,
        50..51,
    );
    let mut run = Run::started(two_handlers(), world);
    run.until(50);
    assert_eq!(run.calls("interrupt"), ["50 interrupt act"]);
    assert_eq!(run.active(), Some("b"));
}

#[test]
fn rule_16_a_global_supervisor_that_fails_at_return_ends_its_plan() {
    let world = World::default().says("button", 0, 10..11).says("x", 0, 50..51).fails(
        "g3",
        Phase::Start,
        50..51,
    );
    let mut run = Run::started(nested(), world);
    run.until(50);
    assert_eq!(run.calls("interrupt"), ["50 interrupt act"]);
    assert_eq!(run.active(), Some("b"));
    assert_eq!(run.ending(), None);
}

#[test]
fn rule_19_a_handler_that_takes_no_time_ends_in_livelock() {
    let nothing = plan("nothing").with(computation("c").on("Done", "terminate"));
    let plan = plan("p")
        .with(actor("a").guarded(guard("g", 10).on("E", "suspend x")).on("Done", "terminate"))
        .with(sub_plan("x", nothing).on("OK", "return"));
    let mut run = Run::started(plan, World::default().says("g", 0, 10..100));
    run.until(10);
    assert_eq!(run.ending(), Some(Ending::Error(Fault::LIVELOCK)));
    assert_eq!(run.emergency_stops(), 1);
    assert_eq!(run.calls("interrupt"), [""; 0]);
}

#[test]
fn resume_in_a_handler_continues_the_handler() {
    let plan = plan("p")
        .var("n")
        .guarded(guard("button", 10).on("Click", "suspend x"))
        .with(actor("a").on("Done", "terminate"))
        .with(
            actor("x")
                .guarded(guard("tick", 10).on("E", "resume").writes("E", "n", 1))
                .on("Done", "return"),
        );
    let world = World::default().says("button", 0, 10..11).says("tick", 0, 10..60);
    let mut run = Run::started(plan, world);
    run.until(60);
    assert_eq!(run.active(), Some("x"));
}

#[test]
fn a_handler_may_compute_before_it_returns() {
    let plan = plan("p")
        .guarded(guard("button", 10).on("Click", "suspend x"))
        .with(actor("a").on("Done", "terminate"))
        .with(actor("x").on("Done", "c"))
        .with(computation("c").on("Done", "return"));
    let world = World::default().says("button", 0, 10..11).says("x", 0, 30..31);
    let mut run = Run::started(plan, world);
    run.until(30);
    assert_eq!(run.calls("back"), ["30 back after 20 a"]);
}

#[test]
fn a_copy_with_a_suspended_element_continues_like_its_original() {
    let world = World::default().says("button", 0, 10..11).says("button", 0, 50..51);
    let mut run = Run::started(paused(), world);
    run.until(30);
    let mut copy = run.scheduler.try_clone().expect("it can be copied");
    run.until(60);
    let mut world = World::default().says("button", 0, 50..51);
    for at in [40, 50, 60] {
        let at = Instant::from_nanos(at * 1_000_000);
        copy.step((&mut world, &mut afp_core::trace::NoTrace, &afp_core::StillClock), at);
    }
    assert!(world.calls.contains(&"50 back after 40 drive".to_owned()));
    assert_eq!(run.calls("back"), ["50 back after 40 drive"]);
    assert_eq!(copy.active(), run.scheduler.active());
}
