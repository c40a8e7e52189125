//! Driving a plan on a platform, failures, and replacing a plan.

use std::panic::{AssertUnwindSafe, catch_unwind};

use afp_core::trace::{Ending, EntryKind, NoTrace};
use afp_core::{ElementId, EntryId, Fault, Release, Scheduler, StartError, Value, Wake};

use super::suspend::paused;
use crate::support::build::{Builder, actor, guard, plan, sub_plan};
use crate::support::ms;
use crate::support::run::Run;
use crate::support::scripted::Scripted;
use crate::support::world::{Phase, SCRIPTED, World};

/// Two actors of 10 ms each.
fn two() -> Builder {
    plan("p").with(actor("a").on("Done", "b")).with(actor("b").on("Done", "terminate"))
}

fn scheduler(plan: Builder) -> Scheduler<Scripted> {
    Scheduler::new(Scripted::new(plan.build()))
}

#[test]
fn a_plan_begins_at_the_platforms_time() {
    let mut world = World::default().says("a", 0, 0..9000).says("b", 0, 0..9000);
    for begin in [0, 5000] {
        world.time = ms(begin);
        world.calls.clear();
        assert_eq!(scheduler(two()).run(&mut world), Ok(Ending::Ok));
        let shifted = |at: u64, what: &str| format!("{} {what}", at + begin);
        let calls = [(0, "start a"), (10, "poll a"), (10, "start b"), (20, "poll b"), (20, "stop")];
        assert_eq!(world.calls, calls.map(|(at, what)| shifted(at, what)));
        assert_eq!(world.time, ms(begin + 20));
    }
}

#[test]
fn time_passes_up_to_the_limit_with_the_step_at_it() {
    let mut world = World::default().says("a", 0, 0..9000);
    let mut plan = scheduler(two());
    assert_eq!(plan.run_until(&mut world, &mut NoTrace, ms(10)), Ok(Wake::At(ms(20))));
    assert_eq!(world.calls, ["0 start a", "10 poll a", "10 start b"]);
    assert_eq!(plan.run_until(&mut world, &mut NoTrace, ms(17)), Ok(Wake::At(ms(20))));
    assert_eq!((world.time, world.calls.len()), (ms(17), 3));
    assert_eq!(plan.run_until(&mut world, &mut NoTrace, ms(25)), Ok(Wake::At(ms(30))));
    assert_eq!(world.calls[3..], ["20 poll b"]);
}

#[test]
fn no_step_is_made_before_the_platform_is_ready() {
    let mut world = World::default().says("a", 0, 0..9000).says("b", 0, 0..9000);
    world.ready = ms(13);
    assert_eq!(scheduler(two()).run(&mut world), Ok(Ending::Ok));
    assert_eq!(world.calls, ["0 start a", "13 poll a", "13 start b", "23 poll b", "23 stop"]);
}

#[test]
fn a_panic_that_unwinds_past_the_driver_stops_the_platform() {
    let mut world = World::default().panics("a", Phase::Poll, 10..11);
    let mut plan = scheduler(two());
    assert!(catch_unwind(AssertUnwindSafe(|| plan.run(&mut world))).is_err());
    assert_eq!(world.calls, ["0 start a", "10 poll a", "emergency stop"]);
    assert_eq!(plan.run(&mut world), Ok(Ending::Error(Fault::PANIC)));
    assert_eq!(plan.failure().map(|failure| failure.component.0), Some(1));
}

#[test]
fn a_plan_that_cannot_start_does_not_touch_the_platform() {
    let mut plan = scheduler(plan("p").entry("size", EntryKind::In, Value::Unset).with(actor("a")));
    let mut world = World::default();
    assert_eq!(plan.run(&mut world), Err(StartError::InputMissing(EntryId(0))));
    assert_eq!(world.calls, [""; 0]);
}

#[test]
fn the_innermost_component_that_failed_is_known() {
    let inner = || {
        plan("Inner")
            .guarded(guard("watch", 10).on("E", "terminate"))
            .with(actor("deep").on("Done", "deep"))
    };
    let outer = || plan("p").with(sub_plan("s", inner()).on("OK", "s").on("Interrupted", "s"));
    for (who, world) in [
        ("s.deep", World::default().fails("deep", Phase::Poll, 10..11)),
        ("s.deep", World::default().fails("deep", Phase::Start, 0..1)),
        ("s.watch", World::default().fails("watch", Phase::Poll, 10..11)),
    ] {
        let mut run = Run::started(outer(), world);
        assert_eq!(run.until(50).ending(), Some(Ending::Error(SCRIPTED)));
        assert_eq!(run.failure(), Some(format!("{who}: as the script says")));
    }
}

#[test]
fn a_fault_that_an_edge_handled_is_not_the_reason_of_the_end() {
    let build = || {
        let inner = plan("Inner").with(actor("deep").on("Done", "deep"));
        plan("p")
            .with(sub_plan("s", inner).on("OK", "s").on("Interrupted", "s").on_error("b"))
            .with(actor("b").on("Done", "terminate"))
    };
    let fails = || World::default().fails("deep", Phase::Poll, 10..11);
    let mut run = Run::started(build(), fails().says("b", 0, 20..21));
    run.until(50);
    assert_eq!((run.ending(), run.failure()), (Some(Ending::Ok), None));
    let mut run = Run::started(build(), fails().fails("b", Phase::Poll, 20..21));
    run.until(50);
    assert_eq!(run.failure().as_deref(), Some("b: as the script says"));
}

#[test]
fn an_actor_that_cannot_be_interrupted_is_the_source_of_the_fault() {
    let world = World::default().fails("a", Phase::Interrupt, 0..100);
    let mut run = Run::started(two(), world);
    run.scheduler.request_stop();
    run.step(5);
    assert_eq!(run.failure().as_deref(), Some("a: as the script says"));
}

#[test]
fn a_running_plan_can_be_replaced() {
    let mut world = World::default();
    let clock = world.clock.clone();
    let mut running = scheduler(two());
    running.run_until(&mut world, &mut NoTrace, ms(5)).expect("it starts");
    let other = plan("q").with(actor("c").on("Done", "terminate"));
    let missing = plan("q").entry("size", EntryKind::In, Value::Unset).with(actor("c"));
    let mut put = |running: &mut Scheduler<Scripted>, plan: Builder, at| {
        let plan = Scripted::new(plan.build());
        running.replace(plan, (&mut world, &mut NoTrace, &clock), ms(at))
    };
    assert_eq!(put(&mut running, missing, 6), Err(StartError::InputMissing(EntryId(0))));
    assert_eq!(running.active(), Some(ElementId(0)), "the old plan goes on");
    assert_eq!(put(&mut running, other, 7), Ok(Wake::At(ms(17))));
    assert_eq!(world.calls, ["0 start a", "7 interrupt a", "7 start c"]);
}

#[test]
fn a_plan_that_cannot_be_stopped_cannot_be_replaced() {
    let mut run = Run::started(two(), World::default().fails("a", Phase::Interrupt, 0..100));
    let clock = run.world.clock.clone();
    let other = Scripted::new(two().build());
    let wake = run.scheduler.replace(other, (&mut run.world, &mut NoTrace, &clock), ms(5));
    assert_eq!(wake, Ok(Wake::Ended(Ending::Error(SCRIPTED))));
    assert_eq!(run.calls("start"), ["0 start a"]);
    assert_eq!(run.emergency_stops(), 1);
}

#[test]
fn a_replaced_plan_interrupts_its_handler_and_then_its_suspended_element() {
    let mut run = Run::started(paused(), World::default().says("button", 0, 10..11));
    run.until(10);
    let clock = run.world.clock.clone();
    let other = Scripted::new(two().build());
    let wake = run.scheduler.replace(other, (&mut run.world, &mut NoTrace, &clock), ms(15));
    assert_eq!(wake, Ok(Wake::At(ms(25))));
    assert_eq!(run.calls("interrupt"), ["15 interrupt pause", "15 interrupt drive"]);
    assert_eq!(run.active(), Some("a"));
}

#[test]
fn a_plan_without_code_for_holds_is_only_stepped() {
    let mut run = Run::started(two(), World::default());
    let clock = run.world.clock.clone();
    let wake = run.scheduler.hold((&mut run.world, &mut NoTrace, &clock), ms(10));
    assert_eq!(wake, Wake::At(ms(20)));
    let wake = run.scheduler.release((&mut run.world, &mut NoTrace, &clock), ms(20), Release::Step);
    assert_eq!(wake, Wake::At(ms(30)));
    assert_eq!(run.world.calls, ["0 start a", "10 poll a", "20 poll a"]);
    assert!(!run.scheduler.is_held() && !Scheduler::<Scripted>::HOLDS);
}
